#include "checked_options.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <utility>

#include "error.h"
#include "jobs/queues.h"
#include "worker/device_of_run.h"

namespace cellcrush {
namespace {

constexpr const char* kDefaultTcp = "127.0.0.1:50551";
constexpr const char* kDefaultHttp = "127.0.0.1:8080";

}  // namespace

ListenAddress metrics_address(const std::string& text) {
  ListenAddress out = parse_listen_address(text);
  const auto refuse = [&text](const char* why) {
    throw ServiceError(ServiceError::Kind::invalid, "Cannot serve metrics on " + text + why);
  };
  if (out.kind != ListenAddress::Kind::tcp) refuse(": metrics need a TCP address. Use --metrics HOST:PORT.");
  if (!out.is_loopback()) {
    refuse(
        ", which other machines can reach: metrics have neither TLS nor authentication. Use a loopback address, such "
        "as --metrics 127.0.0.1:9464, with a proxy or SSH tunnel for remote access.");
  }
  return out;
}

std::vector<ListenAddress> listen_addresses(const DaemonOptions& options) {
  std::vector<ListenAddress> out;
  for (const auto& text : options.listen) out.push_back(parse_listen_address(text));
  if (!options.metrics.empty())
    static_cast<void>(metrics_address(options.metrics));  // rejects a bad address before anything is opened
  if (out.empty()) {
    out.push_back(parse_listen_address("unix:" + (options.data_folder / "cellcrushd.sock").string()));
    out.push_back(parse_listen_address(kDefaultTcp));
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

void warn_without_http(const ServiceError& why) { spdlog::warn("not serving HTTP: {}", why.what()); }

std::optional<ListenAddress> http_address(const access::Gate& gate, const DaemonOptions& options) {
  if (options.http == "none") return std::nullopt;
  try {
    auto out = parse_listen_address(options.http.empty() ? kDefaultHttp : options.http, "--http HOST:PORT");
    gate.check_http_address(out);
    return out;
  } catch (const ServiceError& error) {
    if (!options.http.empty()) throw;
    warn_without_http(error);
    return std::nullopt;
  }
}

DaemonOptions with_device(DaemonOptions options) {
  if (options.device.empty()) return options;
  try {
    spdlog::info("device: {}", worker::open_device(options.device)->name());
  } catch (const DeviceError& error) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "--device is \"" + options.device + "\". " + error.what() +
                           " Install its driver and library (core/device/README.md), or leave out --device.");
  }
  return options;
}

std::vector<std::string> check_options(const DaemonOptions& options) {
  with_device(options);
  const access::Gate gate(options.access);
  std::vector<std::string> out = {"data in " + options.data_folder.string()};
  const std::vector<ListenAddress> addresses = listen_addresses(options);
  credentials_for(gate, addresses);
  for (const ListenAddress& address : addresses) out.push_back("gRPC at " + address.text());
  const auto http = http_address(gate, options);
  out.push_back(http ? "HTTP at " + http->text() : "no HTTP");
  out.push_back(options.metrics.empty() ? "no metrics" : "metrics at " + options.metrics);
  notices::check(options.notices);
  std::vector<std::string> executors = {store::kLocalExecutor};
  for (const auto& executor : options.executors) executors.push_back(executor.name);
  jobs::check_executors(executors, options.default_executor);
  out.push_back(
      fmt::format("{} jobs at once on this machine, {} by default", options.worker_count(), options.default_executor));
  return out;
}

}  // namespace cellcrush
