#include <gmock/gmock.h>

#include <utility>

#include "server/daemon_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class JobListTest : public DaemonFixture {
 protected:
  void SetUp() override { start(with_workers(1)); }

  void create(const std::string& title, const std::string& batch) {
    auto request = job_of(endless_case());
    request.mutable_case_()->set_title(title);
    (*request.mutable_labels())["batch"] = batch;
    client().create(request);
  }

  // The names of a page, and in `request` the token of the next one.
  std::vector<std::string> page(v1::ListJobsRequest& request) {
    const auto response = answer_of(*client().jobs, &v1::Jobs::Stub::ListJobs, request);
    std::vector<std::string> out;
    for (const auto& job : response.jobs()) out.push_back(job.name());
    request.set_page_token(response.next_page_token());
    return out;
  }

  std::vector<std::string> found(const std::string& filter) {
    v1::ListJobsRequest request;
    request.set_filter(filter);
    return page(request);
  }

  // What is said of a request in which one field is wrong.
  std::string refusal(const char* field, const std::string& text) {
    v1::ListJobsRequest request;
    request.GetReflection()->SetString(&request, request.GetDescriptor()->FindFieldByName(field), text);
    const auto status = client().try_to(request);
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT) << field << " " << text;
    return status.error_message();
  }
};

TEST_F(JobListTest, AFilterFindsStatesLabelsAndTitles) {
  create("Steel hexagons", "one");
  create("Aluminium hexagons", "two");
  create("Aluminium squares", "two");
  ASSERT_TRUE(client().wait_for_state("jobs/1", v1::Job::RUNNING));
  ASSERT_TRUE(client().cancel("jobs/3").ok());
  EXPECT_THAT(found(""), ElementsAre("jobs/3", "jobs/2", "jobs/1"));
  EXPECT_THAT(found("state = RUNNING"), ElementsAre("jobs/1"));
  EXPECT_THAT(found("state = CANCELLED"), ElementsAre("jobs/3"));
  EXPECT_THAT(found("label.batch = \"two\""), ElementsAre("jobs/3", "jobs/2"));
  EXPECT_THAT(found("label.batch = two AND state = PENDING"), ElementsAre("jobs/2"));
  EXPECT_THAT(found("title : \"HEXAGONS\""), ElementsAre("jobs/2", "jobs/1"));
  EXPECT_THAT(found("title : aluminium AND title : squares"), ElementsAre("jobs/3"));
  EXPECT_THAT(found("label.other = two"), IsEmpty());
  EXPECT_THAT(found("   "), SizeIs(3));
  ASSERT_TRUE(client().remove("jobs/3").ok());
  EXPECT_THAT(found("label.batch = two"), ElementsAre("jobs/2")) << "Its labels went with it.";
  create("Of \"two\" words", "a \"b\"");
  EXPECT_THAT(found(R"(label."batch"="a \"b\""  AND title:"of \"TWO\"" AND title : words)"), ElementsAre("jobs/4"));
}

TEST_F(JobListTest, PagesAreNewestFirstAndStayInPlaceWhenJobsAreMadeAndDeleted) {
  for (int i = 0; i < 5; ++i) create("case", "one");
  v1::ListJobsRequest newest;
  newest.set_page_size(2);
  v1::ListJobsRequest oldest = newest;
  oldest.set_order_by("create_time");
  EXPECT_THAT(page(newest), ElementsAre("jobs/5", "jobs/4"));
  EXPECT_THAT(page(oldest), ElementsAre("jobs/1", "jobs/2"));
  create("case", "one");
  ASSERT_TRUE(client().cancel("jobs/4").ok());
  ASSERT_TRUE(client().remove("jobs/4").ok());
  EXPECT_THAT(page(newest), ElementsAre("jobs/3", "jobs/2"));
  EXPECT_THAT(page(newest), ElementsAre("jobs/1"));
  EXPECT_TRUE(newest.page_token().empty());
  EXPECT_THAT(page(oldest), ElementsAre("jobs/3", "jobs/5"));
  EXPECT_THAT(page(oldest), ElementsAre("jobs/6")) << "What is new comes last.";
  EXPECT_TRUE(oldest.page_token().empty());
}

TEST_F(JobListTest, AFaultOfAFilterIsNamedWithItsPlaceAndWhatIsUnderstood) {
  for (const auto& [filter, words] :
       {std::pair{"speed = 3", "position 1: expected state, owner, label.KEY or title"},
        std::pair{"state = DONE", "position 9: expected one of PENDING, RUNNING"},
        std::pair{"state = JOB_STATE_UNSPECIFIED", "position 9"},
        std::pair{"state : RUNNING", "position 7: expected ="},
        std::pair{"state = RUNNING OR title : a", "position 17: expected AND or the end"},
        std::pair{"state = RUNNING AND", "position 20"},
        std::pair{"title : \"open", "position 9: the quoted text that starts here has no closing quote"},
        std::pair{"label.a =", "position 10: expected a value"}, std::pair{"title = a", "joined by AND"}})
    EXPECT_THAT(refusal("filter", filter), HasSubstr(words)) << filter;
}

TEST_F(JobListTest, AnOrderATokenOrASizeThatIsNoneIsRefused) {
  for (int i = 0; i < 3; ++i) create("case", "one");
  v1::ListJobsRequest request;
  for (const char* order : {"create_time desc", " name  desc ", "name asc"}) {
    request.set_order_by(order);
    EXPECT_TRUE(client().try_to(request).ok()) << order;
  }
  for (const char* order : {"state", "name down", "name desc create_time", "desc"})
    EXPECT_THAT(refusal("order_by", order), HasSubstr("order_by")) << order;
  for (const char* token : {"17", "x", "-1-", "99999999999999999999-0", "nonsense"})
    EXPECT_THAT(refusal("page_token", token), HasSubstr("page_token")) << token;
  request.clear_order_by();
  request.set_page_size(2);
  page(request);
  request.set_filter("state = PENDING");
  EXPECT_THAT(client().try_to(request).error_message(), HasSubstr("with the same filter"));
  request.set_page_size(-1);
  EXPECT_THAT(client().try_to(request).error_message(), HasSubstr("page_size"));
}

}  // namespace
}  // namespace cellcrush::testing
