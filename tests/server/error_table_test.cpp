#include "error_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace cellcrush::rpc {
namespace {

using ::testing::HasSubstr;
using Problems = google::protobuf::RepeatedPtrField<v1::Problem>;

void add(Problems& problems, const std::string& field) {
  auto& problem = *problems.Add();
  problem.set_field(field);
  problem.set_message("is wrong.");
  problem.set_remedy("Mend it.");
  problem.set_kind(v1::Problem::INVALID);
}

v1::ProblemList listed(const grpc::Status& status) {
  google::rpc::Status details;
  EXPECT_TRUE(details.ParseFromString(status.error_details()));
  EXPECT_EQ(details.code(), status.error_code());
  EXPECT_EQ(details.details_size(), 2);
  google::rpc::BadRequest bad_request;
  EXPECT_TRUE(details.details(0).UnpackTo(&bad_request));
  v1::ProblemList list;
  EXPECT_TRUE(details.details(1).UnpackTo(&list));
  EXPECT_EQ(bad_request.field_violations_size(), list.problems_size());
  return list;
}

TEST(ErrorTable, ManyProblemsFitIntoATrailerAndSayThatThereAreMore) {
  Problems problems;
  for (int i = 0; i < 500; ++i) add(problems, "lattice.frame.nodes[" + std::to_string(i) + "].x_mm");
  const auto status = status_of(problems);
  EXPECT_LT(status.error_details().size() * 4 / 3 + status.error_message().size(), 7500U);
  const auto list = listed(status);
  EXPECT_GT(list.problems_size(), 10);
  const auto& note = list.problems(list.problems_size() - 1);
  EXPECT_THAT(note.message(), HasSubstr(std::to_string(500 - (list.problems_size() - 1))));
  EXPECT_THAT(note.remedy(), HasSubstr("CheckCase"));
}

// One try a problem that does not fit, each of all that are left, would take hours.
TEST(ErrorTable, AHundredThousandProblemsAreAnsweredAsManyAre) {
  Problems problems;
  for (int i = 0; i < 100'000; ++i) add(problems, "axes[0].linear");
  const auto list = listed(status_of(problems, "sweep"));
  EXPECT_GT(list.problems_size(), 10);
  EXPECT_LT(list.problems_size(), 100);
}

TEST(ErrorTable, AHugeValueIsCut) {
  Problems problems;
  add(problems, "title");
  problems[0].set_value(std::string(100'000, 'x'));
  EXPECT_LT(status_of(problems).error_details().size(), 5000U);
}

TEST(ErrorTable, AFaultOfTheDaemonIsInternalAndWantOfMemoryExhausted) {
  EXPECT_EQ(status_of(ServiceError(ServiceError::Kind::internal, "why")).error_code(), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(status_of(std::bad_alloc()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

}  // namespace
}  // namespace cellcrush::rpc
