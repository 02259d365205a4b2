#pragma once

#include <grpcpp/grpcpp.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "cellcrush/v1/cases_service.grpc.pb.h"
#include "cellcrush/v1/jobs_service.grpc.pb.h"
#include "cellcrush/v1/sweeps_service.grpc.pb.h"
#include "command_error.h"
#include "connection/credentials.h"
#include "connection/server_epoch.h"

namespace cellcrush::client {

/// Pauses between attempts after the connection was lost.
inline constexpr std::array<std::chrono::milliseconds, 5> kPauses = {
    {std::chrono::milliseconds(250), std::chrono::milliseconds(500), std::chrono::seconds(1), std::chrono::seconds(2),
     std::chrono::seconds(4)}};

/// A channel to one server, with a stub for each service. It connects on first use. If no server answers, it reports
/// that within two seconds, and within one if the server refuses the connection. Its calls are for the server that
/// answered the first of them (ServerEpoch). Not thread-safe, except for calls on the stubs.
class Connection {
 public:
  /// A server that may be another user's is asked whose it is; if it is not this user's, stderr says so, and calls that
  /// change something are refused.
  explicit Connection(ServerAddress address, Credentials credentials = {});

  v1::Cases::Stub& cases() { return require_server(), *cases_; }
  v1::Jobs::Stub& jobs() { return require_server(), *jobs_; }
  v1::Sweeps::Stub& sweeps() { return require_server(), *sweeps_; }
  v1::Admin::Stub& admin() { return require_server(), *admin_; }

  [[nodiscard]] const std::string& address() const { return address_; }

  /// Whether the server answers within `patience`.
  bool wait(std::chrono::milliseconds patience);

  /// Notices whether the connection was lost while nobody called, so that the next call does not fail by that.
  void refresh() { static_cast<void>(last_failure()); }

  /// Gives a call the credentials and, if it is above 0, a time limit.
  void prepare(grpc::ClientContext& context, std::chrono::milliseconds patience = {}) const;

  /// One unary call. Throws CommandError if it fails, takes longer than `patience`, or exceeds the size that a server
  /// accepts.
  template <typename Stub, typename Request, typename Response>
  Response call(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
                const Request& request, std::chrono::seconds patience = kPatience) {
    check_request_size(static_cast<std::int64_t>(request.ByteSizeLong()));
    require_named(*Request::descriptor());
    grpc::ClientContext context;
    prepare(context, patience);
    Response response;
    const grpc::Status status = (stub.*method)(&context, request, &response);
    if (!status.ok()) throw error_about(name_in(request), status);
    return response;
  }

  /// The same for a request that only names something.
  template <typename Stub, typename Request, typename Response>
  Response call_for(const std::string& name, Stub& stub,
                    grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*)) {
    Request request;
    request.set_name(name);
    return call(stub, method, request);
  }

  /// Reads a stream to its end, at most for `patience`; `take` returns false to cancel it. Returns how it ended.
  template <typename Stub, typename Request, typename Part>
  grpc::Status read(Stub& stub,
                    std::unique_ptr<grpc::ClientReader<Part>> (Stub::*method)(grpc::ClientContext*, const Request&),
                    const Request& request, std::chrono::seconds patience,
                    const std::function<bool(const std::type_identity_t<Part>& part)>& take) {
    grpc::ClientContext context;
    prepare(context, patience);
    const auto reader = (stub.*method)(&context, request);
    Part part;
    while (reader->Read(&part)) {
      if (!take(part)) context.TryCancel();
    }
    return reader->Finish();
  }

  /// The error for a failed call about `name`: a job, a sweep or "preset:NAME". If the name does not exist, asks the
  /// server for a similar one.
  CommandError error_about(const std::string& name, const grpc::Status& status);

  /// Whether another server has answered than at first, or one with other data; it refuses all calls.
  [[nodiscard]] bool meets_another_server() const { return epoch_->has_changed(); }

  static constexpr std::chrono::seconds kPatience{60};
  /// Largest request that a server accepts, in bytes: 4 MiB.
  static constexpr std::int64_t kLargestRequest = 4 * 1024 * 1024;
  /// Throws CommandError (refused) for a larger one.
  static void check_request_size(std::int64_t size);

 private:
  template <typename Request>
  static std::string name_in(const Request& request) {
    if constexpr (std::is_same_v<Request, v1::GetPresetRequest>) return "preset:" + request.name();
    if constexpr (requires { request.name(); }) return request.name();
    return {};
  }

  /// A call that may fail: whether it went well.
  template <typename Stub, typename Request, typename Response>
  bool probe(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
             const Request& request, Response& response) const;
  /// An existing name similar to `name`, which does not exist. For "preset:NAME" a similar preset; otherwise the job or
  /// sweep with the same number ("job/3", "jobs3"), or a preset given without its prefix. Empty if there is none.
  /// Failed calls count as not found.
  [[nodiscard]] std::string find_nearest_name(const std::string& name) const;
  [[nodiscard]] std::string find_nearest_preset(const std::string& word) const;

  void require_server();
  /// Throws CommandError (refused) if the server is another user's, was not named, and the request changes something.
  void require_named(const google::protobuf::Descriptor& request) const;
  void find_owner();
  /// Why the channel does not connect, in gRPC's words.
  std::string last_failure();

  std::string address_;
  bool may_be_others_;
  std::string owner_;  ///< empty: this user, or it does not matter
  Credentials credentials_;
  std::shared_ptr<ServerEpoch> epoch_ = std::make_shared<ServerEpoch>();
  std::shared_ptr<grpc::Channel> channel_;
  bool connected_ = false;
  std::unique_ptr<v1::Cases::Stub> cases_;
  std::unique_ptr<v1::Jobs::Stub> jobs_;
  std::unique_ptr<v1::Sweeps::Stub> sweeps_;
  std::unique_ptr<v1::Admin::Stub> admin_;
};

/// Calls a paged method and joins the pages into one response without a token. Calls `wants_more` before each page; it
/// may change the request, such as its page_size. Throws CommandError.
template <typename Stub, typename Request, typename Response>
Response call_for_pages(Connection& connection, Stub& stub,
                        grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*), Request request,
                        const std::function<bool(const std::type_identity_t<Response>& all,
                                                 std::type_identity_t<Request>& request)>& wants_more = {}) {
  Response all;
  while (!wants_more || wants_more(all, request)) {
    Response page = connection.call(stub, method, request);
    const std::string next = page.next_page_token();
    page.clear_next_page_token();
    all.MergeFrom(page);
    if (next.empty() || next == request.page_token()) break;
    request.set_page_token(next);
  }
  return all;
}

/// All samples of a job.
v1::GetHistoryResponse fetch_history(Connection& connection, const std::string& job);

/// A job, a sweep.
v1::Job fetch_job(Connection& connection, const std::string& name);
v1::Sweep fetch_sweep(Connection& connection, const std::string& name);

/// The whole table of a sweep, with the means over the seeds if it varies them.
v1::SweepTable fetch_table(Connection& connection, const std::string& sweep);

}  // namespace cellcrush::client
