#include "connection/credentials.h"

#include <arpa/inet.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "case_file/case_source.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

// The option, else the variable, with its name for messages.
struct NamedText {
  std::string source;
  std::string text;
};

NamedText option_or_variable(const std::string& option_name, const std::string& option, const char* variable) {
  if (!option.empty()) return {option_name, option};
  return {variable, environment(variable)};
}

std::string read_credential_file(const NamedText& path) {
  constexpr std::size_t kLargest = 1024 * 1024;
  std::ifstream stream;
  if (const std::string failure = open_failure(path.text, stream); !failure.empty())
    refuse(path.source + " " + failure);
  std::string text;
  for (std::istreambuf_iterator<char> next(stream), end; next != end && text.size() <= kLargest; ++next) text += *next;
  if (text.empty()) refuse(path.source + " " + path.text + ": is empty");
  if (text.size() > kLargest) refuse(path.source + " " + path.text + ": is too large");
  return text;
}

std::string read_pem(const NamedText& path, const std::string& kind) {
  std::string text = read_credential_file(path);
  if (text.find("-----BEGIN ") == std::string::npos || text.find(kind + "-----") == std::string::npos) {
    refuse(path.source + " " + path.text + ": holds no " + kind + " in PEM (-----BEGIN " + kind + "-----)");
  }
  return text;
}

// The line with a token may have a line end; the token goes into a header, which allows printable characters only.
std::string checked_token(std::string text, const std::string& source) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  const bool printable =
      std::all_of(text.begin(), text.end(), [](char character) { return character > ' ' && character <= '~'; });
  if (text.empty() || text.size() > 1024 || !printable) refuse(source + ": holds no token; a token is a single word");
  return text;
}

std::string find_token(const std::string& file_option) {
  const NamedText file = option_or_variable("--token-file", file_option, "CELLCRUSH_TOKEN_FILE");
  if (!file.text.empty()) return checked_token(read_credential_file(file), file.source + " " + file.text);
  const std::string token = environment("CELLCRUSH_TOKEN");
  return token.empty() ? "" : checked_token(token, "CELLCRUSH_TOKEN");
}

bool is_this_machine(const std::string& address) {
  const std::string host = address.substr(0, address.rfind(':'));
  in_addr ipv4{};
  return host == "localhost" || host == "[::1]" ||
         (inet_pton(AF_INET, host.c_str(), &ipv4) == 1 && (ntohl(ipv4.s_addr) >> 24U) == 127U);
}

constexpr const char* kDefaultAddress = "127.0.0.1:50551";

std::string default_socket() {
  std::filesystem::path data = environment("XDG_DATA_HOME");
  if (data.empty()) {
    const std::string home = environment("HOME");
    if (home.empty()) return {};
    data = std::filesystem::path(home) / ".local" / "share";
  }
  return (data / "cellcrush" / "cellcrushd.sock").string();
}

bool is_host_and_port(const std::string& address) {
  const std::size_t colon = address.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  unsigned port = 0;
  const char* end = address.data() + address.size();
  const auto [stop, error] = std::from_chars(address.data() + colon + 1, end, port);
  return error == std::errc() && stop == end && port >= 1 && port <= 65535;
}

std::string checked(const std::string& address, const std::string& source) {
  const bool is_socket = address.starts_with("unix:") && address.size() > 5;
  if (is_socket || (!address.starts_with("unix:") && is_host_and_port(address))) return address;
  refuse(source + " = \"" + address + "\": expected unix:PATH or HOST:PORT");
}

}  // namespace

Credentials read_credentials(const CredentialFiles& files, const std::string& address) {
  Credentials out;
  if (address.starts_with("unix:")) return out;
  if (files.certificate.empty() != files.key.empty())
    refuse("--tls-cert and --tls-key go together; give both or neither");
  const NamedText authority = option_or_variable("--tls-ca", files.authority, "CELLCRUSH_TLS_CA");
  if (authority.text.empty() && !files.certificate.empty())
    refuse("--tls-cert requires --tls-ca, the authority of the server's certificate");
  out.token = find_token(files.token);
  if (!authority.text.empty()) {
    out.tls = true;
    out.authority = read_pem(authority, "CERTIFICATE");
    if (!files.certificate.empty()) {
      out.certificate = read_pem({"--tls-cert", files.certificate}, "CERTIFICATE");
      out.key = read_pem({"--tls-key", files.key}, "PRIVATE KEY");
    }
  }
  if (!out.token.empty() && !out.tls && !is_this_machine(address)) {
    refuse("the token is not sent to " + address +
           " in plain text, where others could read it; turn on TLS with --tls-ca or "
           "CELLCRUSH_TLS_CA");
  }
  return out;
}

ServerAddress find_server_address(const std::string& option) {
  if (!option.empty()) return {checked(option, "--server")};
  const std::string variable = environment("CELLCRUSH_SERVER");
  if (!variable.empty()) return {checked(variable, "CELLCRUSH_SERVER")};
  const std::string socket = default_socket();
  std::error_code error;
  if (!socket.empty() && std::filesystem::is_socket(socket, error)) return {"unix:" + socket};
  return {kDefaultAddress, true};
}

std::string own_user() {
  const passwd* found = getpwuid(geteuid());
  return found == nullptr ? "uid" + std::to_string(geteuid()) : found->pw_name;
}

}  // namespace cellcrush::client
