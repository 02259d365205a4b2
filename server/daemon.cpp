#include "daemon.h"

#include <absl/strings/str_replace.h>
#include <grpc/grpc.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>
#include <mutex>
#include <optional>
#include <utility>

#include "access/call_backlog.h"
#include "access/gate.h"
#include "access/local_doors.h"
#include "access/unix_user.h"
#include "checked_options.h"
#include "error.h"
#include "http/gateway.h"
#include "jobs/queue_forecast.h"
#include "limited_log.h"
#include "listen_address.h"
#include "net/acceptor.h"
#include "net/connection_limits.h"
#include "net/listening_port.h"
#include "net/port_probe.h"
#include "net/refusing_server.h"
#include "revision.h"
#include "rpc/method_table.h"
#include "rpc/open_calls.h"
#include "rpc/request_fields.h"
#include "service.h"

namespace cellcrush {
namespace {

constexpr std::chrono::seconds kCallsMayLast{2};
constexpr int kCallsBesideStreams = 100;
constexpr std::size_t kIntroductions = 4;       // threads
constexpr int kBetweenPingsOfAClient = 10'000;  // ms
constexpr int kMostReadAtOnce = 32 * 1024;      // bytes; gRPC opens all calls in them before it ends one
/// Services with a status in grpc.health.v1; "" is the whole daemon.
constexpr std::array kServices = {"", "cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps",
                                  "cellcrush.v1.Admin"};

constexpr const char* kAnyHttp = "127.0.0.1:0";  // where the default is another user's

void prepare_grpc_once() {
  static std::once_flag once;
  redirect_library_logs();
  std::call_once(once, [] {
    // The service answers grpc.health.v1 itself.
    grpc::EnableDefaultHealthCheckService(false);
    // Held until the process ends: gRPC's shutdown joins its backup poller, which may sleep for 10 s. That thread
    // starts when a client reads more slowly than the daemon writes.
    grpc_init();
  });
}

DaemonOptions with_descriptors(DaemonOptions options) {
  auto& limits = options.connections;
  limits.connections = net::raise_descriptor_limit(limits.connections, options.worker_count());
  limits.connections_per_address = std::min(limits.connections_per_address, limits.connections);
  return options;
}

}  // namespace

// Members are in order of dependence: each uses only those above it.
struct Daemon::Impl {
  explicit Impl(DaemonOptions given)
      : options(with_descriptors(with_device(std::move(given)))),
        wanted(listen_addresses(options)),
        gate(options.access),
        credentials(credentials_for(gate, wanted)),
        wanted_http(http_address(gate, options)),
        service(options, gate, jobs::measure_step_cost(), [this] { drain(); }) {
    try {
      serve();
    } catch (...) {
      stop();
      throw;
    }
  }

  ~Impl() { stop(); }

  void serve() {
    listen();
    serve_metrics();
    serve_http();
    service.audit.note_event("started", kSolverRevision);
    service.start();
    for (const char* name : kServices) service.board.set(name, true);
    heartbeats.emplace(loops(), options.heartbeats, [this](const std::string& stuck) {
      service.board.set_stuck(stuck);
      if (stuck.empty() && options.on_progress) options.on_progress();
    });
  }

