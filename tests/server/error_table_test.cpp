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

void add(Problems& problems, const std::string& field, v1::Problem::Kind kind) {
  auto& problem = *problems.Add();
  problem.set_field(field);
  problem.set_message("is wrong.");
  problem.set_remedy("Mend it.");
  problem.set_kind(kind);
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

TEST(ErrorTable, EveryProblemOfACaseIsListed) {
  Problems problems;
  add(problems, "contact.friction", v1::Problem::INVALID);
  add(problems, "depth_mm", v1::Problem::INVALID);
  const auto status = status_of(problems);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(status.error_message(), HasSubstr("contact.friction is wrong."));
  const auto list = listed(status);
  ASSERT_EQ(list.problems_size(), 2);
  EXPECT_EQ(list.problems(1).field(), "depth_mm");
  EXPECT_EQ(list.problems(1).remedy(), "Mend it.");
}

TEST(ErrorTable, ManyProblemsFitIntoATrailerAndSayThatThereAreMore) {
  Problems problems;
  for (int i = 0; i < 500; ++i)
    add(problems, "lattice.frame.nodes[" + std::to_string(i) + "].x_mm", v1::Problem::INVALID);
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
  for (int i = 0; i < 100'000; ++i) add(problems, "axes[0].linear", v1::Problem::INVALID);
  const auto list = listed(status_of(problems, "sweep"));
  EXPECT_GT(list.problems_size(), 10);
  EXPECT_LT(list.problems_size(), 100);
}

TEST(ErrorTable, AHugeValueIsCut) {
  Problems problems;
  add(problems, "title", v1::Problem::INVALID);
  problems[0].set_value(std::string(100'000, 'x'));
  EXPECT_LT(status_of(problems).error_details().size(), 5000U);
}

TEST(ErrorTable, EveryKindHasItsStatus) {
  using Kind = ServiceError::Kind;
  const auto code = [](Kind kind) { return status_of(ServiceError(kind, "why")).error_code(); };
  EXPECT_EQ(code(Kind::invalid), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(code(Kind::not_found), grpc::StatusCode::NOT_FOUND);
  EXPECT_EQ(code(Kind::already_exists), grpc::StatusCode::ALREADY_EXISTS);
  EXPECT_EQ(code(Kind::failed_precondition), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(code(Kind::out_of_range), grpc::StatusCode::OUT_OF_RANGE);
  EXPECT_EQ(code(Kind::storage_full), grpc::StatusCode::RESOURCE_EXHAUSTED);
  EXPECT_EQ(code(Kind::data_loss), grpc::StatusCode::DATA_LOSS);
  EXPECT_EQ(code(Kind::internal), grpc::StatusCode::INTERNAL);
  EXPECT_EQ(status_of(std::bad_alloc()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
}

}  // namespace
}  // namespace cellcrush::rpc
