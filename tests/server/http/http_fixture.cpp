#include "server/http/http_fixture.h"

#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include <array>
#include <functional>
#include <memory>

namespace cellcrush::testing {
namespace {

std::string http_reading(const std::function<long(char*, std::size_t)>& read) {
  std::array<char, 65536> piece{};
  const long count = read(piece.data(), piece.size());
  return {piece.data(), count > 0 ? static_cast<std::size_t>(count) : 0};
}

}  // namespace

std::string exchange_with_tls(int port, const Visitor& visitor, const std::string& request, int latest) {
  const HttpSocket socket(port);
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(SSL_CTX_new(TLS_client_method()), &SSL_CTX_free);
  SSL_CTX_load_verify_locations(context.get(), visitor.authority.c_str(), nullptr);
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  if (latest != 0) {
    SSL_CTX_set_max_proto_version(context.get(), latest);
    SSL_CTX_set_security_level(context.get(), 0);
  }
  if (!visitor.shown.certificate.empty()) {
    SSL_CTX_use_certificate_file(context.get(), visitor.shown.certificate.c_str(), SSL_FILETYPE_PEM);
    SSL_CTX_use_PrivateKey_file(context.get(), visitor.shown.key.c_str(), SSL_FILETYPE_PEM);
  }
  const std::unique_ptr<SSL, decltype(&SSL_free)> tls(SSL_new(context.get()), &SSL_free);
  X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(tls.get()), "127.0.0.1");
  SSL_set_fd(tls.get(), socket.number());
  if (SSL_connect(tls.get()) != 1) return "";
  if (SSL_write(tls.get(), request.data(), static_cast<int>(request.size())) <= 0) return "";
  const auto read_some = [&tls] {
    return http_reading([&tls](char* to, std::size_t size) { return SSL_read(tls.get(), to, static_cast<int>(size)); });
  };
  std::string out;
  for (std::string next = read_some(); !next.empty(); next = read_some()) out += next;
  return out;
}

std::string envelope(const std::string& message, char flags) {
  std::string out(1, flags);
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<char>(message.size() >> shift));
  return out + message;
}

std::string dechunked(const std::string& answer) {
  std::string out;
  for (auto at = answer.find("\r\n\r\n") + 4; at < answer.size();) {
    const auto size = std::stoul(answer.substr(at, answer.find("\r\n", at) - at), nullptr, 16);
    at = answer.find("\r\n", at) + 2;
    out += answer.substr(at, size);
    at += size + 2;
  }
  return out;
}

std::vector<std::string> messages_of(const std::string& body) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at + 5 <= body.size();) {
    std::size_t size = 0;
    for (std::size_t i = 1; i < 5; ++i) size = size << 8U | static_cast<unsigned char>(body[at + i]);
    if (body[at] == 0) out.push_back(body.substr(at + 5, size));
    at += 5 + size;
  }
  return out;
}

DaemonOptions HttpFixture::http_options() const {
  DaemonOptions options = default_options();
  options.http = "127.0.0.1:0";
  return options;
}

int HttpFixture::port() const { return std::stoi(daemon_->http_url().substr(daemon_->http_url().rfind(':') + 1)); }

std::string HttpFixture::request(const std::string& line, const std::string& headers, const std::string& body) const {
  return line + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port()) + "\r\nConnection: close\r\n" + headers +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

std::string HttpFixture::exchange(const std::string& text) const {
  const HttpSocket socket(port());
  socket.send(text);
  return socket.read_to_end();
}

std::string HttpFixture::call_text(const std::string& method, const std::string& type, const std::string& body,
                                   const std::string& headers) const {
  return request("POST /cellcrush.v1.Jobs/" + method, "Content-Type: " + type + "\r\n" + headers, body);
}

std::string HttpFixture::call(const std::string& method, const std::string& type, const std::string& body,
                              const std::string& headers) const {
  return exchange(call_text(method, type, body, headers));
}

std::string HttpFixture::token_of(const std::string& name) const {
  return "Authorization: Bearer " + tokens_.at(name) + "\r\n";
}

}  // namespace cellcrush::testing
