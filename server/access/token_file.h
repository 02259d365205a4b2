#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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
  std::string name;  ///< Unix user, name of the token, or common name of the certificate
  Scope scope = Scope::read;

  bool operator==(const Caller& other) const = default;
};

/// Owner of what callers without a token made in earlier versions. No caller has this name.
inline constexpr const char* kLocal = "local";

/// Whether the text can be a caller's name: 1 to 64 printable ASCII characters without spaces, quotes, backslashes and
/// number signs, and not kLocal.
bool is_caller_name(std::string_view name);

/// Tokens that the daemon accepts, from a file with one per line: "NAME SCOPE SHA256-HEX". A # starts a comment. A name
/// may have several tokens, so that one can replace another. The file holds hashes only. Thread-safe once constructed.
class TokenFile {
 public:
  /// Throws ServiceError (invalid) with the option, the file and the line: the file is unreadable, others can read or
  /// write it, a line is malformed, a hash appears twice, a name has two scopes, or there is no token.
  explicit TokenFile(const std::filesystem::path& path);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// The owner of a token; nothing if the file does not list it. The time of the lookup does not depend on how much of
  /// a hash matches.
  [[nodiscard]] std::optional<Caller> find(std::string_view token) const;

 private:
  using Hash = std::array<unsigned char, 32>;
  struct Entry {
    Caller caller;
    Hash hash;
  };
  void add(const std::string& line, const std::string& option, const std::filesystem::path& path, int line_number);

  std::vector<Entry> entries_;
};

/// 64 hexadecimal digits of 256 random bits. Throws ServiceError (internal) if no random bytes are available.
std::string random_word();

/// The 64 hexadecimal digits of its SHA-256.
std::string hash_of_word(std::string_view word);

/// A new token and its line for the token file.
struct NewToken {
  std::string token;  ///< of random_word
  std::string line;
};

/// Throws ServiceError: invalid for an unusable name, internal if no random bytes are available.
NewToken make_token(const std::string& name, Scope scope);

}  // namespace cellcrush::access
