#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/impl/codegen/server_callback_handlers.h>
#include <grpcpp/impl/codegen/service_type.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "access/gate.h"
#include "rpc/accounts.h"
#include "rpc/call_pool.h"
#include "rpc/cut.h"
#include "rpc/request_weight.h"
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
  /// Reads the request; false if its bytes cannot be parsed. May throw ServiceError. Owns the bytes, as it is called
  /// later, on a thread of its own.
  std::function<bool(google::protobuf::Message& request)> decode;
  std::int64_t bytes = 0;                      ///< of the request
  std::shared_ptr<Accounts::Charge> received;  ///< for these bytes; may be null
  MessageStream::Encode encode;                ///< of the answers
  MessageStream::Begin begin = nullptr;        ///< of the answers of a stream
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

  /// `http_pump` advances the streams that are not gRPC's; `calls` parses requests and answers most calls. A client of
  /// gRPC that takes longer than `patience`, and a second for each 100 kB, to read an answer loses it. All of them
  /// outlive the table.
  MethodTable(access::Gate& gate, watch::Pump& http_pump, CallPool& calls, Accounts& received, store::Epoch epoch,
              std::chrono::milliseconds patience = std::chrono::seconds(5))
      : gate_(gate),
        http_pump_(http_pump),
        calls_(calls),
        received_(received),
        epoch_(std::move(epoch)),
        patience_(patience) {}

  // In both, `path` is a literal: "/cellcrush.v1.Jobs/GetJob". `scope`: what callers need; nothing: open to everybody.
  // Throws ServiceError (internal) if the .proto files have no such method.

  /// `pool`: answers the calls; null: the thread that brings a call. `is_large`: whether an answer may take seconds.
  /// `weigh`: bytes of memory that it takes beside the request.
  template <class Service, class Request, class Response>
  void unary(const char* path, std::optional<access::Scope> scope, CallPool* pool,
             const std::shared_ptr<Service>& service, Response (Service::*handle)(const Call&, const Request&),
             bool (*is_large)(const std::type_identity_t<Request>&) = nullptr,
             std::int64_t (*weigh)(const std::type_identity_t<Request>&) = nullptr) {
    // What both doors do: parse, perhaps move to the pool for checks, answer with `take`.
    const auto begin = [this, path, pool, service, handle, is_large, weigh](Arrived arrived, auto take) {
      const auto request = std::make_shared<Request>();
      const auto respond = [service, handle, request, take](CallPool::Task& task) {
        auto response = (*service.*handle)(*task.call, *request);
        translate::add_words(response);
        task.charge->set(take(std::move(response)));
      };
      arrived.task.bytes = heaviest_request_of(static_cast<std::size_t>(arrived.incoming.bytes));
      arrived.task.body = [this, path, pool, request, respond, is_large, weigh,
                           in = std::move(arrived.incoming)](CallPool::Task& task) mutable {
        read_into(*request, path, in);
        in = {};
        if (pool == nullptr || pool == &calls_) return respond(task);
        task.charge->set(static_cast<std::int64_t>(request->SpaceUsedLong()) + (weigh ? weigh(*request) : 0));
        CallPool::Task next = std::move(task);
        task.finish = nullptr;
        next.is_large = is_large != nullptr && is_large(*request);
        next.body = respond;
        pool->run(std::move(next));
      };
      start(pool, std::move(arrived.task), arrived.is_small);
    };
    grpc_.add(path, grpc::internal::RpcMethod::NORMAL_RPC,
              new grpc::internal::CallbackUnaryHandler<grpc::ByteBuffer, Response>(
                  [this, begin, is_open = !scope](grpc::CallbackServerContext* context, const grpc::ByteBuffer* bytes,
                                                  Response* response) {
                    auto* reactor = UnaryReactor::make(*context, patience_);
                    auto arrived = arrive(*context, *bytes, is_open, *reactor);
                    if (!arrived) return reactor;
                    begin(std::move(*arrived), [this, response, reactor](Response answer) {
                      *response = std::move(answer);
                      const auto size = static_cast<std::int64_t>(response->ByteSizeLong());
                      reactor->patience = patience_ + std::chrono::milliseconds(size / 100);
                      return 2 * size;  // and as bytes
                    });
                    return reactor;
                  }));
    const auto open = [begin](const Incoming& incoming) {
      return std::make_shared<UnaryCall>(incoming, [begin](Arrived arrived, std::string& to) {
        const auto encode = arrived.incoming.encode;
        begin(std::move(arrived), [encode, &to](const Response& answer) {
          encode(answer, to);
          return static_cast<std::int64_t>(to.size());
        });
      });
    };
    add(path, scope, {describe(path, *Request::descriptor(), *Response::descriptor(), false), open});
  }

  /// `make`: opens the source of a stream; what it throws ends the stream. The pump of `parts` advances gRPC's streams.
  /// They count for the caller, or for the peer's address if the method is open to everybody.
  template <class Service, class Source, class Request>
  void stream(const char* path, std::optional<access::Scope> scope, const StreamParts& parts,
              const std::shared_ptr<Service>& service, std::unique_ptr<Source> (Service::*make)(const Request&)) {
    grpc_.add(path, grpc::internal::RpcMethod::SERVER_STREAMING,
              new grpc::internal::CallbackServerStreamingHandler<grpc::ByteBuffer, grpc::ByteBuffer>(
                  [this, path, parts, service, make, is_open = !scope](grpc::CallbackServerContext* context,
                                                                       const grpc::ByteBuffer* bytes) {
                    const auto epoch = exchange_epochs(*context);
                    return open_stream<Source>(
                        parts, *context, [&] { return name_of(*context, is_open); },
                        [&] {
                          require_epoch(epoch);
                          return (*service.*make)(*read<Request>(path, incoming_of(*bytes)));
                        });
                  }));
    const StreamParts http_parts{http_pump_, parts.checks, parts.metrics, parts.limits, parts.times};
    const auto open = [path, http_parts, service, make](const Incoming& incoming) {
      return std::make_shared<SourceStream<Source>>(
          http_parts, incoming.caller.name, incoming.encode,
          [service, make, path, incoming] { return (*service.*make)(*read<Request>(path, incoming)); },
          incoming.begin);
    };
    add(path, scope, {describe(path, *Request::descriptor(), *Source::Message::descriptor(), true), open});
  }

  /// Called for each call of gRPC that the gate has admitted, with gRPC's name of its connection. REQUIRES: no call has
  /// come.
  std::function<void(const std::string& connection, const std::string& caller)> on_admitted;

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

  /// A unary call that has come, by whichever door.
  struct Arrived {
    CallPool::Task task;  ///< without its body
    Incoming incoming;
    bool is_small = false;  ///< so that the thread that brings the call may parse it
  };

  /// Ends a unary call of gRPC, and holds the memory of its answer until the client has it, or has lost it for lack of
  /// reading. It owns itself until gRPC is done with it.
  class UnaryReactor final : public grpc::ServerUnaryReactor {
   public:
    static UnaryReactor* make(const grpc::CallbackServerContext& context, std::chrono::milliseconds patience) {
      const auto out = std::shared_ptr<UnaryReactor>(new UnaryReactor(context, patience));
      out->self_ = out;
      return out.get();
    }

    void finish(const grpc::Status& status, std::shared_ptr<Accounts::Charge> charge);
    void OnDone() override;

    std::chrono::milliseconds patience;  ///< with the client once it is finished; set before

   private:
    UnaryReactor(const grpc::CallbackServerContext& context, std::chrono::milliseconds given)
        : patience(given), context_(context) {}

    const grpc::CallbackServerContext& context_;  ///< valid until OnDone
    std::shared_ptr<UnaryReactor> self_;
    std::shared_ptr<Accounts::Charge> charge_;
    Cut cut_;
    grpc::Alarm alarm_;
  };

  /// A unary call that is not gRPC's: its own answer. It is asked for once.
  class UnaryCall final : public Call, public MessageStream, public std::enable_shared_from_this<UnaryCall> {
   public:
    using Begin = std::function<void(Arrived arrived, std::string& to)>;

    UnaryCall(Incoming incoming, Begin begin) : incoming_(std::move(incoming)), begin_(std::move(begin)) {}

    [[nodiscard]] access::Caller caller() const override { return incoming_.caller; }
    [[nodiscard]] bool is_cancelled() const override { return is_cancelled_; }
    void ask(Deliver deliver) override;
    void cancel() override { is_cancelled_ = true; }

   private:
    Incoming incoming_;
    Begin begin_;
    std::atomic<bool> is_cancelled_ = false;
  };

  template <class Request>
  static std::shared_ptr<Request> read(const char* path, const Incoming& incoming) {
    if (incoming.bytes > kLargestStreamRequest) throw too_large(incoming.bytes, kLargestStreamRequest);
    auto out = std::make_shared<Request>();
    read_into(*out, path, incoming);
    return out;
  }

  static constexpr std::int64_t kLargestStreamRequest = 256 * 1024;

  static void read_into(google::protobuf::Message& request, const char* path, const Incoming& incoming);
  /// Puts the daemon's epoch into the answer. The one that the call names; empty: none.
  std::string exchange_epochs(grpc::CallbackServerContext& context) const;
  void require_epoch(const std::string& named) const;
  static ServiceError too_large(std::int64_t bytes, std::int64_t most);
  /// Takes the bytes of a request from gRPC, which would keep them until the call ends.
  static Incoming incoming_of(const grpc::ByteBuffer& bytes);
  /// For whom a call of gRPC counts. Throws ServiceError (unauthenticated).
  [[nodiscard]] std::string name_of(const grpc::CallbackServerContext& context, bool is_open) const;
  /// A unary call of gRPC; nothing if it is refused, and finished.
  std::optional<Arrived> arrive(grpc::CallbackServerContext& context, const grpc::ByteBuffer& bytes, bool is_open,
                                UnaryReactor& reactor);
  /// Has the call's request parsed.
  void start(const CallPool* pool, CallPool::Task task, bool is_small);
  static const google::protobuf::MethodDescriptor* describe(std::string_view path,
                                                            const google::protobuf::Descriptor& request,
                                                            const google::protobuf::Descriptor& response,
                                                            bool is_stream);
  void add(const char* path, std::optional<access::Scope> scope, Method method);

  access::Gate& gate_;
  watch::Pump& http_pump_;
  CallPool& calls_;
  Accounts& received_;
  const store::Epoch epoch_;
  const std::chrono::milliseconds patience_;
  GrpcService grpc_;
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace cellcrush::rpc
