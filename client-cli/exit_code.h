#pragma once

#include <grpcpp/support/status.h>

#include "cellcrush/v1/job.pb.h"

namespace cellcrush::client {

/// What the program ends with. Scripts rely on the numbers.
enum class ExitCode : int {
  done = 0,
  job_failed = 1,     ///< the job FAILED or was CANCELLED
  refused = 2,        ///< usage, an invalid case, or a request that the server refuses
  no_connection = 3,  ///< no server answers
  cut_off = 4,        ///< the connection or the server broke before the end
  not_found = 5,      ///< no such job, sweep or preset
  interrupted = 130,  ///< Ctrl-C; the job goes on
};

/// The exit code for a call that ended with `code`.
ExitCode exit_code_of(grpc::StatusCode code);

/// The exit code for a watch that ended with the job in `state`.
ExitCode exit_code_of(v1::Job::State state);

/// Whether a job in this state will change no more.
bool is_final(v1::Job::State state);

}  // namespace cellcrush::client
