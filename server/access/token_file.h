#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "access/scope.h"

namespace cellcrush::access {

/// The tokens that a daemon takes, from a file with a line for each: "NAME SCOPE SHA256-HEX". What follows a # is a
/// comment. A name may have several, so that one can replace another. The file has hashes only. Thread-safe once it is
/// read.
class TokenFile {
 public:
  /// Throws ServiceError (invalid) with the option, the file and the line: a file that cannot be read, that others can
  /// read or write, a line that is none, a hash that comes twice, a name with two scopes, no token at all.
  explicit TokenFile(const std::filesystem::path& path);

  [[nodiscard]] std::size_t size() const { return entries_.size(); }

  /// Whose token it is; nothing for one that is not in the file. The time it takes says nothing about how much of a
  /// hash was right.
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

/// A new token and its line for the file.
struct NewToken {
  std::string token;  ///< 64 hexadecimal digits of 256 random bits
  std::string line;
};

/// Throws ServiceError: invalid for a name that cannot be one, internal when there is no randomness.
NewToken make_token(const std::string& name, Scope scope);

}  // namespace cellcrush::access
