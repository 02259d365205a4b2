#include <gtest/gtest.h>

#include "command_error.h"

namespace cellcrush::client {
namespace {

TEST(ExitCode, EveryStatusHasItsCode) {
  using grpc::StatusCode;
  EXPECT_EQ(exit_code_of(StatusCode::OK), ExitCode::done);
  for (const StatusCode code :
       {StatusCode::INVALID_ARGUMENT, StatusCode::FAILED_PRECONDITION, StatusCode::UNIMPLEMENTED,
        StatusCode::ALREADY_EXISTS, StatusCode::PERMISSION_DENIED, StatusCode::UNAUTHENTICATED,
        StatusCode::RESOURCE_EXHAUSTED, StatusCode::ABORTED, StatusCode::OUT_OF_RANGE}) {
    EXPECT_EQ(exit_code_of(code), ExitCode::refused) << code;
  }
  EXPECT_EQ(exit_code_of(StatusCode::UNAVAILABLE), ExitCode::no_connection);
  for (const StatusCode code : {StatusCode::CANCELLED, StatusCode::DEADLINE_EXCEEDED, StatusCode::UNKNOWN,
                                StatusCode::INTERNAL, StatusCode::DATA_LOSS}) {
    EXPECT_EQ(exit_code_of(code), ExitCode::cut_off) << code;
  }
  EXPECT_EQ(exit_code_of(StatusCode::NOT_FOUND), ExitCode::not_found);
}

TEST(ExitCode, AJobsEndHasItsCode) {
  EXPECT_EQ(exit_code_of(v1::Job::SUCCEEDED), ExitCode::done);
  EXPECT_EQ(exit_code_of(v1::Job::FAILED), ExitCode::job_failed);
  EXPECT_EQ(exit_code_of(v1::Job::CANCELLED), ExitCode::job_failed);
  for (const v1::Job::State state : {v1::Job::PENDING, v1::Job::RUNNING, v1::Job::SUSPENDED, v1::Job::CANCELLING})
    EXPECT_FALSE(is_final(state));
}

TEST(ExitCode, TheNumbersAreFixed) {
  EXPECT_EQ(static_cast<int>(ExitCode::job_failed), 1);
  EXPECT_EQ(static_cast<int>(ExitCode::refused), 2);
  EXPECT_EQ(static_cast<int>(ExitCode::no_connection), 3);
  EXPECT_EQ(static_cast<int>(ExitCode::cut_off), 4);
  EXPECT_EQ(static_cast<int>(ExitCode::not_found), 5);
  EXPECT_EQ(static_cast<int>(ExitCode::interrupted), 130);
}

}  // namespace
}  // namespace cellcrush::client
