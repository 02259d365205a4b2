#include "exit_code.h"

namespace cellcrush::client {

ExitCode exit_code_of(grpc::StatusCode code) {
  switch (code) {
    case grpc::StatusCode::OK: return ExitCode::done;
    case grpc::StatusCode::NOT_FOUND: return ExitCode::not_found;
    case grpc::StatusCode::UNAVAILABLE: return ExitCode::no_connection;
    case grpc::StatusCode::CANCELLED:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::UNKNOWN:
    case grpc::StatusCode::INTERNAL:
    case grpc::StatusCode::DATA_LOSS: return ExitCode::cut_off;
    default: return ExitCode::refused;
  }
}

ExitCode exit_code_of(v1::Job::State state) {
  switch (state) {
    case v1::Job::SUCCEEDED: return ExitCode::done;
    case v1::Job::FAILED:
    case v1::Job::CANCELLED: return ExitCode::job_failed;
    default: return ExitCode::cut_off;
  }
}

bool is_final(v1::Job::State state) { return exit_code_of(state) != ExitCode::cut_off; }

}  // namespace cellcrush::client
