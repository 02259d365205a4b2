#pragma once

#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
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
#include "rpc/open_calls.h"
#include "rpc/request_reactor.h"
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
class MethodTable final : public grpc::CallbackGenericService {
 public:
  struct Method {
    const google::protobuf::MethodDescriptor* descriptor = nullptr;
    bool is_open = false;    ///< to everybody
    std::string label = {};  ///< "Jobs/CreateJob"
    /// Begins to answer. Throws ServiceError, or InvalidField if the request cannot be parsed.
    std::function<std::shared_ptr<MessageStream>(const Incoming& incoming)> open;
    /// Answers a call of gRPC once its request has come.
    std::function<std::shared_ptr<RequestReactor>(const grpc::CallbackServerContext& context, const std::string& caller,
                                                  RequestReactor::Patience patience)>
        serve;
  };

  /// `http_pump` advances the streams that are not gRPC's; `calls` parses requests and answers most calls. A client of
  /// gRPC that takes longer than `patience`, and a second for each 100 kB, to send a request or to read an answer loses
  /// the call. All of them outlive the table.
  MethodTable(access::Gate& gate, watch::Pump& http_pump, CallPool& calls, Accounts& received, store::Epoch epoch,
              std::chrono::milliseconds patience = std::chrono::seconds(5))
      : gate_(gate),
        http_pump_(http_pump),
        calls_(calls),
        received_(received),
        epoch_(std::move(epoch)),
        patience_(patience),
        open_calls_(received) {}

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
    const UnaryReactor::Begin begin_of_grpc = [begin](Arrived arrived, UnaryReactor& reactor) {
      begin(std::move(arrived), [&reactor](const Response& response) { return reactor.set_answer(response); });
    };
    const auto serve = [this, begin_of_grpc](const auto& context, const std::string& caller, auto patience) {
      return std::make_shared<UnaryReactor>(open_calls_, gate_, context, caller, patience, begin_of_grpc);
    };
    const auto open = [begin](const Incoming& incoming) {
      return std::make_shared<UnaryCall>(incoming, [begin](Arrived arrived, std::string& to) {
        const auto encode = arrived.incoming.encode;
        begin(std::move(arrived), [encode, &to](const Response& answer) {
          encode(answer, to);
          return static_cast<std::int64_t>(to.size());
        });
      });
    };
    add(path, scope, {describe(path, *Request::descriptor(), *Response::descriptor(), false), !scope, "", open, serve});
  }

  /// `handle`: opens the source of a stream; what it throws ends the stream. The pump of `parts` advances gRPC's
  /// streams. They count for the caller, or for the peer's address if the method is open to everybody.
  template <class Service, class Source, class Request>
  void stream(const char* path, std::optional<access::Scope> scope, const StreamParts& parts,
              const std::shared_ptr<Service>& service, std::unique_ptr<Source> (Service::*handle)(const Request&)) {
    const auto make = [path, service, handle](const Incoming& incoming) {
      return (*service.*handle)(*read<Request>(path, incoming));
    };
    const auto serve = [this, parts, make](const auto& context, const std::string& caller, auto patience) {
      return std::make_shared<StreamReactor<Source>>(
          open_calls_, context, caller, patience, parts,
          [make](grpc::ByteBuffer& request) { return make(incoming_of(request)); });
    };
    const StreamParts http_parts{http_pump_, parts.checks, parts.metrics, parts.limits, parts.times};
    const auto open = [http_parts, make](const Incoming& incoming) {
      return std::make_shared<SourceStream<Source>>(
          http_parts, incoming.caller.name, incoming.encode, [make, incoming] { return make(incoming); },
          incoming.begin);
    };
    add(path, scope,
        {describe(path, *Request::descriptor(), *Source::Message::descriptor(), true), !scope, "", open, serve});
  }

  /// Called for each call of gRPC that the gate has admitted, with gRPC's name of its connection. REQUIRES: no call has
  /// come.
  std::function<void(const std::string& connection, const std::string& caller)> on_admitted;

  /// How a call has ended, whether it was refused or answered.
  struct CallEnd {
    const std::string& method;  ///< its label; "unknown" for one that is not in the table
    grpc::StatusCode code;
    std::optional<double> seconds;  ///< until its answer; nothing for a stream and for a call that was refused at once
  };
  /// Called for each call. Thread-safe, quick. REQUIRES: no call has come.
  std::function<void(const CallEnd& end)> on_ended;

  /// A call has ended that did not reach its method, as the gate or a limit refused it.
  void note_end(std::string_view path, grpc::StatusCode code, std::optional<double> seconds = {}) const;

  /// Null if there is none.
  [[nodiscard]] const Method* find(std::string_view path) const;

  /// Of the daemon's data.
  [[nodiscard]] const std::string& epoch() const { return epoch_.id; }

  /// Lets gRPC call the methods. The table outlives the server that is built.
  void register_with(grpc::ServerBuilder& builder) { builder.RegisterCallbackGenericService(this); }

  /// A call of gRPC, of any method of the table.
  grpc::ServerGenericBidiReactor* CreateReactor(grpc::GenericCallbackServerContext* context) override;

  /// Those of gRPC.
  [[nodiscard]] OpenCalls& open_calls() { return open_calls_; }

 private:
  /// Tells on_ended of the end of a call that has begun.
  class CallWatch {
   public:
    CallWatch(const MethodTable& table, const Method& method) : table_(&table), method_(&method) {}
    void end(grpc::StatusCode code) const;

   private:
    const MethodTable* table_;
    const Method* method_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  };

  /// A call that is not gRPC's, and whose end is told.
  class WatchedStream final : public MessageStream, public std::enable_shared_from_this<WatchedStream> {
   public:
    WatchedStream(std::shared_ptr<MessageStream> stream, const CallWatch& watch)
        : stream_(std::move(stream)), watch_(watch) {}
    ~WatchedStream() override;

    void ask(Deliver deliver) override;
    void cancel() override { stream_->cancel(); }

   private:
    std::shared_ptr<MessageStream> stream_;
    CallWatch watch_;
    std::atomic<bool> has_ended_ = false;
  };

  /// A unary call that has come, by whichever door.
  struct Arrived {
    CallPool::Task task;  ///< without its body
    Incoming incoming;
    bool is_small = false;  ///< so that the thread that brings the call may parse it
  };

  /// A unary call of gRPC. Holds the memory of its answer until the client has it, or has lost it for lack of reading.
  class UnaryReactor final : public RequestReactor, public Call {
   public:
    using Begin = std::function<void(Arrived arrived, UnaryReactor& reactor)>;

    UnaryReactor(OpenCalls& open, const access::Gate& gate, const grpc::CallbackServerContext& context,
                 const std::string& caller, Patience patience, const Begin& begin)
        : RequestReactor(open, context, caller, patience), gate_(gate), begin_(begin) {}

    /// Returns its bytes.
    std::int64_t set_answer(const google::protobuf::Message& answer);

    [[nodiscard]] access::Caller caller() const override { return gate_.caller_of(context()); }
    [[nodiscard]] bool is_cancelled() const override { return context().IsCancelled(); }

   private:
    void on_request(grpc::ByteBuffer& bytes, std::shared_ptr<Accounts::Charge> received) override;
    void finish(const grpc::Status& status, std::shared_ptr<Accounts::Charge> charge);

    const access::Gate& gate_;
    const Begin& begin_;  ///< of the method
    grpc::ByteBuffer answer_;
    std::shared_ptr<Accounts::Charge> charge_;
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
  static Incoming incoming_of(grpc::ByteBuffer& bytes);
  /// For whom a call of gRPC counts, on the connection of this name. Throws ServiceError (unauthenticated).
  [[nodiscard]] std::string name_of(const grpc::CallbackServerContext& context, const std::string& connection,
                                    bool is_open) const;
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
  OpenCalls open_calls_;
  std::map<std::string, Method, std::less<>> methods_;
};

}  // namespace cellcrush::rpc
