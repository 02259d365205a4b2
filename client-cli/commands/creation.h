#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "commands/commands.h"
#include "connection/connection.h"

namespace cellcrush::client {

/// An id for a request that has none.
std::string new_request_id();

/// Makes the call, and repeats it while its answer is lost: the server knows the request by `id`. Throws CommandError:
/// cut_off, with the command line that repeats it, if the answer stays lost; as Connection::call for other failures.
void call_until_answered(Session& session, const std::string& id, std::chrono::seconds patience,
                         const std::function<grpc::Status(grpc::ClientContext&)>& call);

/// Creates a job or sweep, once at most. Throws the errors of call_until_answered.
template <typename Stub, typename Request, typename Response>
Response create(Session& session, Stub& stub,
                grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), Request request,
                std::chrono::seconds patience = Connection::kPatience) {
  if (request.request_id().empty()) request.set_request_id(new_request_id());
  Connection::check_request_size(static_cast<std::int64_t>(request.ByteSizeLong()));
  Response response;
  call_until_answered(session, request.request_id(), patience,
                      [&](grpc::ClientContext& context) { return (stub.*method)(&context, request, &response); });
  return response;
}

}  // namespace cellcrush::client
