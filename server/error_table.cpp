#include "error_table.h"

#include <spdlog/spdlog.h>

#include <array>
#include <cstddef>
#include <new>

#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "log_format.h"

namespace cellcrush {
namespace {

using ProblemList = google::protobuf::RepeatedPtrField<v1::Problem>;

constexpr std::size_t kMostDetails = 4500;  // bytes; keeps the base64 trailer below 8 KiB
constexpr std::size_t kMostMessage = 600;
constexpr std::size_t kMostValue = 100;

grpc::StatusCode code_of(ServiceError::Kind kind) {
  switch (kind) {
    case ServiceError::Kind::invalid: return grpc::StatusCode::INVALID_ARGUMENT;
    case ServiceError::Kind::not_found: return grpc::StatusCode::NOT_FOUND;
    case ServiceError::Kind::already_exists: return grpc::StatusCode::ALREADY_EXISTS;
    case ServiceError::Kind::failed_precondition: return grpc::StatusCode::FAILED_PRECONDITION;
    case ServiceError::Kind::aborted: return grpc::StatusCode::ABORTED;
    case ServiceError::Kind::out_of_range: return grpc::StatusCode::OUT_OF_RANGE;
    case ServiceError::Kind::storage_full:
    case ServiceError::Kind::exhausted: return grpc::StatusCode::RESOURCE_EXHAUSTED;
    case ServiceError::Kind::unavailable: return grpc::StatusCode::UNAVAILABLE;
    case ServiceError::Kind::unauthenticated: return grpc::StatusCode::UNAUTHENTICATED;
    case ServiceError::Kind::permission_denied: return grpc::StatusCode::PERMISSION_DENIED;
    case ServiceError::Kind::cancelled: return grpc::StatusCode::CANCELLED;
    case ServiceError::Kind::data_loss: return grpc::StatusCode::DATA_LOSS;
    case ServiceError::Kind::internal: break;
  }
  return grpc::StatusCode::INTERNAL;
}

constexpr std::array kCodeNames = {
    "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
    "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
    "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
    "DATA_LOSS", "UNAUTHENTICATED"};

std::string shorten(const std::string& text, std::size_t most) {
  return text.size() <= most ? text : cut_text(text, most) + "...";
}

// A message as callers get it. It may hold bytes of a request or of a file's name.
std::string message_of(const std::string& text) { return shorten(printable_lines(text), kMostMessage); }

std::string sentence_of(const ProblemList& problems, const std::string& subject) {
  std::string out = "The " + subject + " has ";
  out += problems.size() == 1 ? "a problem: " : std::to_string(problems.size()) + " problems: ";
  bool first = true;
  for (const auto& problem : problems) {
    out += (first ? "" : " ") + problem.field() + " " + problem.message();
    first = false;
  }
  return message_of(out);
}

std::string details_of(const std::string& message, const ProblemList& problems) {
  google::rpc::Status status;
  status.set_code(grpc::StatusCode::INVALID_ARGUMENT);
  status.set_message(message);
  google::rpc::BadRequest bad_request;
  v1::ProblemList list;
  for (const auto& problem : problems) {
    auto& violation = *bad_request.add_field_violations();
    violation.set_field(problem.field());
    violation.set_description(problem.message() + (problem.remedy().empty() ? "" : " " + problem.remedy()));
    v1::Problem& listed = *list.add_problems();
    listed = problem;
    listed.set_value(shorten(problem.value(), kMostValue));
  }
  status.add_details()->PackFrom(bad_request);
  status.add_details()->PackFrom(list);
  return status.SerializeAsString();
}

v1::Problem note_on_rest(const std::string& subject, int left_out) {
  return invalid_problem(
      subject, "has " + std::to_string(left_out) + " more problems.",
      subject == "case" ? "CheckCase lists them all." : "Fix these first; the same call then lists the rest.");
}

// Number of leading problems that may fit: the details hold their texts twice.
int most_that_fit(const ProblemList& problems) {
  std::size_t bytes = 0;
  int count = 0;
  for (; count < problems.size(); ++count) {
    const v1::Problem& next = problems[count];
    bytes += 2 * (next.field().size() + next.message().size() + next.remedy().size());
    if (bytes > kMostDetails) break;
  }
  return count;
}

// Details with as many problems as fit, and the number of the rest.
std::string bounded_details(const std::string& message, const ProblemList& problems, const std::string& subject) {
  std::string out;
  for (int kept = most_that_fit(problems); kept >= 0; --kept) {
    ProblemList some(problems.begin(), problems.begin() + kept);
    if (kept < problems.size()) *some.Add() = note_on_rest(subject, problems.size() - kept);
    out = details_of(message, some);
    if (out.size() <= kMostDetails) break;
  }
  return out;
}

// Has details, unlike a status that gRPC makes of a broken connection.
grpc::Status own_status(grpc::StatusCode code, const std::string& message) {
  google::rpc::Status status;
  status.set_code(code);
  return {code, message, status.SerializeAsString()};
}

}  // namespace

grpc::Status status_of(const ProblemList& problems, const std::string& subject) {
  const std::string message = sentence_of(problems, subject);
  return {grpc::StatusCode::INVALID_ARGUMENT, message, bounded_details(message, problems, subject)};
}

grpc::Status invalid_argument(const std::string& field, const std::string& message, const std::string& remedy) {
  ProblemList problems;
  *problems.Add() = invalid_problem(field, message, remedy);
  const std::string sentence = message_of(field + " " + message + " " + remedy);
  return {grpc::StatusCode::INVALID_ARGUMENT, sentence, bounded_details(sentence, problems, "request")};
}

v1::Problem invalid_problem(const std::string& field, const std::string& message, const std::string& remedy) {
  v1::Problem out;
  out.set_field(field);
  out.set_message(message);
  out.set_remedy(remedy);
  out.set_kind(v1::Problem::INVALID);
  return out;
}

std::string cut_text(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  text.resize(most);
  return text;
}

grpc::Status status_of(const std::exception& error) {
  if (const auto* refused = dynamic_cast<const ServiceError*>(&error)) {
    const bool is_fault =
        refused->kind() == ServiceError::Kind::internal || refused->kind() == ServiceError::Kind::data_loss;
    if (is_fault) spdlog::error("A call failed: {}", error.what());
    return own_status(code_of(refused->kind()), message_of(error.what()));
  }
  if (const auto* refused = dynamic_cast<const RefusedCase*>(&error))
    return status_of(refused->problems, refused->subject);
  if (const auto* refused = dynamic_cast<const InvalidField*>(&error))
    return invalid_argument(refused->field(), refused->message(), refused->remedy());
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
    return own_status(grpc::StatusCode::RESOURCE_EXHAUSTED,
                      "The daemon is out of memory. Use a smaller case, or try again later.");
  spdlog::error("A call failed: {}", error.what());
  return own_status(grpc::StatusCode::INTERNAL,
                    message_of(std::string("Internal error of the daemon: ") + error.what()));
}

const char* name_of(grpc::StatusCode code) {
  const auto index = static_cast<std::size_t>(code);
  return index < kCodeNames.size() ? kCodeNames.at(index) : "UNKNOWN";
}

}  // namespace cellcrush
