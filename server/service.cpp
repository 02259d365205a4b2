#include "service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <utility>

#include "error_table.h"
#include "jobs/local_process.h"

namespace cellcrush {
namespace {

// Health service name of the queues; not serving while one is held.
constexpr const char* kQueueHealth = "cellcrush.queue";
// Of the journal; not serving once it has lost changes or was found damaged.
constexpr const char* kJournalHealth = "cellcrush.journal";
constexpr int kPumpThreads = 4;
constexpr int kHttpPumpThreads = 4;  // JSON is slow to make, and delays streams over HTTP only
constexpr int kCheckThreads = 12;    // threads for large cases; they wait for each other
constexpr int kLargeChecks = 6;      // at once; the other threads are left to small cases
constexpr int kLargeChecksPerCaller = 2;
constexpr int kExports = 4;
constexpr int kExportsPerCaller = 2;
constexpr std::size_t kWaitingCalls = 2'000;  // of one caller

// More would wait for each other's meshes.
int threads_of_sweep_check() { return std::min(usable_cores().count, jobs::MeshPlaces::kSmallMeshes); }

// Of one caller.
int most_threads(int threads) { return std::max(1, threads / 2); }

rpc::StreamLimits::Most most_streams(const net::ConnectionLimits& limits) {
  return {limits.streams, limits.streams_per_caller, limits.memory_bytes};
}

// An export that nobody reads keeps others out, as an answer does.
watch::WatchTimes times_of_exports(watch::WatchTimes times) {
  times.patience = std::min(times.patience, times.patience_when_short);
  times.grace = std::min(times.grace, times.grace_when_short);
  return times;
}

// All executors, that of this machine first.
std::vector<jobs::Queues::NamedExecutor> executors_of(const DaemonOptions& options, double step_cost) {
  spdlog::info("workers: {}, on {}", options.worker_count(), usable_cores().text());
  std::vector<jobs::Queues::NamedExecutor> out;
  auto local = std::make_unique<jobs::LocalProcess>(options.worker_program, options.stall_limit);
  local->use_device(options.device);
  out.push_back({store::kLocalExecutor, options.worker_count(), std::move(local)});
  const jobs::ExecutorSurroundings surroundings{options.data_folder, options.worker_program, options.stall_limit,
                                                step_cost};
  for (const auto& given : options.executors) out.push_back({given.name, given.slots, given.make(surroundings)});
  return out;
}

}  // namespace

Service::Service(const DaemonOptions& given, access::Gate& gate, double step_cost, std::function<void()> on_drain)
    : options(given),
      folder(options.data_folder),
      audit(options.audit_log),
      journal(
          folder.journal(), [this](std::int64_t job) { hub.announce(job); },
          [this](double seconds) { metrics.observe_commit(seconds); }, options.clocks.uptime),
      reader(folder.journal()),
      sweep_reader(folder.journal()),
      changes(folder.journal()),
      deletion({folder, journal, reader, sweep_reader}),
      notices({journal, changes, reader, sweep_reader, metrics,
               store::epoch_for_callers(journal.epoch(), folder.journal()).id},
              options.notices),
      queues({folder, journal, reader, hub, metrics, [this](const auto& standings) { set_standings(standings); },
              options.hold_times, options.checkpoint_interval,
              std::chrono::duration<double>(options.limits.job_time).count(), options.limits.job_memory_bytes,
              options.limits.owner.running_jobs, options.default_executor, step_cost},
             executors_of(options, step_cost)),
      stream_limits(most_streams(options.connections)),
      health_limits(most_streams(options.connections)),
      export_limits({kExports, kExportsPerCaller, options.connections.memory_bytes, "exports", ""}),
      pump(kPumpThreads),
      http_pump(kHttpPumpThreads),
      admission({folder, reader, queues}, options.limits),
      received({options.connections.memory_bytes / 4, options.connections.memory_bytes / 8}),
      memory({options.connections.memory_bytes / 2, options.connections.memory_bytes / 4}),
      calls({options.connections.threads, most_threads(options.connections.threads), 0, 0, kWaitingCalls}, memory),
      checks({kCheckThreads, most_threads(kCheckThreads), kLargeChecks, kLargeChecksPerCaller, kWaitingCalls}, memory),
      shared{folder,
             audit,
             journal,
             reader,
             sweep_reader,
             changes,
             deletion,
             hub,
             queues,
             admission,
             gate,
             calls,
             checks,
             mesh_places,
             threads_of_sweep_check(),
             step_cost,
             !options.device.empty(),
             options.limits.owner.running_jobs,
             {pump, checks, metrics, stream_limits, options.watch_times},
             {pump, checks, metrics, export_limits, times_of_exports(options.watch_times)}},
      reflection(rpc::make_reflection_services({"cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps",
                                                "cellcrush.v1.Admin", "grpc.health.v1.Health"},
                                               gate, stream_limits)),
      methods(gate, http_pump, calls, received, store::epoch_for_callers(journal.epoch(), folder.journal()),
              times_of_exports(options.watch_times).patience) {
  methods.on_ended = [this](const rpc::MethodTable::CallEnd& end) {
    metrics.count_call(end.method, name_of(end.code), end.seconds);
  };
  gate.on_refused = [this](std::string_view path, const std::string& caller, const grpc::Status& status) {
    if (!path.empty()) methods.note_end(path, status.error_code());
    audit.note_refusal(std::string(path), caller, name_of(status.error_code()), status.error_message());
  };
  rpc::add_cases_methods(methods, shared);
  rpc::add_health_methods(methods, board, {pump, checks, metrics, health_limits, options.watch_times});
  rpc::add_jobs_methods(methods, shared);
  rpc::add_sweeps_methods(methods, shared);
  rpc::add_admin_methods(methods, shared, [this, drained = std::move(on_drain)] {
    admission.drain();
    drained();
  });
}

// Before the methods, whose calls and sources they hold.
Service::~Service() {
  metrics.ask(nullptr);
  http_pump.stop();
  checks.stop();
  calls.stop();
}

void Service::register_with(grpc::ServerBuilder& builder) {
  methods.register_with(builder);
  for (const auto& service : reflection) builder.RegisterService(service.get());
}

void Service::start() {
  board.set(kQueueHealth, true);
  housekeeping.emplace(jobs::Housekeeping::Parts{folder, journal, reader, sweep_reader, deletion, admission, queues,
                                                 options.housekeeping_interval, options.keep, options.clocks,
                                                 [this](bool is_whole) {
                                                   board.set(kJournalHealth, is_whole);
                                                   metrics.set_journal_damaged(!is_whole);
                                                 }});
  housekeeping->check_disk();
  deletion.finish_folders();
  queues.start();
  housekeeping->start();
  notices.start();
  if (!options.device.empty()) metrics.set_device(options.device);
  metrics.ask([this] { return measure(); });
}

void Service::set_standings(const std::vector<jobs::Queues::Standing>& standings) {
  std::set<Shortage> shortages;
  for (const auto& standing : standings) {
    for (const auto& hold : standing.holds) shortages.insert(hold.shortage);
  }
  metrics.set_holds(shortages);
  board.set(kQueueHealth, shortages.empty());
  notices.set_standings(standings);
}

metrics::Standing Service::measure() {
  metrics::Standing out;
  const auto load = queues.load();
  out.owners = load.owners;
  for (const auto& [owner, bytes] : reader.bytes_by_owner()) out.owners[owner].bytes = bytes;
  out.queue_age_s = load.longest_wait_s;
  out.free_disk_bytes = folder.free_bytes();
  out.kept_disk_bytes = admission.limits().free_disk_bytes;
  out.behind = notices.behind();
  return out;
}

void Service::stop() {
  if (housekeeping) housekeeping->stop();
  queues.stop();
  notices.stop();
  pump.drain();
  http_pump.drain();
}

}  // namespace cellcrush
