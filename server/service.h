#pragma once

#include <grpcpp/server_builder.h>

#include <functional>
#include <memory>

#include "access/gate.h"
#include "daemon_options.h"
#include "listen_address.h"
#include "rpc/health_service.h"
#include "rpc/method_table.h"

namespace cellcrush {

/// Everything behind a daemon's addresses: store, jobs, watches and gRPC services on one data folder. Calls are
/// answered as soon as a server has registered it; jobs run between start and stop.
class Service {
 public:
  /// `gate` outlives it, and guards its methods from now on; `step_cost`: seconds of one core per element and step.
  /// Ignores the options for addresses and access. Calls `on_drain` once a client has asked the daemon to drain and new
  /// jobs are refused. Throws ServiceError if the data folder is taken or unusable.
  Service(const DaemonOptions& options, access::Gate& gate, double step_cost, std::function<void()> on_drain);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// Outlives the server that is built.
  void register_with(grpc::ServerBuilder& builder);

  /// The methods, for callers that are not gRPC. Lives as long as the service.
  [[nodiscard]] const rpc::MethodTable& methods() const;

  /// Statuses for grpc.health.v1. Lives as long as the service.
  rpc::HealthBoard& health();

  /// Number of open streams.
  [[nodiscard]] std::size_t stream_count() const;

  /// For the metrics.
  void note_connections(std::size_t open);
  void note_refused_connection();

  /// metrics::Metrics::serve.
  ListenAddress serve_metrics(const ListenAddress& address);

  /// Resumes the jobs of an earlier daemon, and runs the waiting ones.
  void start();

  /// Refuses new jobs from now on.
  void refuse_jobs();

  /// Has running workers checkpoint their jobs, then ends the watches. Other calls are still answered.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cellcrush
