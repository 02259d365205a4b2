#pragma once

#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/impl/codegen/server_callback_handlers.h>
#include <grpcpp/impl/codegen/service_type.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "access/gate.h"
#include "mutex.h"
#include "rpc/call_pool.h"
#include "rpc/source_stream.h"
#include "rpc/stream_reactor.h"
#include "store/journal_schema.h"
#include "translate/case_words.h"

namespace cellcrush::rpc {

/// Metadata of gRPC, header of HTTP. An answer has the epoch of the daemon's data in it; a call, if it names one, the
/// epoch that its client has seen.
inline constexpr const char* kEpochHeader = "cellcrush-epoch";

/// A call that did not come over gRPC, once the gate has admitted it.
struct Incoming {
  access::Caller caller;
  std::string epoch;  ///< that the call names; empty: none
  /// Reads the request; false if its bytes cannot be parsed. May throw ServiceError.
  std::function<bool(google::protobuf::Message& request)> decode;
  MessageStream::Encode encode;  ///< of the answers
};

/// All methods of the API: what each needs, and who answers it. gRPC and the Connect protocol both call through this
/// table. A call that names another epoch than the daemon's is refused with failed_precondition, so that no command
/// reaches a job of the same name on another server. Thread-safe once it is complete.
class MethodTable {
 public:
  struct Method {
    const google::protobuf::MethodDescriptor* descriptor = nullptr;
    /// Begins to answer. Throws ServiceError, or InvalidField if the request cannot be parsed.
    std::function<std::shared_ptr<MessageStream>(const Incoming& incoming)> open;
  };

  /// `http_pump` advances the streams that are not gRPC's. Both outlive the table.
  MethodTable(access::Gate& gate, watch::Pump& http_pump, store::Epoch epoch)
      : gate_(gate), http_pump_(http_pump), epoch_(std::move(epoch)) {}

  // In both, `path` is a literal: "/cellcrush.v1.Jobs/GetJob". `scope`: what callers need; nothing: open to everybody.
  // Throws ServiceError (internal) if the .proto files have no such method.

  /// `pool`: answers the calls; null: the thread that brings a call.
  template <class Service, class Request, class Response>
  void unary(const char* path, std::optional<access::Scope> scope, CallPool* pool,
             const std::shared_ptr<Service>& service, Response (Service::*handle)(const Call&, const Request&)) {
    grpc_.add(path, grpc::internal::RpcMethod::NORMAL_RPC,
              new grpc::internal::CallbackUnaryHandler<Request, Response>(
                  [this, pool, service, handle](grpc::CallbackServerContext* context, const Request* request,
                                                Response* response) {
                    auto* reactor = context->DefaultReactor();
                    const auto call = std::make_shared<GrpcCall>(gate_, *context);
                    run(pool, {call, static_cast<std::int64_t>(request->ByteSizeLong()),
                               [this, epoch = exchange_epochs(*context), call, service, handle, request, response] {
                                 require_epoch(epoch);
                                 *response = (*service.*handle)(*call, *request);
                                 translate::add_words(*response);
                               },
                               [reactor](const grpc::Status& status) { reactor->Finish(status); }});
                    return reactor;
                  }));
    const auto open = [path, pool, service, handle](const Incoming& incoming) {
      auto request = read<Request>(path, incoming);
      const auto bytes = static_cast<std::int64_t>(request->ByteSizeLong());
      return std::make_shared<UnaryCall>(
          pool, incoming.caller, bytes,
          [service, handle, request, encode = incoming.encode](const Call& call, std::string& to) {
            auto response = (*service.*handle)(call, *request);
            translate::add_words(response);
            encode(response, to);
          });
    };
    add(path, scope, {describe(path, *Request::descriptor(), *Response::descriptor(), false), open});
  }

  /// `make`: opens the source of a stream; what it throws ends the stream. The pump of `parts` advances gRPC's streams.
  /// They count for the caller, or for the peer's address if the method is open to everybody.
  template <class Service, class Source, class Request>
  void stream(const char* path, std::optional<access::Scope> scope, const StreamParts& parts,
              const std::shared_ptr<Service>& service, std::unique_ptr<Source> (Service::*make)(const Request&)) {
    using Message = typename Source::Message;
    grpc_.add(path, grpc::internal::RpcMethod::SERVER_STREAMING,
              new grpc::internal::CallbackServerStreamingHandler<Request, Message>(
                  [this, parts, service, make, is_open = !scope](grpc::CallbackServerContext* context,
                                                                 const Request* request) {
                    const auto epoch = exchange_epochs(*context);
                    return open_stream<Source>(
                        parts, *context,
                        [&] { return is_open ? address_of(context->peer()) : gate_.caller_of(*context).name; },
                        [&] {
                          require_epoch(epoch);
                          return (*service.*make)(*request);
                        });
                  }));
    const StreamParts http_parts{http_pump_, parts.metrics, parts.limits, parts.times};
    const auto open = [path, http_parts, service, make](const Incoming& incoming) {
      auto request = read<Request>(path, incoming);
      return std::make_shared<SourceStream<Source>>(http_parts, incoming.caller.name, incoming.encode,
                                                    [service, make, request] { return (*service.*make)(*request); });
    };
    add(path, scope, {describe(path, *Request::descriptor(), *Message::descriptor(), true), open});
  }

