#pragma once

#include <google/protobuf/repeated_ptr_field.h>
#include <grpcpp/support/status.h>

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "cellcrush/v1/problem.pb.h"
#include "error.h"

namespace cellcrush {

// The one place that maps errors to gRPC statuses.

/// INVALID_ARGUMENT for a refused case, or for another subject with fields. The details hold a google.rpc.Status with
/// BadRequest and cellcrush.v1.ProblemList. A trailer holds at most 8 KiB: a last entry counts the problems that do not
/// fit, and refers to CheckCase if the subject is a case.
/// REQUIRES: at least one problem.
grpc::Status status_of(const google::protobuf::RepeatedPtrField<v1::Problem>& problems,
                       const std::string& subject = "case");

/// An invalid argument of a call, with its field in the details. The message continues from the field's name: "is
/// negative."
grpc::Status invalid_argument(const std::string& field, const std::string& message, const std::string& remedy);

/// A problem of the kind INVALID.
v1::Problem invalid_problem(const std::string& field, const std::string& message, const std::string& remedy);

/// Text of at most this many bytes, cut at the start of a character.
std::string cut_text(std::string text, std::size_t most);

/// A refused case, or another subject with fields. REQUIRES: at least one problem.
struct RefusedCase : std::runtime_error {
  explicit RefusedCase(google::protobuf::RepeatedPtrField<v1::Problem> found, std::string of = "case")
      : std::runtime_error(of + " refused"), problems(std::move(found)), subject(std::move(of)) {}

  google::protobuf::RepeatedPtrField<v1::Problem> problems;
  std::string subject;
};

/// The status for any exception.
grpc::Status status_of(const std::exception& error);

/// "PERMISSION_DENIED".
const char* name_of(grpc::StatusCode code);

/// Runs the body of a call. OK, or the status for its exception.
template <class Body>
grpc::Status answer(const Body& body) {
  try {
    body();
    return grpc::Status::OK;
  } catch (const std::exception& error) {
    return status_of(error);
  }
}

}  // namespace cellcrush
