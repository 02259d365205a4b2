#pragma once

#include <google/protobuf/repeated_ptr_field.h>
#include <grpcpp/support/status.h>

#include <exception>
#include <string>

#include "cellcrush/v1/problem.pb.h"
#include "error.h"

namespace cellcrush {

// The one place that turns errors into gRPC statuses.

/// INVALID_ARGUMENT for a refused case, or another subject that has fields of one. The details hold a
/// google.rpc.Status with BadRequest and cellcrush.v1.ProblemList. A trailer may have 8 KiB: problems that do not fit
/// are counted in a last entry, which refers to CheckCase when the subject is a case.
/// REQUIRES: there is at least one problem.
grpc::Status status_of(const google::protobuf::RepeatedPtrField<v1::Problem>& problems,
                       const std::string& subject = "case");

/// A refused argument of a call, with its field in the details. The message goes on from the field's name: "is
/// negative."
grpc::Status invalid_argument(const std::string& field, const std::string& message, const std::string& remedy);

/// Anything that was thrown.
grpc::Status status_of(const std::exception& error);

/// Runs the body of a call, which gives a status, and turns what it throws into one.
template <class Body>
grpc::Status answer(const Body& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    return status_of(error);
  }
}

}  // namespace cellcrush
