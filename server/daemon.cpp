#include "daemon.h"

#include <grpc/grpc.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <mutex>
#include <utility>

#include "access/gate.h"
#include "error.h"
#include "listen_address.h"
#include "service.h"
#include "worker/step_cost.h"

namespace cellcrush {
namespace {

constexpr int kLargestMessage = 4 * 1024 * 1024;
constexpr std::chrono::seconds kCallsMayLast{2};
constexpr int kHandshakeMilliseconds = 5000;

ListenAddress metrics_address(const std::string& text) {
  ListenAddress out = parse_listen_address(text);
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
  out.reserve(addresses.size());
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
        service(options, gate, worker::measure_step_cost(), [this] { drain(); }) {
    listen();
    serve_metrics();
    service.start();
    for (const char* name : {"cellcrush.v1.Cases", "cellcrush.v1.Jobs", "cellcrush.v1.Sweeps", "cellcrush.v1.Admin"})
      server->GetHealthCheckService()->SetServingStatus(name, true);
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
    service.register_with(builder);
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
    metrics_url = "http://" + service.serve_metrics(metrics_address(options.metrics)).text() + "/metrics";
    spdlog::info("metrics are served on {}", metrics_url);
  }

  void drain() {
    server->GetHealthCheckService()->SetServingStatus(false);
    if (options.on_drain) options.on_drain();
  }

  void stop() {
    if (std::exchange(stopped, true)) return;
    service.refuse_jobs();
    server->GetHealthCheckService()->SetServingStatus(false);
    service.stop();
    server->Shutdown(std::chrono::system_clock::now() + kCallsMayLast);
    server->Wait();
  }

  DaemonOptions options;
  std::vector<ListenAddress> wanted;
  access::Gate gate;
  std::vector<std::shared_ptr<grpc::ServerCredentials>> credentials;  ///< of the wanted addresses
  Service service;
  std::vector<std::string> addresses;
  std::string metrics_url;
  std::unique_ptr<grpc::Server> server;
  bool stopped = false;
};

Daemon::Daemon(DaemonOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {}

Daemon::~Daemon() = default;

const std::vector<std::string>& Daemon::addresses() const { return impl_->addresses; }

const std::string& Daemon::metrics_url() const { return impl_->metrics_url; }

void Daemon::read_tokens_again() { impl_->gate.read_tokens_again(); }

void Daemon::stop() { impl_->stop(); }

}  // namespace cellcrush
