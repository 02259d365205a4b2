#include "http/tls_context.h"

#include <spdlog/spdlog.h>

#include <boost/asio/buffer.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "error.h"

namespace cellcrush::http {
namespace {

namespace asio = boost::asio;
namespace ssl = asio::ssl;

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

TlsContext::TlsContext(const access::Gate& gate) : gate_(gate), files_(gate.tls()) {
  if (!files_) return;
  try {
    context_ = context_of(*files_);
  } catch (const boost::system::system_error& error) {
    throw ServiceError(ServiceError::Kind::invalid, std::string("Cannot serve HTTP with the files of --tls-cert and "
                                                                "--tls-key: ") +
                                                        error.what() + ". Make new ones, or give --http none.");
  }
}

ssl::context* TlsContext::current() {
  auto next = gate_.tls();
  if (next != files_) {
    files_ = std::move(next);
    try {
      context_ = context_of(*files_);
    } catch (const boost::system::system_error& error) {
      spdlog::error("HTTP cannot use the new certificates: {}. The previous ones stay in force for HTTP.",
                    error.what());
    }
  }
  return context_.get();
}

}  // namespace cellcrush::http
