#include "daemon.h"

#include <grpc/grpc.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "access/gate.h"
#include "error.h"
#include "jobs/admission.h"
#include "jobs/housekeeping.h"
#include "jobs/local_process.h"
#include "jobs/scheduler.h"
#include "listen_address.h"
#include "rpc/admin_service.h"
#include "rpc/cases_service.h"
#include "rpc/jobs_service.h"
#include "rpc/sweeps_service.h"
#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"
#include "watch/hub.h"
#include "watch/pump.h"
#include "worker/step_cost.h"

namespace cellcrush {
namespace {

constexpr int kLargestMessage = 4 * 1024 * 1024;
constexpr int kPumpThreads = 2;
constexpr std::chrono::seconds kCallsMayLast{2};
constexpr int kHandshakeMilliseconds = 5000;

int worker_limit(int asked) {
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

ListenAddress metrics_address(const std::string& text) {
  const ListenAddress out = parse_listen_address(text);
  const auto refuse = [&text](const char* why) {
    throw ServiceError(ServiceError::Kind::invalid, "Cannot serve metrics on " + text + why);
  };
  if (out.kind != ListenAddress::Kind::tcp) refuse(": they are served over HTTP. Use --metrics HOST:PORT.");
  if (!out.is_loopback()) {
    refuse(
        ", which others can reach: they are served without TLS and to whoever asks. Use a loopback address, such as "
        "--metrics 127.0.0.1:9464, and a proxy or an SSH tunnel from elsewhere.");
  }
  return out;
}

std::vector<ListenAddress> listen_addresses(const DaemonOptions& options) {
  std::vector<ListenAddress> out;
  for (const auto& text : options.listen) out.push_back(parse_listen_address(text));
  if (!options.metrics.empty())
    static_cast<void>(metrics_address(options.metrics));  // refused before anything is opened
  if (out.empty()) {
    out.push_back(parse_listen_address("unix:" + (options.data_folder / "cellcrushd.sock").string()));
    out.push_back(parse_listen_address("127.0.0.1:50551"));
  }
  return out;
}

std::vector<std::shared_ptr<grpc::ServerCredentials>> credentials_for(const access::Gate& gate,
                                                                      const std::vector<ListenAddress>& addresses) {
  std::vector<std::shared_ptr<grpc::ServerCredentials>> out;
  for (const auto& address : addresses) out.push_back(gate.credentials_for(address));
  return out;
}

void prepare_grpc_once() {
  static std::once_flag once;
  std::call_once(once, [] {
    grpc::EnableDefaultHealthCheckService(true);
    grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  });
}

}  // namespace

// Members are in the order of their dependence: each uses only those above it.
struct Daemon::Impl {
  explicit Impl(DaemonOptions given)
      : options(std::move(given)),
        wanted(listen_addresses(options)),
        gate(options.access),
        credentials(credentials_for(gate, wanted)),
        folder(options.data_folder),
        journal(
            folder.journal(), [this](std::int64_t job) { hub.announce(job); },
            [this](double seconds) { metrics.observe_commit(seconds); }),
        reader(folder.journal()),
        sweep_reader(folder.journal()),
        executor(options.worker_program, options.stall_limit),
        runner({folder, journal, reader, hub, executor, metrics, options.checkpoint_interval,
                std::chrono::duration<double>(options.limits.job_time).count()}),
        scheduler({folder, journal, reader, metrics, runner}),
        pump(kPumpThreads),
        step_cost(worker::measure_step_cost()),
        admission(folder, options.limits),
        cases(step_cost),
        jobs({folder, journal, reader, hub, pump, scheduler, admission, metrics, gate, options.bookmark_interval}),
        sweeps(
            {journal, reader, sweep_reader, hub, pump, scheduler, admission, metrics, gate, options.bookmark_interval}),
        admin({reader, hub, scheduler, {worker_limit(options.workers), step_cost, false}, gate, [this] { drain(); }}) {
    listen();
    serve_metrics();
    scheduler.start(worker_limit(options.workers));
    housekeeping.emplace(jobs::Housekeeping::Parts{folder, journal, reader, admission, scheduler,
                                                   options.housekeeping_interval, options.keep_ended_jobs});
    for (const char* service : {"cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps", "cellcrush.v1.Admin"})
      server->GetHealthCheckService()->SetServingStatus(service, true);
  }

