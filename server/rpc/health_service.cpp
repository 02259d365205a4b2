#include "rpc/health_service.h"

#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

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

grpc::Status HealthService::check(const Call&, const HealthCheckRequest& request, HealthCheckResponse& response) {
  check_length("service", request.service(), kLongestName);
  response.set_status(board_.find(request.service()));
  if (response.status() != HealthCheckResponse::SERVICE_UNKNOWN) return grpc::Status::OK;
  return {grpc::StatusCode::NOT_FOUND, "There is no service \"" + request.service() + "\"."};
}

std::unique_ptr<HealthSource> HealthService::watch(const HealthCheckRequest& request) {
  check_length("service", request.service(), kLongestName);
  return std::make_unique<HealthSource>(board_, request.service());
}

void HealthService::add_methods(MethodTable& table) {
  table.unary("/grpc.health.v1.Health/Check", std::nullopt, nullptr, *this, &HealthService::check);
  table.stream("/grpc.health.v1.Health/Watch", std::nullopt, streams_, *this, &HealthService::watch);
}

}  // namespace cellcrush::rpc