  /// Null if there is none.
  [[nodiscard]] const Method* find(std::string_view path) const;

  /// Of the daemon's data.
  [[nodiscard]] const std::string& epoch() const { return epoch_.id; }

  /// Lets gRPC call the methods. The table outlives the server that is built.
  void register_with(grpc::ServerBuilder& builder) { builder.RegisterService(&grpc_); }

 private:
  class GrpcService final : public grpc::Service {
   public:
    void add(const char* path, grpc::internal::RpcMethod::RpcType type, grpc::internal::MethodHandler* handler) {
      AddMethod(new grpc::internal::RpcServiceMethod(path, type, nullptr));
      MarkMethodCallback(count_++, handler);
    }

   private:
    int count_ = 0;
  };

  class GrpcCall final : public Call {
   public:
    GrpcCall(const access::Gate& gate, const grpc::CallbackServerContext& context) : gate_(gate), context_(context) {}
    [[nodiscard]] access::Caller caller() const override { return gate_.caller_of(context_); }
    [[nodiscard]] bool is_cancelled() const override { return context_.IsCancelled(); }

   private:
    const access::Gate& gate_;
    const grpc::CallbackServerContext& context_;  ///< until the call is finished
  };

  /// A unary call that is not gRPC's: its own answer.
  class UnaryCall final : public Call, public MessageStream, public std::enable_shared_from_this<UnaryCall> {
   public:
    using Body = std::function<void(const Call& call, std::string& to)>;

    UnaryCall(CallPool* pool, access::Caller caller, std::int64_t bytes, Body body)
        : pool_(pool), caller_(std::move(caller)), bytes_(bytes), body_(std::move(body)) {}

    [[nodiscard]] access::Caller caller() const override { return caller_; }
    [[nodiscard]] bool is_cancelled() const override { return is_cancelled_; }
    void ask(Deliver deliver) override;
    void cancel() override { is_cancelled_ = true; }

   private:
    CallPool* pool_;
    access::Caller caller_;
    std::int64_t bytes_;
    Body body_;
    std::atomic<bool> is_cancelled_ = false;
  };

  template <class Request>
  static std::shared_ptr<Request> read(const char* path, const Incoming& incoming) {
    auto out = std::make_shared<Request>();
    read_into(*out, path, incoming);
    return out;
  }

  static void read_into(google::protobuf::Message& request, const char* path, const Incoming& incoming);
  /// Puts the daemon's epoch into the answer. The one that the call names; empty: none.
  std::string exchange_epochs(grpc::CallbackServerContext& context) const;
  void require_epoch(const std::string& named) const;
  static void run(CallPool* pool, CallPool::Task task);
  static std::string address_of(const std::string& peer);
  static const google::protobuf::MethodDescriptor* describe(std::string_view path,
                                                            const google::protobuf::Descriptor& request,
                                                            const google::protobuf::Descriptor& response,
                                                            bool is_stream);
  void add(const char* path, std::optional<access::Scope> scope, Method method);

  access::Gate& gate_;
  watch::Pump& http_pump_;
  const store::Epoch epoch_;
  GrpcService grpc_;
  std::map<std::string, Method, std::less<>> methods_;
};

/// Counts the calls over gRPC that are not answered yet. Thread-safe.
class OpenCalls {
 public:
  void add();
  void remove();
  /// Returns once there is none, or after this time.
  void wait_until_none(std::chrono::milliseconds longest);

 private:
  Mutex mutex_;
  std::condition_variable_any none_;
  int count_ CELLCRUSH_GUARDED_BY(mutex_) = 0;
};

/// Counts every call over gRPC in `open`, which outlives the server. Ends a unary or server-streaming one whose request
/// cannot be parsed with InvalidField, naming the method and the message type, as MethodTable does elsewhere. gRPC
/// itself would end it with INTERNAL or UNIMPLEMENTED and no message.
std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_call_interceptors(OpenCalls& open);

}  // namespace cellcrush::rpc
