#include "rpc/open_calls.h"

#include <grpcpp/support/server_interceptor.h>

#include <memory>
#include <utility>
#include <vector>

#include "access/call_backlog.h"

namespace cellcrush::rpc {
namespace {

namespace grpc_hooks = grpc::experimental;

// Lives as long as its call over gRPC.
class CallInterceptor final : public grpc_hooks::Interceptor {
 public:
  explicit CallInterceptor(OpenCalls& open) : open_(open) { open_.add(); }
  ~CallInterceptor() override { open_.remove(); }
  CallInterceptor(const CallInterceptor&) = delete;
  CallInterceptor& operator=(const CallInterceptor&) = delete;

  void Intercept(grpc_hooks::InterceptorBatchMethods* methods) override { methods->Proceed(); }

 private:
  OpenCalls& open_;
};

class CallInterceptors final : public grpc_hooks::ServerInterceptorFactoryInterface {
 public:
  CallInterceptors(OpenCalls& open, access::Gate& gate) : open_(open), gate_(gate) {}

  // Called when a call begins. gRPC owns the returned object.
  grpc_hooks::Interceptor* CreateServerInterceptor(grpc_hooks::ServerRpcInfo* call) override {
    const auto* context = static_cast<grpc::CallbackServerContext*>(call->server_context());
    gate_.backlog().begin(gate_.key_of(*context->auth_context()), context->peer());
    return new CallInterceptor(open_);
  }

 private:
  OpenCalls& open_;
  access::Gate& gate_;
};

// Is asked for a context once gRPC has read a call, and leaves it to gRPC to make one.
class CallContexts final : public grpc::ContextAllocator {
 public:
  explicit CallContexts(access::Gate& gate) : gate_(gate) {}

  grpc::CallbackServerContext* NewCallbackServerContext() override {
    gate_.backlog().queue();
    return nullptr;
  }
  grpc::GenericCallbackServerContext* NewGenericCallbackServerContext() override {
    gate_.backlog().queue();
    return nullptr;
  }
  void Release(grpc::CallbackServerContext* context) override {
    gate_.backlog().end(gate_.key_of(*context->auth_context()));
  }
  void Release(grpc::GenericCallbackServerContext* context) override {
    Release(static_cast<grpc::CallbackServerContext*>(context));
  }

 private:
  access::Gate& gate_;
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

void count_calls(grpc::ServerBuilder& builder, OpenCalls& open, access::Gate& gate) {
  std::vector<std::unique_ptr<grpc_hooks::ServerInterceptorFactoryInterface>> interceptors;
  interceptors.push_back(std::make_unique<CallInterceptors>(open, gate));
  builder.experimental().SetInterceptorCreators(std::move(interceptors));
  builder.SetContextAllocator(std::make_unique<CallContexts>(gate));
}

}  // namespace cellcrush::rpc