  void listen() {
    prepare_grpc_once();
    std::vector<net::ListeningPort> ports = open_ports();
    grpc::ServerBuilder builder;
    limit(builder);
    std::vector<bool> plain;
    using External = grpc::ServerBuilder::experimental_type::ExternalConnectionType;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      auto& door = doors.emplace_back();
      if (gate.knows_local_callers(wanted[i])) {
        door.local.emplace(gate, wanted[i], builder);
      } else {
        door.common = builder.experimental().AddExternalConnectionAcceptor(External::FROM_FD, credentials[i]);
      }
      plain.push_back(wanted[i].kind == ListenAddress::Kind::unix_socket || options.access.tls_certificate.empty());
    }
    service.register_with(builder);
    rpc::count_calls(builder, gate);
    server = builder.BuildAndStart();
    if (!server) throw ServiceError(ServiceError::Kind::failed_precondition, "The gRPC server could not be started.");
    for (const auto& port : ports) addresses.push_back(port.address().text());
    refusing_server.emplace(credentials);
    net::Acceptor::Parts parts;
    parts.hand_over = [this](std::size_t port, int listener, int descriptor) {
      if (doors[port].local && gate.asks_user_database(descriptor)) {
        boost::asio::post(introductions, [=, this] { hand_over(port, listener, descriptor); });
      } else {
        hand_over(port, listener, descriptor);
      }
    };
    parts.turn_away = [this](std::size_t port, int listener, int descriptor) {
      refusing_server->take(port, listener, descriptor);
    };
    parts.refused = [this](const std::string& why) {
      refusals.write(spdlog::level::warn, "refused " + why);
      service.metrics.count_refused_connection();
    };
    parts.counted = [this](std::size_t open) {
      service.metrics.set_connections(open);
      heap.look();
      gate.backlog().look();
      service.methods.open_calls().look();
    };
    acceptor.emplace(std::move(ports), options.connections, std::move(parts));
    service.methods.on_admitted = [this](const std::string& connection, const std::string& caller) {
      acceptor->know(connection, caller);
    };
    gate.backlog().on_flood([this](const std::string& connection) { acceptor->cut(connection); });
    acceptor->start();
    const auto is_tcp = [](const ListenAddress& address) { return address.kind == ListenAddress::Kind::tcp; };
    const bool has_tcp = wanted_http || std::ranges::any_of(wanted, is_tcp);
    if (has_tcp && gate.knows_local_callers({}))
      spdlog::info("ports of loopback serve {} alone, without a token", access::own_user());
    probe.emplace(*acceptor, plain, options.connections);
  }

  void hand_over(std::size_t port, int listener, int descriptor) {
    auto& door = doors[port];
    if (auto* to = door.local ? door.local->find_port(descriptor) : door.common.get()) {
      net::hand_over(*to, listener, descriptor);
    } else {
      refusals.write(spdlog::level::warn, "refused a connection: too many Unix users have called this daemon");
      refusing_server->take(port, listener, descriptor);
    }
  }

  // Whoever needs another port names it; a default one that is taken is another daemon's.
  std::vector<net::ListeningPort> open_ports() {
    std::vector<net::ListeningPort> out;
    for (auto address = wanted.begin(); address != wanted.end();) {
      try {
        // With groups, the gate decides who is let in.
        out.emplace_back(*address, "--listen", options.access.groups.empty() ? 0600 : 0666);
        ++address;
      } catch (const ServiceError& error) {
        if (!options.listen.empty() || address->kind == ListenAddress::Kind::unix_socket) throw;
        spdlog::info("not listening on {}, which another program uses: {} is enough for this user", address->text(),
                     out.front().address().text());
        credentials.erase(credentials.begin() + (address - wanted.begin()));
        address = wanted.erase(address);
      }
    }
    return out;
  }

