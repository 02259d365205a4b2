#include "http/gateway.h"

#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio.hpp>
#include <list>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "http/connection.h"
#include "http/tls_context.h"
#include "limited_log.h"
#include "net/connection_table.h"
#include "net/listening_port.h"

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;

constexpr std::chrono::milliseconds kPause{100};  // without descriptors, new connections wait in the kernel
constexpr std::chrono::seconds kCallsMayEnd{1};
constexpr std::chrono::milliseconds kBetweenLooks{20};

}  // namespace

// Members are used on the thread, except in the constructor and the destructor.
struct Gateway::Impl {
  Impl(const ListenAddress& address, const access::Gate& gate, const rpc::MethodTable& methods,
       const net::ConnectionLimits& limits)
      : tls(gate),
        port(address, "--http"),
        parts{gate, methods, limits, port.address().port, tls.current() != nullptr},
        table({limits.connections, limits.connections_per_address}),
        url((parts.has_tls ? "https://" : "http://") + port.address().text()) {
    for (const int descriptor : port.descriptors()) {
      sockaddr_storage name{};
      socklen_t size = sizeof(name);
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&name), &size);
      auto& acceptor = acceptors.emplace_back(io);
      acceptor.assign(name.ss_family == AF_INET6 ? tcp::v6() : tcp::v4(), dup(descriptor));
      asio::co_spawn(io, accept(acceptor), asio::detached);
    }
    thread = std::jthread([this] { io.run(); });
  }

  asio::awaitable<void> accept(tcp::acceptor& acceptor) {
    while (acceptor.is_open()) {
      boost::system::error_code error;
      tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
      if (error == asio::error::operation_aborted) co_return;
      if (error) {
        asio::steady_timer pause(io, kPause);
        co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
      } else {
        take(std::move(socket));
      }
    }
  }

  void take(tcp::socket socket) {
    boost::system::error_code error;
    const auto peer = socket.remote_endpoint(error);
    sockaddr_storage address{};
    if (error || peer.size() > sizeof(address)) return;
    std::memcpy(&address, peer.data(), peer.size());
    const std::string name = net::peer_of(address);
    if (const auto excess = table.admit(socket.native_handle(), name)) {
      refusals.write(spdlog::level::warn, "refused a connection to HTTP from " + name + ": " + *excess);
      return;
    }
    socket.set_option(tcp::no_delay(true), error);
    const auto connection = std::make_shared<Connection>(std::move(socket), tls.current(), parts);
    std::erase_if(connections, [](const auto& each) { return each.expired(); });
    connections.push_back(connection);
    asio::co_spawn(
        io, [connection]() { return connection->serve(); }, asio::detached);
  }

  void close_connections(bool also_calls) {
    for (const auto& each : connections)
      if (const auto connection = each.lock()) connection->close(also_calls);
  }

  void close_when_ended(std::chrono::steady_clock::time_point limit) {
    std::erase_if(connections, [](const auto& each) { return each.expired(); });
    if (connections.empty()) return;
    if (std::chrono::steady_clock::now() >= limit) return close_connections(true);
    end.expires_after(kBetweenLooks);
    end.async_wait([this, limit](boost::system::error_code) { close_when_ended(limit); });
  }

  void stop() {
    if (!thread.joinable()) return;
    asio::post(io, [this] {
      parts.stopping = true;
      for (auto& acceptor : acceptors) acceptor.close();
      close_connections(false);
      close_when_ended(std::chrono::steady_clock::now() + kCallsMayEnd);
    });
    thread.join();
  }

  TlsContext tls;
  net::ListeningPort port;
  GatewayParts parts;
  net::ConnectionTable table;
  std::string url;
  LimitedLog refusals{"refused HTTP connections", 1};
  std::vector<std::weak_ptr<Connection>> connections;
  asio::io_context io{1};
  asio::steady_timer end{io};
  std::list<tcp::acceptor> acceptors;
  std::jthread thread;
};

Gateway::Gateway(const ListenAddress& address, const access::Gate& gate, const rpc::MethodTable& methods,
                 const net::ConnectionLimits& limits)
    : impl_(std::make_unique<Impl>(address, gate, methods, limits)) {}

Gateway::~Gateway() { stop(); }

const std::string& Gateway::url() const { return impl_->url; }

void Gateway::stop() { impl_->stop(); }

}  // namespace cellcrush::http