  ~Impl() { stop(); }

  void listen() {
    prepare_grpc_once();
    grpc::ServerBuilder builder;
    builder.SetMaxReceiveMessageSize(kLargestMessage);
    // A port belongs to one daemon; without this a second one would share it.
    builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
    // Whoever connects and says nothing is let go.
    builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMilliseconds);
    std::vector<int> ports(wanted.size(), 0);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (wanted[i].kind == ListenAddress::Kind::unix_socket) remove_stale_socket(wanted[i].place);
      builder.AddListeningPort(wanted[i].text(), credentials[i], &ports[i]);
    }
    for (grpc::Service* service : std::initializer_list<grpc::Service*>{&cases, &jobs, &sweeps, &admin})
      builder.RegisterService(service);
    server = builder.BuildAndStart();
    for (std::size_t i = 0; i < wanted.size(); ++i) settle(wanted[i], ports[i]);
    if (!server) throw ServiceError(ServiceError::Kind::failed_precondition, "The service could not be started.");
  }

  // Notes the address that a port was bound to, or says which could not be.
  void settle(const ListenAddress& address, int port) {
    if (port == 0) {
      throw ServiceError(ServiceError::Kind::failed_precondition,
                         "Cannot listen on " + address.text() +
                             ": another program listens there, or it may not be used. Stop the other, or give another "
                             "address with --listen.");
    }
    ListenAddress bound = address;
    if (address.kind == ListenAddress::Kind::unix_socket) {
      chmod(address.place.c_str(), 0600);
    } else {
      bound.port = port;
    }
    addresses.push_back(bound.text());
  }

  void serve_metrics() {
    if (options.metrics.empty()) return;
    metrics_url = "http://" + metrics.serve(metrics_address(options.metrics)).text() + "/metrics";
    spdlog::info("metrics are served on {}", metrics_url);
  }

  void drain() {
    admission.drain();
    server->GetHealthCheckService()->SetServingStatus(false);
    if (options.on_drain) options.on_drain();
  }

  void stop() {
    if (std::exchange(stopped, true)) return;
    admission.drain();
    server->GetHealthCheckService()->SetServingStatus(false);
    housekeeping.reset();
    scheduler.stop();
    pump.drain();
    server->Shutdown(std::chrono::system_clock::now() + kCallsMayLast);
    server->Wait();
  }

  DaemonOptions options;
  std::vector<ListenAddress> wanted;
  access::Gate gate;
  std::vector<std::shared_ptr<grpc::ServerCredentials>> credentials;  ///< of the wanted addresses
  store::DataFolder folder;
  watch::Hub hub;
  metrics::Metrics metrics;
  store::Journal journal;
  store::JournalReader reader;
  store::SweepReader sweep_reader;
  jobs::LocalProcess executor;
  jobs::JobRunner runner;
  jobs::Scheduler scheduler;
  watch::Pump pump;
  double step_cost;
  jobs::Admission admission;
  rpc::CasesService cases;
  rpc::JobsService jobs;
  rpc::SweepsService sweeps;
  rpc::AdminService admin;
  std::vector<std::string> addresses;
  std::string metrics_url;
  std::unique_ptr<grpc::Server> server;
  std::optional<jobs::Housekeeping> housekeeping;
  bool stopped = false;
};

Daemon::Daemon(DaemonOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Daemon::~Daemon() = default;

const std::vector<std::string>& Daemon::addresses() const { return impl_->addresses; }

const std::string& Daemon::metrics_url() const { return impl_->metrics_url; }

void Daemon::stop() { impl_->stop(); }

}  // namespace cellcrush