  // Limits that gRPC enforces; the acceptor and the streams enforce the rest.
  void limit(grpc::ServerBuilder& builder) const {
    const auto milliseconds = [](std::chrono::milliseconds time) { return static_cast<int>(time.count()); };
    const auto& limits = options.connections;
    builder.SetMaxReceiveMessageSize(rpc::kLargestMessage);
    grpc::ResourceQuota quota("cellcrushd");
    quota.Resize(static_cast<std::size_t>(limits.memory_bytes));
    builder.SetResourceQuota(quota);
    // Drops connections that stay silent, and peers that vanished.
    builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, milliseconds(limits.handshake));
    builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_IDLE_MS, milliseconds(limits.idle));
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, milliseconds(limits.keepalive));
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, milliseconds(limits.keepalive_answer));
    // Clients may send pings as well, but not too often.
    builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, kBetweenPingsOfAClient);
    builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
    // A caller with too many streams is refused another, but can make other calls.
    builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, limits.streams_per_caller + kCallsBesideStreams);
    builder.AddChannelArgument(GRPC_ARG_TCP_MAX_READ_CHUNK_SIZE, kMostReadAtOnce);
    // It would raise the 64 kB that each call may send before its request is read.
    builder.AddChannelArgument(GRPC_ARG_HTTP2_BDP_PROBE, 0);
    builder.AddChannelArgument(GRPC_ARG_ENABLE_CHANNELZ, 0);
  }

  void serve_metrics() {
    if (options.metrics.empty()) return;
    metrics_url = "http://" + service.metrics.serve(metrics_address(options.metrics)).text() + "/metrics";
    spdlog::info("serving metrics on {}", metrics_url);
  }

  void serve_http() {
    if (!wanted_http) return;
    const auto site = http::parse_public_url(options.public_url);
    const auto open = [&](const ListenAddress& address) {
      gateway.emplace(address, gate, service.methods, service.received, service.board, options.connections,
                      options.framing_origins, site);
    };
    try {
      open(*wanted_http);
    } catch (const ServiceError& error) {
      if (!options.http.empty()) throw;
      if (error.kind() != ServiceError::Kind::failed_precondition) return warn_without_http(error);
      spdlog::info("{} is taken, so the page is served on a free port, which `cellcrush open` knows",
                   wanted_http->text());
      open(parse_listen_address(kAnyHttp));
    }
    http_url = gateway->url();
    gate.sessions().serve_at(site.host.empty() ? absl::StrReplaceAll(http_url, {{"//0.0.0.0:", "//localhost:"}})
                                               : site.origin + site.path);
    spdlog::info("serving HTTP on {}", http_url);
  }

  std::vector<Heartbeats::Loop> loops() {
    using Beat = Heartbeats::Beat;
    std::vector<Heartbeats::Loop> out;
    out.push_back({"The scheduler", [this](const Beat& beat) {
                     static_cast<void>(service.queues.waiting_count());
                     beat();
                   }});
    out.push_back({"The journal", [this](const Beat& beat) {
                     service.journal.await_turn();
                     beat();
                   }});
    out.push_back({"The loop of watches", [this](Beat beat) { service.pump.post(std::move(beat)); }});
    out.push_back({"The loop of watches over HTTP", [this](Beat beat) { service.http_pump.post(std::move(beat)); }});
    constexpr int kLongWork = 6;  // deletions and checks take seconds
    out.push_back({"The pool of calls", [this](Beat beat) { service.calls.post(std::move(beat)); }, kLongWork});
    out.push_back({"The pool of checks", [this](Beat beat) { service.checks.post(std::move(beat)); }, kLongWork});
    out.push_back({"Housekeeping", [this](Beat beat) { service.housekeeping->post(std::move(beat)); }, kLongWork});
    if (gateway) out.push_back({"The loop of HTTP", [this](Beat beat) { gateway->post(std::move(beat)); }});
    return out;
  }

  void drain() {
    service.board.drain();
    if (options.on_drain) options.on_drain();
  }

  void stop() {
    if (std::exchange(stopped, true)) return;
    service.admission.drain();
    service.board.drain();
    service.stop();
    service.audit.note_event("stopped");
    heartbeats.reset();
    probe.reset();
    if (acceptor) acceptor->stop();
    introductions.join();
    if (gateway) gateway->stop();
    // Not left to gRPC: it would wait for idle connections too, whose clients do not read its request to close them.
    service.methods.open_calls().wait_until_none(kCallsMayLast);
    if (!server) return;
    server->Shutdown(std::chrono::system_clock::now());
    server->Wait();
  }

  DaemonOptions options;
  std::vector<ListenAddress> wanted;
  access::Gate gate;
  std::vector<std::shared_ptr<grpc::ServerCredentials>> credentials;  ///< of the requested addresses
  std::optional<ListenAddress> wanted_http;
  Service service;
  std::vector<std::string> addresses;
  std::string metrics_url;
  std::string http_url;
  /// Where gRPC takes the connections of an address.
  struct Door {
    std::optional<access::LocalDoors> local;
    std::unique_ptr<access::LocalDoors::Port> common;  ///< null with local
  };
  std::vector<Door> doors;  ///< of the requested addresses
  LimitedLog refusals{"refused connections", 1};
  net::HeapTrim heap;
  std::unique_ptr<grpc::Server> server;
  std::optional<net::RefusingServer> refusing_server;
  boost::asio::thread_pool introductions{kIntroductions};  ///< of callers for whom the user database is asked
  std::optional<net::Acceptor> acceptor;
  std::optional<net::PortProbe> probe;
  std::optional<http::Gateway> gateway;
  std::optional<Heartbeats> heartbeats;
  bool stopped = false;
};

Daemon::Daemon(DaemonOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Daemon::~Daemon() = default;

const std::vector<std::string>& Daemon::addresses() const { return impl_->addresses; }

const std::string& Daemon::metrics_url() const { return impl_->metrics_url; }

const std::string& Daemon::http_url() const { return impl_->http_url; }

void Daemon::read_files_again() {
  impl_->gate.read_files_again();
  impl_->service.audit.reopen();
  impl_->service.audit.note_event("reloaded");
}

void Daemon::stop() { impl_->stop(); }

}  // namespace cellcrush
