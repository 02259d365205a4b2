#include "rpc/job_query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error.h"
#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(const std::string& filter) {
  try {
    parse_filter(filter);
  } catch (const InvalidField& refused) {
    return refused.what();
  }
  return "";
}

TEST(JobFilter, ReadsConditionsJoinedByAnd) {
  const auto filter = parse_filter(R"(state = RUNNING AND label.batch="a \"b\""  AND title:"few cells" AND title : x)");
  EXPECT_EQ(filter.states, std::vector<v1::Job::State>{v1::Job::RUNNING});
  ASSERT_EQ(filter.labels.size(), 1U);
  EXPECT_EQ(filter.labels[0].first, "batch");
  EXPECT_EQ(filter.labels[0].second, "a \"b\"");
  EXPECT_EQ(filter.titles, (std::vector<std::string>{"few cells", "x"}));
  EXPECT_EQ(parse_filter(R"(label."a key" = 7)").labels[0].first, "a key");
}

TEST(JobFilter, NothingIsNoCondition) {
  for (const char* text : {"", "   "}) {
    const auto filter = parse_filter(text);
    EXPECT_TRUE(filter.states.empty() && filter.labels.empty() && filter.titles.empty());
  }
}

TEST(JobFilter, AFaultIsNamedWithItsPlaceAndWhatIsUnderstood) {
  EXPECT_THAT(refusal_of("speed = 3"), HasSubstr("position 1: expected state, owner, label.KEY or title"));
  EXPECT_THAT(refusal_of("state = DONE"), HasSubstr("position 9: expected one of PENDING, RUNNING"));
  EXPECT_THAT(refusal_of("state = JOB_STATE_UNSPECIFIED"), HasSubstr("position 9"));
  EXPECT_THAT(refusal_of("state : RUNNING"), HasSubstr("position 7: expected ="));
  EXPECT_THAT(refusal_of("state = RUNNING OR title : a"), HasSubstr("position 17: expected AND or the end"));
  EXPECT_THAT(refusal_of("state = RUNNING AND"), HasSubstr("position 20"));
  EXPECT_THAT(refusal_of("title : \"open"),
              HasSubstr("position 9: the quoted text that starts here has no closing quote"));
  EXPECT_THAT(refusal_of("label.a ="), HasSubstr("position 10: expected a value"));
  EXPECT_THAT(refusal_of("title = a"), HasSubstr("joined by AND"));
}

TEST(JobOrder, IsByTimeOrName) {
  EXPECT_TRUE(parse_newest_first(""));
  EXPECT_TRUE(parse_newest_first("create_time desc"));
  EXPECT_TRUE(parse_newest_first(" name  desc "));
  EXPECT_FALSE(parse_newest_first("create_time"));
  EXPECT_FALSE(parse_newest_first("name asc"));
  for (const char* text : {"state", "name down", "name desc create_time", "desc"})
    EXPECT_THROW(parse_newest_first(text), InvalidField) << text;
}

TEST(Page, ATokenBelongsToItsList) {
  const auto token = page_token(17, "all");
  EXPECT_EQ(read_page(0, token, "all").after, 17);
  EXPECT_EQ(read_page(0, "", "all").size, 50);
  EXPECT_EQ(read_page(5000, "", "all").size, 1000);
  EXPECT_EQ(read_full_page(5000, token, "all").size, 5000);
  EXPECT_EQ(read_full_page(5000, token, "all").after, 17);
  EXPECT_GT(read_full_page(0, "", "all").size, 1'000'000);
  EXPECT_THROW(read_full_page(-1, "", "all"), InvalidField);
  EXPECT_THROW(read_full_page(0, token, "others"), InvalidField);
  EXPECT_THROW(read_page(-1, "", "all"), InvalidField);
  EXPECT_THROW(read_page(0, token, "others"), InvalidField);
  for (const char* text : {"17", "x", "-1-", "99999999999999999999-0"})
    EXPECT_THROW(read_page(0, text, "all"), InvalidField) << text;
}

}  // namespace
}  // namespace cellcrush::rpc
