#include "connection/connection_failure.h"

#include <filesystem>

namespace cellcrush::client {

namespace {

bool has_part(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

std::string host_of(const std::string& address) { return address.substr(0, address.rfind(':')); }

bool is_socket(const std::string& address) { return address.starts_with("unix:"); }

// There was no connection that could have ended.
bool was_not_reached(const std::string& reason) {
  for (const char* part : {"Connection refused", "No route to host", "unreachable", "timed out", "Timeout", "DNS"}) {
    if (has_part(reason, part)) return true;
  }
  return reason.empty() || has_part(reason, "Deadline");
}

std::string tls_failure_text(const std::string& address, const std::string& reason) {
  if (has_part(reason, "certificate verify failed") || has_part(reason, "CERTIFICATE_VERIFY_FAILED")) {
    return "the certificate of the server at " + address +
           " has expired or is not signed by the authority of --tls-ca; name the authority that signed it, or renew "
           "the certificate";
  }
  if (has_part(reason, "Peer name") || has_part(reason, "Hostname")) {
    return "the certificate of the server at " + address + " is not valid for " + host_of(address) +
           "; give --server a host name that the certificate lists";
  }
  if (has_part(reason, "wrong version number") || has_part(reason, "WRONG_VERSION_NUMBER")) {
    return "the server at " + address + " does not use TLS; leave out --tls-ca and CELLCRUSH_TLS_CA";
  }
  return "the server at " + address +
         " closed the connection; if it requires a client certificate, give one signed by its authority with "
         "--tls-cert and --tls-key";
}

}  // namespace

bool may_still_answer(const std::string& address, const std::string& reason) {
  return is_socket(address) || was_not_reached(reason);
}

std::string connection_failure_text(const std::string& address, const Credentials& credentials,
                                    const std::string& reason) {
  std::error_code error;
  if (!may_still_answer(address, reason)) {
    if (credentials.tls) return tls_failure_text(address, reason);
    return "the server at " + address +
           " does not answer in plain text; if it uses TLS, name the authority of its certificate with --tls-ca";
  }
  std::string message = "no server answers at " + address;
  if (is_socket(address) && !std::filesystem::exists(address.substr(5), error)) message += " (no such socket)";
  return message + "; start cellcrushd, or name its address with --server";
}

}  // namespace cellcrush::client
