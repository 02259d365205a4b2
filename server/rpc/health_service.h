#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "grpc/health/v1/health.pb.h"
#include "mutex.h"
#include "rpc/method_table.h"

namespace cellcrush::rpc {

/// The serving status of each service, with subscribers to its changes. Thread-safe.
class HealthBoard {
 public:
  using Status = grpc::health::v1::HealthCheckResponse::ServingStatus;
  using Wake = std::function<void()>;

  void set(const std::string& service, bool is_serving);
  /// All services with a status.
  void set_all(bool is_serving);

  /// SERVICE_UNKNOWN for a service without a status.
  [[nodiscard]] Status find(const std::string& service) const;

  /// Calls `wake` on every change, on the changing thread and under the board's lock. Returns the id for unsubscribing.
  std::uint64_t subscribe(Wake wake);
  void unsubscribe(std::uint64_t id);

 private:
  mutable Mutex mutex_;
  std::map<std::string, bool> services_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Wake> watchers_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(mutex_) = 1;
};

/// Source of a Health.Watch: the status of a service, repeated whenever it changes. Not thread-safe, except for `wake`.
class HealthSource final : public PlainSource<grpc::health::v1::HealthCheckResponse> {
 public:
  /// `board` outlives it.
  HealthSource(HealthBoard& board, std::string service) : board_(board), service_(std::move(service)) {}

  void open(std::function<void()> wake) { subscription_ = board_.subscribe(std::move(wake)); }
  void close() { board_.unsubscribe(subscription_); }
  std::optional<Message> next();
  [[nodiscard]] bool ended() const { return false; }
  [[nodiscard]] std::string resume_advice() const { return "for the service"; }

 private:
  HealthBoard& board_;
  std::string service_;
  std::optional<HealthBoard::Status> given_;
  std::uint64_t subscription_ = 0;
};

/// grpc.health.v1. Replaces gRPC's own service, which does not limit watches. It is open to everybody, so its watches
/// are counted separately: by peer address, and those over HTTP together. Thread-safe.
class HealthService {
 public:
  /// `board` outlives the service.
  HealthService(HealthBoard& board, const StreamParts& streams) : board_(board), streams_(streams) {}

  /// The service outlives the table.
  void add_methods(MethodTable& table);

 private:
  grpc::Status check(const Call&, const grpc::health::v1::HealthCheckRequest& request,
                     grpc::health::v1::HealthCheckResponse& response);
  std::unique_ptr<HealthSource> watch(const grpc::health::v1::HealthCheckRequest& request);

  HealthBoard& board_;
  StreamParts streams_;
};

}  // namespace cellcrush::rpc
