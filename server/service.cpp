#include "service.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "jobs/admission.h"
#include "jobs/deletion.h"
#include "jobs/housekeeping.h"
#include "jobs/local_process.h"
#include "jobs/mesh_places.h"
#include "jobs/queues.h"
#include "metrics/metrics.h"
#include "rpc/admin_service.h"
#include "rpc/cases_service.h"
#include "rpc/health_service.h"
#include "rpc/jobs_service.h"
#include "rpc/reflection_services.h"
#include "rpc/sweeps_service.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"
#include "watch/hub.h"
#include "watch/pump.h"

namespace cellcrush {
namespace {

// Health service name of the queues; not serving while one is held.
constexpr const char* kQueueHealth = "cellcrush.queue";
constexpr int kPumpThreads = 2;
constexpr int kHttpPumpThreads = 2;  // JSON is slow to make, and delays streams over HTTP only
constexpr int kCheckThreads = 12;    // threads for large cases; they wait for each other
constexpr std::size_t kWaitingCalls = 10'000;

// More would wait for each other's meshes.
int threads_of_sweep_check() {
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, jobs::MeshPlaces::kSmallMeshes);
}

rpc::StreamLimits::Most most_streams(const net::ConnectionLimits& limits) {
  return {limits.streams, limits.streams_per_caller, limits.memory_bytes};
}

// All executors, that of this machine first.
std::vector<jobs::Queues::NamedExecutor> executors_of(const DaemonOptions& options, double step_cost) {
  std::vector<jobs::Queues::NamedExecutor> out;
  out.push_back({store::kLocalExecutor, options.worker_count(),
                 std::make_unique<jobs::LocalProcess>(options.worker_program, options.stall_limit)});
  const jobs::ExecutorSurroundings surroundings{options.data_folder, options.worker_program, options.stall_limit,
                                                step_cost};
  for (const auto& given : options.executors) out.push_back({given.name, given.slots, given.make(surroundings)});
  return out;
}

}  // namespace

// Members are in order of dependence: each uses only those above it.
struct Service::Parts {
  Parts(const DaemonOptions& given, access::Gate& gate, double step_cost, std::function<void()> on_drain)
      : options(given),
        folder(options.data_folder),
        journal(
            folder.journal(), [this](std::int64_t job) { hub.announce(job); },
            [this](double seconds) { metrics.observe_commit(seconds); }, options.clocks.uptime),
        reader(folder.journal()),
        sweep_reader(folder.journal()),
        changes(folder.journal()),
        deletion({folder, journal, reader, sweep_reader}),
        queues({folder, journal, reader, hub, metrics, [this](bool open) { board.set(kQueueHealth, open); },
                options.hold_times, options.checkpoint_interval,
                std::chrono::duration<double>(options.limits.job_time).count(), options.limits.owner.running_jobs,
                options.default_executor},
               executors_of(options, step_cost)),
        stream_limits(most_streams(options.connections)),
        health_limits(most_streams(options.connections)),
        pump(kPumpThreads),
        http_pump(kHttpPumpThreads),
        admission({folder, reader, queues}, options.limits),
        calls({options.connections.threads, kWaitingCalls, options.connections.memory_bytes}),
        checks({kCheckThreads, kWaitingCalls, options.connections.memory_bytes}),
        cases(step_cost, calls, checks, mesh_places),
        health({board, {pump, metrics, health_limits, options.watch_times}}),
        jobs({folder, journal, reader, sweep_reader, changes, deletion, hub, queues, admission, gate, calls, checks,
              mesh_places, streams()}),
        sweeps({journal, reader, sweep_reader, deletion, hub, queues, admission, gate, calls, checks, mesh_places,
                threads_of_sweep_check(), step_cost, streams()}),
        admin({{reader, hub, queues, step_cost, options.limits.owner.running_jobs},
               calls,
               [this, drained = std::move(on_drain)] {
                 admission.drain();
                 drained();
               }}),
        reflection(rpc::make_reflection_services({"cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps",
                                                  "cellcrush.v1.Admin", "grpc.health.v1.Health"},
                                                 gate, stream_limits)),
        methods(gate, http_pump) {
    cases.add_methods(methods);
    health.add_methods(methods);
    jobs.add_methods(methods);
    sweeps.add_methods(methods);
    admin.add_methods(methods);
  }

  [[nodiscard]] rpc::StreamParts streams() { return {pump, metrics, stream_limits, options.watch_times}; }

  DaemonOptions options;
  store::DataFolder folder;
  watch::Hub hub;
  metrics::Metrics metrics;
  store::Journal journal;
  store::JournalReader reader;
  store::SweepReader sweep_reader;
  store::ChangeReader changes;
  jobs::Deletion deletion;
  rpc::HealthBoard board;
  jobs::Queues queues;
  rpc::StreamLimits stream_limits;
  rpc::StreamLimits health_limits;
  watch::Pump pump;
  watch::Pump http_pump;
  jobs::Admission admission;
  rpc::CallPool calls;
  rpc::CallPool checks;
  jobs::MeshPlaces mesh_places;
  rpc::CasesService cases;
  rpc::HealthService health;
  rpc::JobsService jobs;
  rpc::SweepsService sweeps;
  rpc::AdminService admin;
  std::vector<std::unique_ptr<grpc::Service>> reflection;
  rpc::MethodTable methods;
  std::optional<jobs::Housekeeping> housekeeping;
};

Service::Service(const DaemonOptions& options, access::Gate& gate, double step_cost, std::function<void()> on_drain)
    : parts_(std::make_unique<Parts>(options, gate, step_cost, std::move(on_drain))) {}

// Before the services whose sources the streams hold.
Service::~Service() { parts_->http_pump.stop(); }

void Service::register_with(grpc::ServerBuilder& builder) {
  parts_->methods.register_with(builder);
  for (const auto& service : parts_->reflection) builder.RegisterService(service.get());
}

const rpc::MethodTable& Service::methods() const { return parts_->methods; }

rpc::HealthBoard& Service::health() { return parts_->board; }

std::size_t Service::stream_count() const { return parts_->stream_limits.count() + parts_->health_limits.count(); }

void Service::note_connections(std::size_t open) { parts_->metrics.set_connections(open); }

void Service::note_refused_connection() { parts_->metrics.count_refused_connection(); }

ListenAddress Service::serve_metrics(const ListenAddress& address) { return parts_->metrics.serve(address); }

void Service::start() {
  Parts& parts = *parts_;
  parts.board.set(kQueueHealth, true);
  parts.housekeeping.emplace(jobs::Housekeeping::Parts{
      parts.folder, parts.journal, parts.reader, parts.sweep_reader, parts.deletion, parts.admission, parts.queues,
      parts.options.housekeeping_interval, parts.options.keep, parts.options.clocks});
  parts.housekeeping->check_disk();
  parts.deletion.finish_folders();
  parts.queues.start();
  parts.housekeeping->start();
}

void Service::refuse_jobs() { parts_->admission.drain(); }

void Service::stop() {
  parts_->housekeeping.reset();
  parts_->queues.stop();
  parts_->pump.drain();
  parts_->http_pump.drain();
}

}  // namespace cellcrush
