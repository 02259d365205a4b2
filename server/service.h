#pragma once

#include <grpcpp/server_builder.h>

#include <functional>
#include <memory>

#include "access/gate.h"
#include "daemon_options.h"
#include "listen_address.h"
#include "rpc/health_service.h"

namespace cellcrush {

/// All of a daemon behind its addresses: store, jobs, watches and gRPC services on one data folder. Calls are answered
/// as soon as a server has it; jobs run between start and stop.
class Service {
 public:
  /// `gate` outlives it; `step_cost`: seconds of one core for a step of an element. Of the options those about
  /// addresses and access are not used. `on_drain` is called when a client has asked the daemon to end, and new jobs
  /// are refused. Throws ServiceError when the data folder is taken or cannot be used.
  Service(const DaemonOptions& options, const access::Gate& gate, double step_cost, std::function<void()> on_drain);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  /// It outlives the server that is built.
  void register_with(grpc::ServerBuilder& builder);

  /// What grpc.health.v1 answers. Lives as long as the service.
  rpc::HealthBoard& health();

  /// Streams that are open now.
  [[nodiscard]] std::size_t stream_count() const;

  /// For the metrics.
  void note_connections(std::size_t open);
  void note_refused_connection();

  /// metrics::Metrics::serve.
  ListenAddress serve_metrics(const ListenAddress& address);

  /// Goes on with the jobs that an earlier daemon left, and runs those that wait.
  void start();

  /// From now on no job is taken.
  void refuse_jobs();

  /// Lets running workers leave their jobs at a checkpoint, and then the watches end; calls are answered still.
  void stop();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cellcrush
