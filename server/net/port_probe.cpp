#include "net/port_probe.h"

#include <openssl/ssl.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <memory>
#include <utility>

#include "error.h"
#include "pause.h"

namespace cellcrush::net {
namespace {

using Clock = std::chrono::steady_clock;

bool is_ready(int socket, short what, Clock::time_point limit) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(limit - Clock::now());
  pollfd waiting{socket, what, 0};
  return left.count() > 0 && poll(&waiting, 1, static_cast<int>(left.count())) > 0;
}

bool connects(int socket, const SocketName& name, Clock::time_point limit) {
  if (connect(socket, reinterpret_cast<const sockaddr*>(&name.address), name.size) == 0) return true;
  if (errno != EINPROGRESS || !is_ready(socket, POLLOUT, limit)) return false;
  int error = 0;
  socklen_t size = sizeof(error);
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

bool answers_on(int socket, const SocketName& name, const std::string& hello, Clock::time_point limit) {
  if (!connects(socket, name, limit)) return false;
  if (!hello.empty()) static_cast<void>(send(socket, hello.data(), hello.size(), MSG_NOSIGNAL));
  return is_ready(socket, POLLIN, limit);
}

struct FreeSsl {
  void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
  void operator()(SSL* connection) const { SSL_free(connection); }
};

}  // namespace

std::string client_hello() {
  const std::unique_ptr<SSL_CTX, FreeSsl> context(SSL_CTX_new(TLS_client_method()));
  const std::unique_ptr<SSL, FreeSsl> connection(SSL_new(context.get()));
  constexpr unsigned char kHttp2[] = {2, 'h', '2'};
  SSL_set_alpn_protos(connection.get(), kHttp2, sizeof(kHttp2));
  BIO* sent = BIO_new(BIO_s_mem());
  SSL_set_bio(connection.get(), BIO_new(BIO_s_mem()), sent);  // takes ownership of both
  SSL_connect(connection.get());
  char* data = nullptr;
  const auto size = BIO_get_mem_data(sent, &data);
  return {data, static_cast<std::size_t>(size)};
}

bool answers(const ListenAddress& address, const std::string& hello, std::chrono::milliseconds patience) {
  const SocketName name = name_of(address);
  const int probe = socket(name.address.ss_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (probe < 0) return true;
  const bool out = answers_on(probe, name, hello, Clock::now() + patience);
  close(probe);
  return out;
}

PortProbe::PortProbe(Acceptor& acceptor, std::vector<bool> plain, const ConnectionLimits& limits)
    : acceptor_(acceptor),
      plain_(std::move(plain)),
      limits_(limits),
      hello_(client_hello()),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void PortProbe::work(const std::stop_token& stop) {
  while (pause_unless_stopped(stop, limits_.probe_interval)) {
    const auto addresses = acceptor_.addresses();
    for (std::size_t i = 0; i < addresses.size(); ++i) {
      if (stop.stop_requested()) return;
      check_port(i, addresses[i]);
    }
  }
}

void PortProbe::check_port(std::size_t port, const ListenAddress& address) {
  if (answers(address, plain_[port] ? "" : hello_, limits_.probe_patience)) return;
  try {
    acceptor_.reopen(port);
    spdlog::warn("{} did not answer the daemon's own probe and was reopened", address.text());
  } catch (const ServiceError& error) {
    spdlog::error("{} does not answer and cannot be reopened yet: {}", address.text(), error.what());
  }
}

}  // namespace cellcrush::net
