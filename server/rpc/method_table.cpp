#include "rpc/method_table.h"

#include <google/protobuf/descriptor.h>
#include <grpcpp/support/server_interceptor.h>

#include <algorithm>

#include "error.h"
#include "error_table.h"
#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

// The error of a request that cannot be parsed, naming the method and the message type. `path` is as gRPC has it.
InvalidField parse_error(std::string_view path) {
  std::string method(path.substr(path.starts_with('/') ? 1 : 0));
  std::replace(method.begin(), method.end(), '/', '.');
  const auto* descriptor = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(method);
  const std::string type =
      descriptor == nullptr ? "message of the expected type" : descriptor->input_type()->full_name();
  return {"request", "of " + method + " is not a " + type + ": its bytes cannot be parsed, or a string is not UTF-8.",
          "Encode it with this server's .proto files, and every string as UTF-8."};
}

namespace grpc_hooks = grpc::experimental;

// Lives as long as its call over gRPC.
class CallInterceptor final : public grpc_hooks::Interceptor {
 public:
  CallInterceptor(OpenCalls& open, const grpc_hooks::ServerRpcInfo& info) : open_(open), path_(info.method()) {
    using Type = grpc_hooks::ServerRpcInfo::Type;
    // A stream of requests has no single message to check.
    checks_request_ = info.type() == Type::UNARY || info.type() == Type::SERVER_STREAMING;
    open_.add();
  }
  ~CallInterceptor() override { open_.remove(); }
  CallInterceptor(const CallInterceptor&) = delete;
  CallInterceptor& operator=(const CallInterceptor&) = delete;

  void Intercept(grpc_hooks::InterceptorBatchMethods* methods) override {
    if (checks_request_) check_request(*methods);
    methods->Proceed();
  }

 private:
  void check_request(grpc_hooks::InterceptorBatchMethods& methods) {
    using Point = grpc_hooks::InterceptionHookPoints;
    if (methods.QueryInterceptionHookPoint(Point::POST_RECV_MESSAGE))
      has_message_ = methods.GetRecvMessage() != nullptr;
    if (has_message_ || !methods.QueryInterceptionHookPoint(Point::PRE_SEND_STATUS)) return;
    const auto code = methods.GetSendStatus().error_code();
    if (code == grpc::StatusCode::INTERNAL || code == grpc::StatusCode::UNIMPLEMENTED)
      methods.ModifySendStatus(status_of(parse_error(path_)));
  }

  OpenCalls& open_;
  const char* path_;
  bool checks_request_ = false;
  bool has_message_ = true;
};

class CallInterceptors final : public grpc_hooks::ServerInterceptorFactoryInterface {
 public:
  explicit CallInterceptors(OpenCalls& open) : open_(open) {}

  // gRPC owns the returned object.
  grpc_hooks::Interceptor* CreateServerInterceptor(grpc_hooks::ServerRpcInfo* info) override {
    return new CallInterceptor(open_, *info);
  }

 private:
  OpenCalls& open_;
};

}  // namespace

void OpenCalls::add() {
  const MutexLock lock(mutex_);
  ++count_;
}

void OpenCalls::remove() {
  const MutexLock lock(mutex_);
  if (--count_ == 0) none_.notify_all();
}

void OpenCalls::wait_until_none(std::chrono::milliseconds longest) {
  MutexLock lock(mutex_);
  none_.wait_for(lock, longest, [this]() CELLCRUSH_REQUIRES(mutex_) { return count_ == 0; });
}

std::unique_ptr<grpc::experimental::ServerInterceptorFactoryInterface> make_call_interceptors(OpenCalls& open) {
  return std::make_unique<CallInterceptors>(open);
}

void MethodTable::UnaryCall::ask(Deliver deliver) {
  const auto answer = std::make_shared<Batch>();
  const auto self = shared_from_this();
  run(pool_, {self, bytes_, [self, answer] { self->body_(*self, answer->bytes); },
              [answer, deliver = std::move(deliver)](const grpc::Status& status) {
                answer->end = status;
                deliver(std::move(*answer));
              }});
}

const MethodTable::Method* MethodTable::find(std::string_view path) const {
  const auto found = methods_.find(path);
  return found == methods_.end() ? nullptr : &found->second;
}

void MethodTable::read_into(google::protobuf::Message& request, const char* path, const Incoming& incoming) {
  if (!incoming.decode(request)) throw parse_error(path);
  if (request.ByteSizeLong() <= static_cast<std::size_t>(kLargestMessage)) return;
  throw ServiceError(ServiceError::Kind::exhausted, "The request has " + std::to_string(request.ByteSizeLong()) +
                                                        " bytes. Use at most " + std::to_string(kLargestMessage) + ".");
}

std::string MethodTable::exchange_epochs(grpc::CallbackServerContext& context) const {
  context.AddInitialMetadata(kEpochHeader, epoch_.id);
  const auto found = context.client_metadata().find(kEpochHeader);
  if (found == context.client_metadata().end()) return "";
  std::string named(found->second.data(), found->second.size());
  // Python's asyncio may drop the initial metadata of a refused stream.
  if (named != epoch_.id) context.AddTrailingMetadata(kEpochHeader, epoch_.id);
  return named;
}

void MethodTable::require_epoch(const std::string& named) const {
  if (named.empty() || named == epoch_.id) return;
  const std::string shown = named.substr(0, std::min<std::size_t>(named.find_first_not_of("0123456789abcdef"), 32));
  throw ServiceError(
      ServiceError::Kind::failed_precondition,
      "This is another server, or another data folder, than the one that the call is meant for: the call names epoch " +
          shown + ", this server has epoch " + epoch_.id +
          (epoch_.restored.empty() ? "" : ", since the restore of " + epoch_.restored) +
          ". Its jobs are others, even under the same names. Nothing was changed. List its jobs before you change "
          "any.");
}

void MethodTable::run(CallPool* pool, CallPool::Task task) {
  pool != nullptr ? pool->run(std::move(task)) : task.finish(answer(task.body));
}

// "ipv4:127.0.0.1" of "ipv4:127.0.0.1:40312".
std::string MethodTable::address_of(const std::string& peer) {
  return peer.starts_with("unix:") ? "unix" : peer.substr(0, peer.rfind(':'));
}

const google::protobuf::MethodDescriptor* MethodTable::describe(std::string_view path,
                                                                const google::protobuf::Descriptor& request,
                                                                const google::protobuf::Descriptor& response,
                                                                bool is_stream) {
  std::string name(path.substr(1));
  std::replace(name.begin(), name.end(), '/', '.');
  const auto* out = google::protobuf::DescriptorPool::generated_pool()->FindMethodByName(name);
  if (out == nullptr || out->input_type() != &request || out->output_type() != &response || out->client_streaming() ||
      out->server_streaming() != is_stream)
    throw ServiceError(ServiceError::Kind::internal, "No .proto file has the method " + std::string(path) + ".");
  return out;
}

void MethodTable::add(const char* path, std::optional<access::Scope> scope, Method method) {
  gate_.guard(path, scope);
  method.open = [this, open = std::move(method.open)](const Incoming& incoming) {
    require_epoch(incoming.epoch);
    return open(incoming);
  };
  methods_.emplace(path, std::move(method));
}

}  // namespace cellcrush::rpc
