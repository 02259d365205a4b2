#include "rpc/health_service.h"

#include "rpc/request_limits.h"

namespace cellcrush::rpc {
namespace {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

// "ipv4:127.0.0.1" of "ipv4:127.0.0.1:40312".
std::string address_of(const std::string& peer) {
  return peer.starts_with("unix:") ? "unix" : peer.substr(0, peer.rfind(':'));
}

}  // namespace

void HealthBoard::set(const std::string& service, bool is_serving) {
  const MutexLock lock(mutex_);
  services_[service] = is_serving;
  for (const auto& [id, wake] : watchers_) wake();
}

void HealthBoard::set_all(bool is_serving) {
  const MutexLock lock(mutex_);
  for (auto& [service, serves] : services_) serves = is_serving;
  for (const auto& [id, wake] : watchers_) wake();
}

HealthBoard::Status HealthBoard::find(const std::string& service) const {
  const MutexLock lock(mutex_);
  const auto found = services_.find(service);
  if (found == services_.end()) return HealthCheckResponse::SERVICE_UNKNOWN;
  return found->second ? HealthCheckResponse::SERVING : HealthCheckResponse::NOT_SERVING;
}

std::uint64_t HealthBoard::subscribe(Wake wake) {
  const MutexLock lock(mutex_);
  watchers_.emplace(next_id_, std::move(wake));
  return next_id_++;
}

void HealthBoard::unsubscribe(std::uint64_t id) {
  const MutexLock lock(mutex_);
  watchers_.erase(id);
}

std::optional<HealthSource::Message> HealthSource::next() {
  const auto now = board_.find(service_);
  if (given_ == now) return std::nullopt;
  given_ = now;
  Message out;
  out.set_status(now);
  return out;
}

grpc::ServerUnaryReactor* HealthService::Check(grpc::CallbackServerContext* context, const HealthCheckRequest* request,
                                               HealthCheckResponse* response) {
  auto* reactor = context->DefaultReactor();
  reactor->Finish(answer([&] {
    check_length("service", request->service(), kLongestName);
    response->set_status(parts_.board.find(request->service()));
    if (response->status() != HealthCheckResponse::SERVICE_UNKNOWN) return grpc::Status::OK;
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "There is no service \"" + request->service() + "\".");
  }));
  return reactor;
}

std::unique_ptr<HealthSource> HealthService::watch(const HealthCheckRequest& request) {
  check_length("service", request.service(), kLongestName);
  return std::make_unique<HealthSource>(parts_.board, request.service());
}

grpc::ServerWriteReactor<HealthCheckResponse>* HealthService::Watch(grpc::CallbackServerContext* context,
                                                                    const HealthCheckRequest* request) {
  return open_stream<HealthSource>(
      parts_.streams, *context, [&] { return address_of(context->peer()); }, [&] { return watch(*request); });
}

void HealthService::add_streams(StreamTable& table) {
  table.add<HealthSource, HealthCheckRequest>("/grpc.health.v1.Health/Watch", parts_.streams,
                                              [this](const HealthCheckRequest& request) { return watch(request); });
}

}  // namespace cellcrush::rpc
