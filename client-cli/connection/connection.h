#pragma once

#include <grpcpp/grpcpp.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"
#include "command_error.h"
#include "connection/credentials.h"

namespace cellcrush::client {

/// A channel to one server, with a stub for each service. It connects on first use, and says within two seconds when no
/// server answers, within one when one does not let it in. Not thread-safe, except that calls on the stubs are.
class Connection {
 public:
  /// `address` as find_server_address answers it.
  explicit Connection(std::string address, Credentials credentials = {});

  v1::Cases::Stub& cases();
  v1::Jobs::Stub& jobs();
  v1::Sweeps::Stub& sweeps();
  v1::Admin::Stub& admin();

  /// Whether the server answers within `patience`.
  bool wait(std::chrono::milliseconds patience);

  /// One call with one answer. Throws CommandError when it does not end with OK, takes longer than `patience`, or would
  /// be larger than a server takes.
  template <typename Stub, typename Request, typename Response>
  Response call(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                const Request& request, std::chrono::seconds patience = kPatience) {
    check_request_size(static_cast<std::int64_t>(request.ByteSizeLong()));
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + patience);
    Response response;
    const grpc::Status status = (stub.*method)(&context, request, &response);
    if (!status.ok()) throw error_about(name_in(request), status);
    return response;
  }

  /// The error for a call about `name`, a job, a sweep or "preset:NAME", that did not end with OK. For a name that does
  /// not exist it asks the server which one may be meant.
  CommandError error_about(const std::string& name, const grpc::Status& status);

  static constexpr std::chrono::seconds kPatience{60};
  /// Largest request that a server takes, in bytes: 4 MiB.
  static constexpr std::int64_t kLargestRequest = 4 * 1024 * 1024;

 private:
  template <typename Request>
  static std::string name_in(const Request& request) {
    if constexpr (std::is_same_v<Request, v1::GetPresetRequest>) return "preset:" + request.name();
    if constexpr (requires { request.name(); }) return request.name();
    return {};
  }

  static void check_request_size(std::int64_t size);
  void require_server();
  /// Why the channel does not connect, in gRPC's words.
  std::string last_failure();

  std::string address_;
  Credentials credentials_;
  std::shared_ptr<grpc::Channel> channel_;
  bool connected_ = false;
  std::unique_ptr<v1::Cases::Stub> cases_;
  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Sweeps::Stub> sweeps_;
  std::unique_ptr<v1::Admin::Stub> admin_;
};

}  // namespace cellcrush::client
