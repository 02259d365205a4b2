#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::access {

/// What a caller may do. Each scope includes those before it.
enum class Scope {
  read,    ///< read everything
  submit,  ///< create jobs and sweeps, and change one's own
  admin,   ///< change everyone's jobs and sweeps, and drain the daemon
};

/// "read", "submit" or "admin".
std::string name_of(Scope scope);

/// Nothing if the text names no scope.
std::optional<Scope> parse_scope(std::string_view name);

/// The author of a call.
struct Caller {
  std::string name;  ///< name of the token, common name of the certificate, or kLocal
  Scope scope = Scope::read;
};

/// Name of a caller on the Unix socket, or on a daemon that only this machine can reach. No token has this name.
inline constexpr const char* kLocal = "local";

/// Whether the text can be a caller's name: 1 to 64 printable ASCII characters without spaces, quotes, backslashes and
/// number signs, and not kLocal.
bool is_caller_name(std::string_view name);

}  // namespace cellcrush::access
