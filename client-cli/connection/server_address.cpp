#include "connection/server_address.h"

#include <charconv>
#include <cstdlib>
#include <filesystem>

#include "command_error.h"

namespace cellcrush::client {

namespace {

constexpr const char* kDefaultAddress = "127.0.0.1:50551";

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string() : std::string(value);
}

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
  throw CommandError(ExitCode::refused, source + " = \"" + address + "\": expected unix:PATH or HOST:PORT");
}

}  // namespace

std::string find_server_address(const std::string& option) {
  if (!option.empty()) return checked(option, "--server");
  const std::string variable = environment("CELLCRUSH_SERVER");
  if (!variable.empty()) return checked(variable, "CELLCRUSH_SERVER");
  const std::string socket = default_socket();
  std::error_code error;
  if (!socket.empty() && std::filesystem::is_socket(socket, error)) return "unix:" + socket;
  return kDefaultAddress;
}

}  // namespace cellcrush::client
