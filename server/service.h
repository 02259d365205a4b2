#pragma once

#include <grpcpp/server_builder.h>

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "access/gate.h"
#include "audit_log.h"
#include "daemon_options.h"
#include "jobs/housekeeping.h"
#include "metrics/metrics.h"
#include "notices/notices.h"
#include "rpc/health_service.h"
#include "rpc/services.h"
#include "watch/pump.h"

namespace cellcrush {

/// Everything behind a daemon's addresses: store, jobs, watches and gRPC services on one data folder. Calls are
/// answered as soon as a server has registered it; jobs run between start and stop.
struct Service {
  /// `gate` outlives it, and guards its methods from now on; `step_cost`: that of WorkerFacts.
  /// Ignores the options for addresses and access. Calls `on_drain` once a client has asked the daemon to drain and new
  /// jobs are refused. Throws ServiceError if the data folder is taken or unusable.
  Service(const DaemonOptions& given, access::Gate& gate, double step_cost, std::function<void()> on_drain);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// Outlives the server that is built.
  void register_with(grpc::ServerBuilder& builder);

  /// Resumes the jobs of an earlier daemon, and runs the waiting ones.
  void start();

  /// Has running workers checkpoint their jobs, then ends the watches. Other calls are still answered.
  void stop();

  // In order of dependence: each uses only those above it.
  DaemonOptions options;
  store::DataFolder folder;
  watch::Hub hub;
  AuditLog audit;
  metrics::Metrics metrics;
  store::Journal journal;
  store::JournalReader reader;
  store::SweepReader sweep_reader;
  store::ChangeReader changes;
  jobs::Deletion deletion;
  rpc::HealthBoard board;
  notices::Notices notices;
  jobs::Queues queues;
  rpc::StreamLimits stream_limits;
  rpc::StreamLimits health_limits;
  rpc::StreamLimits export_limits;
  watch::Pump pump;
  watch::Pump http_pump;
  jobs::Admission admission;
  rpc::Accounts received;  ///< requests that wait to be parsed
  rpc::Accounts memory;    ///< calls in work, and answers that their clients have not read
  rpc::CallPool calls;
  rpc::CallPool checks;
  jobs::MeshPlaces mesh_places;
  rpc::ServiceParts shared;
  std::vector<std::unique_ptr<grpc::Service>> reflection;
  rpc::MethodTable methods;
  std::optional<jobs::Housekeeping> housekeeping;

 private:
  void set_standings(const std::vector<jobs::Queues::Standing>& standings);
  [[nodiscard]] metrics::Standing measure();
};

}  // namespace cellcrush
