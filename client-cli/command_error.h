#pragma once

#include <grpcpp/support/status.h>

#include <exception>
#include <string>

#include "cellcrush/v1/problem.pb.h"
#include "exit_code.h"

namespace cellcrush::client {

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
