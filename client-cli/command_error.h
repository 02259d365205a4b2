#pragma once

#include <grpcpp/support/status.h>

#include <exception>
#include <string>

#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/problem.pb.h"

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

/// Ends a command early: an exit code, a message for the user, and the problems of the case, if any.
class CommandError : public std::exception {
 public:
  CommandError(ExitCode code, std::string message, v1::ProblemList problems = {});

  [[nodiscard]] ExitCode code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }
  [[nodiscard]] const v1::ProblemList& problems() const { return problems_; }
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

 private:
  ExitCode code_;
  std::string message_;
  v1::ProblemList problems_;
};

/// Throws CommandError (refused).
[[noreturn]] void refuse(const std::string& message);

/// The error for a call that failed, with the problems from its status details.
CommandError error_of(const grpc::Status& status);

/// The error for a case with problems.
CommandError problems_error(v1::ProblemList problems);

/// The problems as text, one group each: "field = value: message", with the remedy on its own line.
std::string problems_text(const v1::ProblemList& problems);

/// Notes on implausible values of a case, as text: "Note: field = value message remedy", wrapped to the terminal's
/// width.
std::string notes_text(const google::protobuf::RepeatedPtrField<v1::Problem>& notes);

/// Prints the error: as text on stderr, or with `json` as one object on stdout. That is a cellcrush.v1.ProblemList if
/// there are problems, else a google.rpc.Status.
void print_error(const CommandError& error, bool json);

}  // namespace cellcrush::client
