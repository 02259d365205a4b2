#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::access {

/// What a caller may do; each includes those before it.
enum class Scope {
  read,    ///< look at everything
  submit,  ///< make jobs and sweeps, and change one's own
  admin,   ///< change everybody's, and end the daemon
};

/// "read", "submit" or "admin".
std::string name_of(Scope scope);

/// Nothing for what is none of these names.
std::optional<Scope> parse_scope(std::string_view name);

/// Whoever calls.
struct Caller {
  std::string name;  ///< that of the token, the common name of the certificate, or kLocal
  Scope scope = Scope::read;
};

/// Name of whoever calls through the Unix socket, or where no one else can reach the daemon. No token has it.
inline constexpr const char* kLocal = "local";

/// Whether it can be a caller's name: 1 to 64 printable ASCII characters without spaces, quotes, backslashes and
/// number signs, not kLocal.
bool is_caller_name(std::string_view name);

}  // namespace cellcrush::access
