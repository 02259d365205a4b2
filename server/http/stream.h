#pragma once

#include <boost/asio.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/ssl.hpp>
#include <optional>
#include <utility>

namespace cellcrush::http {

/// A client's socket with time limits, with or without TLS; an asynchronous stream of Asio. Not thread-safe.
class Stream {
 public:
  using executor_type = boost::beast::tcp_stream::executor_type;  // NOLINT(readability-identifier-naming): of Asio

  /// `context`: null for plain text; need not outlive the constructor.
  Stream(boost::asio::ip::tcp::socket socket, boost::asio::ssl::context* context) : plain_(std::move(socket)) {
    if (context != nullptr) tls_.emplace(plain_, *context);
  }

  executor_type get_executor() { return plain_.get_executor(); }

  /// The socket under TLS; its limits hold for both.
  boost::beast::tcp_stream& plain() { return plain_; }

  /// The certificate that the client showed; null if it showed none. Belongs to the stream.
  [[nodiscard]] const X509* client_certificate() {
    return tls_ ? SSL_get0_peer_certificate(tls_->native_handle()) : nullptr;
  }

  /// Agrees on keys with the client. Throws system_error if that fails.
  boost::asio::awaitable<void> begin() {
    if (tls_) co_await tls_->async_handshake(boost::asio::ssl::stream_base::server, boost::asio::use_awaitable);
  }

  /// Tells the client that no more follows. Throws system_error if it does not answer.
  boost::asio::awaitable<void> end() {
    if (tls_) co_await tls_->async_shutdown(boost::asio::use_awaitable);
  }

  template <class Buffers, class Token>
  auto async_read_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(boost::system::error_code, std::size_t)>(
        [this](auto handler, const Buffers& into) {
          tls_ ? tls_->async_read_some(into, std::move(handler)) : plain_.async_read_some(into, std::move(handler));
        },
        token, buffers);
  }

  template <class Buffers, class Token>
  auto async_write_some(const Buffers& buffers, Token&& token) {
    return boost::asio::async_initiate<Token, void(boost::system::error_code, std::size_t)>(
        [this](auto handler, const Buffers& from) {
          tls_ ? tls_->async_write_some(from, std::move(handler)) : plain_.async_write_some(from, std::move(handler));
        },
        token, buffers);
  }

 private:
  boost::beast::tcp_stream plain_;
  std::optional<boost::beast::ssl_stream<boost::beast::tcp_stream&>> tls_;
};

}  // namespace cellcrush::http
