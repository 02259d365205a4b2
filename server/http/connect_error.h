#pragma once

#include <grpcpp/support/status.h>

#include <string>

namespace cellcrush::http {

// Errors of the Connect protocol (https://connectrpc.com/docs/protocol#error-codes).

/// "not_found" for NOT_FOUND.
const char* connect_code(grpc::StatusCode code);

/// HTTP status of a unary call that ended with the code.
unsigned http_status(grpc::StatusCode code);

/// The error as JSON: code, message, and details from the google.rpc.Status in `error_details`.
std::string error_json(const grpc::Status& status);

/// Last envelope of a stream, without its prefix: "{}" or {"error": ...}.
std::string end_of_stream_json(const grpc::Status& status);

}  // namespace cellcrush::http
