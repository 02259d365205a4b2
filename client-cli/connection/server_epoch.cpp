#include "connection/server_epoch.h"

#include <utility>

namespace cellcrush::client {
namespace {

namespace hooks = grpc::experimental;

constexpr const char* kEpochKey = "cellcrush-epoch";  // in the metadata of calls and answers

class EpochInterceptor final : public hooks::Interceptor {
 public:
  explicit EpochInterceptor(std::shared_ptr<ServerEpoch> epoch) : epoch_(std::move(epoch)) {}

  void Intercept(hooks::InterceptorBatchMethods* methods) override {
    using Point = hooks::InterceptionHookPoints;
    if (methods->QueryInterceptionHookPoint(Point::PRE_SEND_INITIAL_METADATA)) {
      if (const auto seen = epoch_->seen(); !seen.empty()) methods->GetSendInitialMetadata()->emplace(kEpochKey, seen);
    }
    if (methods->QueryInterceptionHookPoint(Point::POST_RECV_INITIAL_METADATA)) {
      const auto& answered = *methods->GetRecvInitialMetadata();
      if (const auto found = answered.find(kEpochKey); found != answered.end())
        epoch_->note({found->second.data(), found->second.size()});
    }
    methods->Proceed();
  }

 private:
  std::shared_ptr<ServerEpoch> epoch_;
};

class EpochInterceptors final : public hooks::ClientInterceptorFactoryInterface {
 public:
  explicit EpochInterceptors(std::shared_ptr<ServerEpoch> epoch) : epoch_(std::move(epoch)) {}

  // gRPC owns the returned object.
  hooks::Interceptor* CreateClientInterceptor(hooks::ClientRpcInfo*) override { return new EpochInterceptor(epoch_); }

 private:
  std::shared_ptr<ServerEpoch> epoch_;
};

}  // namespace

ServerEpoch::Interceptors ServerEpoch::interceptors_for(const std::shared_ptr<ServerEpoch>& epoch) {
  Interceptors out;
  out.push_back(std::make_unique<EpochInterceptors>(epoch));
  return out;
}

std::string ServerEpoch::seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

bool ServerEpoch::has_changed() const {
  const std::lock_guard lock(mutex_);
  return has_changed_;
}

void ServerEpoch::note(const std::string& epoch) {
  const std::lock_guard lock(mutex_);
  if (seen_.empty()) seen_ = epoch;
  has_changed_ = seen_ != epoch;
}

}  // namespace cellcrush::client
