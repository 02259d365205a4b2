#include "http/gateway.h"

#include <absl/strings/str_join.h>
#include <spdlog/spdlog.h>
#include <sys/socket.h>
#include <unistd.h>

#include <boost/asio.hpp>
#include <list>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "access/unix_user.h"
#include "error.h"
#include "http/connection.h"
#include "limited_log.h"
#include "net/connection_table.h"
#include "net/listening_port.h"

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;
namespace ssl = asio::ssl;
using asio::ip::tcp;

constexpr std::chrono::milliseconds kPause{100};  // without descriptors, new connections wait in the kernel
constexpr int kAtOnce = 64;  // connections
constexpr std::chrono::seconds kCallsMayEnd{1};
/// Of TLS 1.2: those that gRPC takes. OpenSSL's own three of TLS 1.3 are gRPC's too.
constexpr const char* kCiphers =
    "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-ECDSA-AES256-GCM-SHA384:ECDHE-RSA-AES128-GCM-SHA256:"
    "ECDHE-RSA-AES256-GCM-SHA384";
constexpr std::chrono::milliseconds kBetweenLooks{20};

// Browsers offer HTTP/2 as well. A client that offers neither is served all the same.
int choose_protocol(SSL*, const unsigned char** out, unsigned char* size, const unsigned char* offered, unsigned count,
                    void*) {
  constexpr std::string_view kOwn = "\x08http/1.1";
  unsigned char* chosen = nullptr;
  const int found = SSL_select_next_proto(&chosen, size, reinterpret_cast<const unsigned char*>(kOwn.data()),
                                          static_cast<unsigned>(kOwn.size()), offered, count);
  *out = chosen;
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

std::unique_ptr<ssl::context> context_of(const access::TlsFiles& files) {
  auto out = std::make_unique<ssl::context>(ssl::context::tls_server);
  SSL_CTX* native = out->native_handle();
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(native, kCiphers);
  SSL_CTX_set_alpn_select_cb(native, &choose_protocol, nullptr);
  // No client comes back under certificates or an authority of before.
  SSL_CTX_set_session_cache_mode(native, SSL_SESS_CACHE_OFF);
  SSL_CTX_set_options(native, SSL_OP_NO_TICKET | SSL_OP_NO_RENEGOTIATION);
  SSL_CTX_set_num_tickets(native, 0);
  out->use_certificate_chain(asio::buffer(files.certificate));
  out->use_private_key(asio::buffer(files.key), ssl::context::pem);
  if (!files.client_authority.empty()) {
    out->add_certificate_authority(asio::buffer(files.client_authority));
    out->set_verify_mode(ssl::verify_peer | ssl::verify_fail_if_no_peer_cert);
  }
  return out;
}

}  // namespace

// TLS for new connections, with the files that the gate has read last. Not thread-safe.
class Gateway::TlsContext {
 public:
  // `gate` outlives it. Throws ServiceError (invalid) if OpenSSL refuses the files.
  explicit TlsContext(const access::Gate& gate) : gate_(gate), files_(gate.tls()) {
    if (!files_) return;
    try {
      context_ = context_of(*files_);
    } catch (const boost::system::system_error& error) {
      throw ServiceError(ServiceError::Kind::invalid,
                         std::string("Cannot serve HTTP with the files of --tls-cert and --tls-key: ") + error.what() +
                             ". Make new ones, or give --http none.");
    }
  }

  // Null without TLS. If OpenSSL refuses changed files, logs it, and the previous ones stay in force.
  ssl::context* current() {
    auto next = gate_.tls();
    if (next == files_) return context_.get();
    files_ = std::move(next);
    try {
      context_ = context_of(*files_);
    } catch (const boost::system::system_error& error) {
      spdlog::error("HTTP cannot use the new certificates: {}. The previous ones stay in force for HTTP.",
                    error.what());
    }
    return context_.get();
  }

 private:
  const access::Gate& gate_;
  std::shared_ptr<const access::TlsFiles> files_;  // looked at last
  std::unique_ptr<ssl::context> context_;
};

// Members are used on the thread, except in the constructor and the destructor.
struct Gateway::Impl {
  Impl(const ListenAddress& address, const access::Gate& gate, const rpc::MethodTable& methods, rpc::Accounts& received,
       const rpc::HealthBoard& board, const net::ConnectionLimits& limits,
       const std::vector<std::string>& framing_origins, const PublicUrl& public_url)
      : tls(gate),
        port(address, "--http"),
        table({limits.connections, limits.connections_per_address}),
        parts{gate,
              methods,
              received,
              table,
              board,
              limits,
              absl::StrJoin(framing_origins, " "),
              public_url,
              tls.current() != nullptr},
        url((parts.has_tls ? "https://" : "http://") + port.address().text()) {
    for (const int descriptor : port.descriptors()) {
      sockaddr_storage name{};
      socklen_t size = sizeof(name);
      getsockname(descriptor, reinterpret_cast<sockaddr*>(&name), &size);
      auto& acceptor = acceptors.emplace_back(io);
      acceptor.assign(name.ss_family == AF_INET6 ? tcp::v6() : tcp::v4(), dup(descriptor));
      acceptor.non_blocking(true);
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
        take_waiting(acceptor);
      }
    }
  }

  // Each turn of the loop serves all connections, so a flood of new ones must not need a turn each.
  void take_waiting(tcp::acceptor& acceptor) {
    for (int i = 0; i < kAtOnce && acceptor.is_open(); ++i) {
      boost::system::error_code error;
      tcp::socket socket(io);
      acceptor.accept(socket, error);
      if (error) return;
      take(std::move(socket));
    }
  }

  void take(tcp::socket socket) {
    boost::system::error_code error;
    const auto peer = socket.remote_endpoint(error);
    sockaddr_storage address{};
    if (error || peer.size() > sizeof(address)) return;
    std::memcpy(&address, peer.data(), peer.size());
    const std::string name = net::peer_of(address);
    if (const auto excess = table.admit(socket.native_handle(), name, net::name_of(address))) {
      refusals.write(spdlog::level::warn, "refused a connection to HTTP from " + name + ": " + *excess);
      return;
    }
    socket.set_option(tcp::no_delay(true), error);
    const auto user = access::user_of_peer(socket.native_handle());
    const auto connection = std::make_shared<Connection>(std::move(socket), tls.current(), user, parts);
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
  net::ConnectionTable table;
  GatewayParts parts;
  std::string url;
  LimitedLog refusals{"refused HTTP connections", 1};
  std::vector<std::weak_ptr<Connection>> connections;
  asio::io_context io{1};
  asio::steady_timer end{io};
  std::list<tcp::acceptor> acceptors;
  std::jthread thread;
};

Gateway::Gateway(const ListenAddress& address, const access::Gate& gate, const rpc::MethodTable& methods,
                 rpc::Accounts& received, const rpc::HealthBoard& board, const net::ConnectionLimits& limits,
                 const std::vector<std::string>& framing_origins, const PublicUrl& public_url)
    : impl_(std::make_unique<Impl>(address, gate, methods, received, board, limits, framing_origins, public_url)) {}

Gateway::~Gateway() { stop(); }

const std::string& Gateway::url() const { return impl_->url; }

void Gateway::post(std::function<void()> work) { asio::post(impl_->io, std::move(work)); }

void Gateway::stop() { impl_->stop(); }

}  // namespace cellcrush::http
