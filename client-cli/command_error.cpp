#include "command_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "cellcrush/v1/case.pb.h"
#include "chart/display_text.h"
#include "google/rpc/status.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

namespace {

v1::ProblemList problems_in(const grpc::Status& status) {
  v1::ProblemList problems;
  google::rpc::Status envelope;
  if (!envelope.ParseFromString(status.error_details())) return problems;
  for (const auto& detail : envelope.details()) {
    v1::ProblemList part;
    if (detail.Is<v1::ProblemList>() && detail.UnpackTo(&part)) problems.MergeFrom(part);
  }
  return problems;
}

std::string message_of(const grpc::Status& status) {
  if (!status.error_message().empty()) return printable(status.error_message());
  switch (status.error_code()) {
    case grpc::StatusCode::UNIMPLEMENTED: return "the server does not support this call";
    case grpc::StatusCode::DEADLINE_EXCEEDED: return "the server did not answer in time";
    default: return fmt::format("the call ended with gRPC status {}", static_cast<int>(status.error_code()));
  }
}

int status_code_of(ExitCode code) {
  switch (code) {
    case ExitCode::no_connection:
    case ExitCode::cut_off: return grpc::StatusCode::UNAVAILABLE;
    case ExitCode::not_found: return grpc::StatusCode::NOT_FOUND;
    default: return grpc::StatusCode::INVALID_ARGUMENT;
  }
}

// Whether all problems concern the case rather than another part of the request, such as a filter.
bool are_of_case(const v1::ProblemList& problems) {
  return std::all_of(problems.problems().begin(), problems.problems().end(), [](const v1::Problem& problem) {
    const std::string field = problem.field().substr(0, problem.field().find_first_of(".["));
    return v1::Case::descriptor()->FindFieldByName(field) != nullptr;
  });
}

}  // namespace

CommandError::CommandError(ExitCode code, std::string message, v1::ProblemList problems)
    : code_(code), message_(std::move(message)), problems_(std::move(problems)) {}

void refuse(const std::string& message) { throw CommandError(ExitCode::refused, message); }

CommandError error_of(const grpc::Status& status) {
  v1::ProblemList problems = problems_in(status);
  if (problems.problems_size() > 0) return problems_error(std::move(problems));
  std::string message = message_of(status);
  // gRPC's message, with both sizes in bytes: "Received message larger than max (5000000 vs. 4194304)".
  if (message.find("larger than max") != std::string::npos) {
    message = "the message is over the size limit: " + message + "; make the case smaller";
  }
  if (status.error_code() == grpc::StatusCode::UNIMPLEMENTED) message = "not implemented by this server: " + message;
  return {exit_code_of(status.error_code()), std::move(message)};
}

CommandError problems_error(v1::ProblemList problems) {
  const int count = problems.problems_size();
  return {
      ExitCode::refused,
      fmt::format("the {} has {} problem{}", are_of_case(problems) ? "case" : "request", count, count == 1 ? "" : "s"),
      std::move(problems)};
}

std::string problems_text(const v1::ProblemList& problems) {
  std::string text;
  for (const v1::Problem& problem : problems.problems()) {
    text += printable(problem.field());
    if (!problem.value().empty()) text += " = " + printable(problem.value());
    text += ": " + printable(problem.message());
    if (problem.kind() == v1::Problem::UNIMPLEMENTED) text += " (not implemented by this server)";
    text += '\n';
    if (!problem.remedy().empty()) text += "    Remedy: " + printable(problem.remedy()) + '\n';
  }
  return text;
}

std::string notes_text(const google::protobuf::RepeatedPtrField<v1::Problem>& notes) {
  std::string text;
  for (const v1::Problem& note : notes) {
    const std::string value = note.value().empty() ? "" : " = " + note.value();
    const std::string what = fmt::format("{}{} {} {}", note.field(), value, note.message(), note.remedy());
    text += wrapped(printable(what), terminal_width(), "Note: ", "    ");
  }
  return text;
}

void print_error(const CommandError& error, bool json) {
  if (json) {
    if (error.problems().problems_size() > 0) {
      fmt::print("{}\n", json_text(error.problems()));
    } else {
      google::rpc::Status status;
      status.set_code(status_code_of(error.code()));
      status.set_message(error.message());
      fmt::print("{}\n", json_text(status));
    }
  }
  fmt::print(stderr, "cellcrush: {}\n", printable(error.message()));
  if (!json) fmt::print(stderr, "{}", problems_text(error.problems()));
}

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
