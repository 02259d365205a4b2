#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "grpc/health/v1/health.grpc.pb.h"
#include "mutex.h"
#include "rpc/stream_reactor.h"

namespace cellcrush::rpc {

/// Which services serve, and who waits for a change of that. Thread-safe.
class HealthBoard {
 public:
  using Status = grpc::health::v1::HealthCheckResponse::ServingStatus;
  using Wake = std::function<void()>;

  void set(const std::string& service, bool is_serving);
  /// All that were set.
  void set_all(bool is_serving);

  /// SERVICE_UNKNOWN for one that was never set.
  [[nodiscard]] Status find(const std::string& service) const;

  /// Calls `wake` on every change, from the thread that makes it and under the board's lock. Returns the id to
  /// unsubscribe with.
  std::uint64_t subscribe(Wake wake);
  void unsubscribe(std::uint64_t id);

 private:
  mutable Mutex mutex_;
  std::map<std::string, bool> services_ CELLCRUSH_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Wake> watchers_ CELLCRUSH_GUARDED_BY(mutex_);
  std::uint64_t next_id_ CELLCRUSH_GUARDED_BY(mutex_) = 1;
};

/// What a Health.Watch sends: the status of a service, and again whenever it changes. Not thread-safe but for the wake.
class HealthSource {
 public:
  using Message = grpc::health::v1::HealthCheckResponse;
  static constexpr bool kIsWatch = false;

  /// `board` outlives it.
  HealthSource(HealthBoard& board, std::string service) : board_(board), service_(std::move(service)) {}

  void open(std::function<void()> wake) { subscription_ = board_.subscribe(std::move(wake)); }
  void close() { board_.unsubscribe(subscription_); }
  std::optional<Message> next();
  [[nodiscard]] bool has_more() const { return false; }
  [[nodiscard]] bool ended() const { return false; }
  [[nodiscard]] std::optional<Message> bookmark() const { return std::nullopt; }
  [[nodiscard]] std::string resume_advice() const { return "for the service"; }

 private:
  HealthBoard& board_;
  std::string service_;
  std::optional<HealthBoard::Status> given_;
  std::uint64_t subscription_ = 0;
};

/// grpc.health.v1, which gRPC's own service answers as well, but with as many watches as anybody asks for. It is open
/// to all, so its watches are counted apart, by the address that they come from. Thread-safe.
class HealthService final : public grpc::health::v1::Health::CallbackService {
 public:
  /// All of it outlives the service.
  struct Parts {
    HealthBoard& board;
    StreamParts streams;
  };

  explicit HealthService(const Parts& parts) : parts_(parts) {}

  grpc::ServerUnaryReactor* Check(grpc::CallbackServerContext* context,
                                  const grpc::health::v1::HealthCheckRequest* request,
                                  grpc::health::v1::HealthCheckResponse* response) override;
  grpc::ServerWriteReactor<grpc::health::v1::HealthCheckResponse>* Watch(
      grpc::CallbackServerContext* context, const grpc::health::v1::HealthCheckRequest* request) override;

 private:
  Parts parts_;
};

}  // namespace cellcrush::rpc
