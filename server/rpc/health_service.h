#pragma once

#include <cstdint>
#include <functional>
#include <map>
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
  /// No service serves any more.
  void drain();
  /// Which loops are stuck, in sentences (Heartbeats); empty: none. No service serves meanwhile.
  void set_stuck(const std::string& stuck);

  struct Report {
    bool is_well = true;
    std::string words;
  };
  /// Whether the daemon makes progress.
  [[nodiscard]] Report progress() const;
  /// Whether it also takes jobs.
  [[nodiscard]] Report readiness() const;

  /// SERVICE_UNKNOWN for a service without a status.
  [[nodiscard]] Status find(const std::string& service) const;

  /// Calls `wake` on every change, on the changing thread and under the board's lock. Returns the id for unsubscribing.
  std::uint64_t subscribe(Wake wake);
  void unsubscribe(std::uint64_t id);

 private:
  void wake_watchers() const CELLCRUSH_REQUIRES(mutex_);
  [[nodiscard]] Status status_of(const std::string& service) const CELLCRUSH_REQUIRES(mutex_);

  mutable Mutex mutex_;
  bool is_draining_ CELLCRUSH_GUARDED_BY(mutex_) = false;
  std::string stuck_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::string, bool> services_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Wake> watchers_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(mutex_) = 1;
};

/// grpc.health.v1. Replaces gRPC's own service, which does not limit watches. It is open to everybody, so its watches
/// are counted separately: by peer address, and those over HTTP together. `board` outlives the table.
void add_health_methods(MethodTable& table, HealthBoard& board, const StreamParts& streams);

}  // namespace cellcrush::rpc
