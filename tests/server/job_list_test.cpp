#include <gmock/gmock.h>

#include "server/daemon_fixture.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class JobListTest : public DaemonFixture {
 protected:
  void SetUp() override {
    auto options = default_options();
    options.workers = 1;
    start(options);
  }

  std::string create(const std::string& title, const std::string& batch) {
    v1::CreateJobRequest request;
    *request.mutable_case_() = endless_case();
    request.mutable_case_()->set_title(title);
    (*request.mutable_labels())["batch"] = batch;
    v1::Job job;
    const auto status = client().jobs->CreateJob(bounded_context().get(), request, &job);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return job.name();
  }

  // The names of a page, and in `request` the token of the next one.
  std::vector<std::string> page(v1::ListJobsRequest& request) {
    v1::ListJobsResponse response;
    const auto status = client().jobs->ListJobs(bounded_context().get(), request, &response);
    EXPECT_TRUE(status.ok()) << status.error_message();
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

  grpc::Status refusal(const v1::ListJobsRequest& request) {
    v1::ListJobsResponse response;
    return client().jobs->ListJobs(bounded_context().get(), request, &response);
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
}

TEST_F(JobListTest, PagesStayInPlaceWhenJobsAreMadeAndDeleted) {
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

TEST_F(JobListTest, WhatIsNotUnderstoodIsNamed) {
  for (int i = 0; i < 3; ++i) create("case", "one");
  v1::ListJobsRequest request;
  request.set_filter("state = DONE");
  const auto filter = refusal(request);
  EXPECT_EQ(filter.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(filter.error_message(), HasSubstr("filter cannot be read at position 9"));
  request.clear_filter();
  request.set_order_by("speed");
  EXPECT_THAT(refusal(request).error_message(), HasSubstr("order_by"));
  request.clear_order_by();
  request.set_page_token("nonsense");
  EXPECT_EQ(refusal(request).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  request.clear_page_token();
  request.set_page_size(2);
  page(request);
  request.set_filter("state = PENDING");
  EXPECT_THAT(refusal(request).error_message(), HasSubstr("with the same filter"));
  request.set_page_size(-1);
  EXPECT_THAT(refusal(request).error_message(), HasSubstr("page_size"));
}

}  // namespace
}  // namespace cellcrush::testing
