#include "rpc/health_service.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "error.h"
#include "rpc/request_fields.h"

namespace cellcrush::rpc {
namespace {

using grpc::health::v1::HealthCheckRequest;
using grpc::health::v1::HealthCheckResponse;

/// Source of a Health.Watch: the status of a service, repeated whenever it changes. Not thread-safe, except for `wake`.
class HealthSource final : public PlainSource<HealthCheckResponse> {
 public:
  /// `board` outlives it.
  HealthSource(HealthBoard& board, std::string service) : board_(board), service_(std::move(service)) {}

  void open(std::function<void()> wake) { subscription_ = board_.subscribe(std::move(wake)); }
  void close() { board_.unsubscribe(subscription_); }
  std::optional<Message> next() {
    const auto now = board_.find(service_);
    if (std::exchange(given_, now) == now) return std::nullopt;
    Message out;
    out.set_status(now);
    return out;
  }
  [[nodiscard]] bool ended() const { return false; }
  [[nodiscard]] std::string resume_advice() const { return "for the service"; }

 private:
  HealthBoard& board_;
  std::string service_;
  std::optional<HealthBoard::Status> given_;
  std::uint64_t subscription_ = 0;
};

/// The calls of Health. Thread-safe.
class HealthCalls {
 public:
  explicit HealthCalls(HealthBoard& board) : board_(board) {}

  HealthCheckResponse check(const Call&, const HealthCheckRequest& request) {
    check_length("service", request.service(), kLongestName);
    HealthCheckResponse out;
    out.set_status(board_.find(request.service()));
    if (out.status() != HealthCheckResponse::SERVICE_UNKNOWN) return out;
    throw ServiceError(ServiceError::Kind::not_found, "There is no service \"" + request.service() + "\".");
  }

  std::unique_ptr<HealthSource> watch(const HealthCheckRequest& request) {
    check_length("service", request.service(), kLongestName);
    return std::make_unique<HealthSource>(board_, request.service());
  }

 private:
  HealthBoard& board_;
};

}  // namespace

void HealthBoard::set(const std::string& service, bool is_serving) {
  const MutexLock lock(mutex_);
  services_[service] = is_serving;
  wake_watchers();
}

void HealthBoard::drain() {
  const MutexLock lock(mutex_);
  is_draining_ = true;
  wake_watchers();
}

void HealthBoard::set_stuck(const std::string& stuck) {
  const MutexLock lock(mutex_);
  if (std::exchange(stuck_, stuck) != stuck) wake_watchers();
}

HealthBoard::Report HealthBoard::progress() const {
  const MutexLock lock(mutex_);
  return stuck_.empty() ? Report{true, "The daemon makes progress."} : Report{false, stuck_};
}

HealthBoard::Report HealthBoard::readiness() const {
  const MutexLock lock(mutex_);
  if (!stuck_.empty()) return {false, stuck_};
  if (is_draining_) return {false, "The daemon drains and takes no new jobs."};
  if (status_of("") != HealthCheckResponse::SERVING) return {false, "The daemon is starting."};
  return {true, "The daemon takes jobs."};
}

HealthBoard::Status HealthBoard::find(const std::string& service) const {
  const MutexLock lock(mutex_);
  return status_of(service);
}

HealthBoard::Status HealthBoard::status_of(const std::string& service) const {
  const auto found = services_.find(service);
  if (found == services_.end()) return HealthCheckResponse::SERVICE_UNKNOWN;
  const bool serves = found->second && !is_draining_ && stuck_.empty();
  return serves ? HealthCheckResponse::SERVING : HealthCheckResponse::NOT_SERVING;
}

void HealthBoard::wake_watchers() const {
  for (const auto& [id, wake] : watchers_) wake();
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

void add_health_methods(MethodTable& table, HealthBoard& board, const StreamParts& streams) {
  const auto calls = std::make_shared<HealthCalls>(board);
  table.unary("/grpc.health.v1.Health/Check", std::nullopt, nullptr, calls, &HealthCalls::check);
  table.stream("/grpc.health.v1.Health/Watch", std::nullopt, streams, calls, &HealthCalls::watch);
}

}  // namespace cellcrush::rpc
