#include "access/token_file.h"

#include <absl/strings/ascii.h>
#include <absl/strings/escaping.h>
#include <openssl/crypto.h>
#include <openssl/rand.h>
#include <openssl/sha.h>

#include <algorithm>
#include <sstream>

#include "access/secret_file.h"
#include "error.h"

namespace cellcrush::access {
namespace {

constexpr const char* kTokensOption = "--tokens";
constexpr std::size_t kLongestToken = 1024;
constexpr const char* kNameRule =
    "A name has 1 to 64 printable characters without spaces, quotes, backslashes or #, and is not \"local\".";

template <class Bytes>
std::string hex_of(const Bytes& bytes) {
  return absl::BytesToHexString({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

// False when the text is not twice as many digits as there are bytes.
template <class Bytes>
bool read_hex(const std::string& text, Bytes& bytes) {
  if (text.size() != 2 * bytes.size() || !std::all_of(text.begin(), text.end(), absl::ascii_isxdigit)) return false;
  std::ranges::copy(absl::HexStringToBytes(text), bytes.begin());
  return true;
}

std::array<unsigned char, 32> sha256_of(std::string_view text) {
  std::array<unsigned char, 32> out{};
  SHA256(reinterpret_cast<const unsigned char*>(text.data()), text.size(), out.data());
  return out;
}

}  // namespace

std::string name_of(Scope scope) {
  switch (scope) {
    case Scope::read: return "read";
    case Scope::submit: return "submit";
    case Scope::admin: break;
  }
  return "admin";
}

std::optional<Scope> parse_scope(std::string_view name) {
  for (const Scope scope : {Scope::read, Scope::submit, Scope::admin}) {
    if (name == name_of(scope)) return scope;
  }
  return std::nullopt;
}

bool is_caller_name(std::string_view name) {
  constexpr std::size_t kLongest = 64;
  const auto belongs = [](char character) {
    return character > ' ' && character <= '~' && character != '"' && character != '\\' && character != '#';
  };
  return !name.empty() && name.size() <= kLongest && name != kLocal && std::all_of(name.begin(), name.end(), belongs);
}

TokenFile::TokenFile(const std::filesystem::path& path) {
  std::istringstream lines(read_named_file(kTokensOption, path, Secrecy::secret));
  int line_number = 0;
  for (std::string line; std::getline(lines, line);) add(line, kTokensOption, path, ++line_number);
  if (entries_.empty())
    refuse_file(kTokensOption, path, "contains no token. Create one with `cellcrushd token NAME --scope SCOPE`.");
}

void TokenFile::add(const std::string& line, const std::string& option, const std::filesystem::path& path,
                    int line_number) {
  std::istringstream words(line.substr(0, line.find('#')));
  std::string name;
  std::string scope_name;
  std::string digits;
  std::string rest;
  if (!(words >> name)) return;
  // Does not repeat the line: it may contain a token instead of its hash.
  const std::string where = "line " + std::to_string(line_number) + " ";
  if (!(words >> scope_name >> digits) || words >> rest)
    refuse_file(option, path, where + "is not of the form NAME SCOPE SHA256-HEX.");
  if (!is_caller_name(name)) refuse_file(option, path, where + "has an invalid name. " + kNameRule);
  const auto scope = parse_scope(scope_name);
  if (!scope) refuse_file(option, path, where + "has an unknown scope. Use read, submit or admin.");
  Entry entry{{name, *scope}, {}};
  if (!read_hex(digits, entry.hash)) refuse_file(option, path, where + "has a hash that is not 64 hexadecimal digits.");
  for (const Entry& before : entries_) {
    if (before.hash == entry.hash) refuse_file(option, path, where + "repeats the hash of an earlier line.");
    if (before.caller.name == name && before.caller.scope != *scope)
      refuse_file(option, path,
                  std::string(where).append("gives ").append(name).append(" a different scope from an earlier line."));
  }
  entries_.push_back(std::move(entry));
}

std::optional<Caller> TokenFile::find(std::string_view token) const {
  if (token.size() > kLongestToken) return std::nullopt;
  const Hash hash = sha256_of(token);
  const Entry* found = nullptr;
  // Compares all entries, so that the time does not depend on the match.
  for (const Entry& entry : entries_) {
    if (CRYPTO_memcmp(entry.hash.data(), hash.data(), hash.size()) == 0) found = &entry;
  }
  return found == nullptr ? std::nullopt : std::optional(found->caller);
}

std::string random_word() {
  std::array<unsigned char, 32> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    throw ServiceError(ServiceError::Kind::internal, "The system's random number generator failed.");
  return hex_of(random);
}

std::string hash_of_word(std::string_view word) { return hex_of(sha256_of(word)); }

NewToken make_token(const std::string& name, Scope scope) {
  if (!is_caller_name(name))
    throw ServiceError(ServiceError::Kind::invalid, "\"" + name + "\" is not a valid token name. " + kNameRule);
  NewToken out;
  out.token = random_word();
  out.line = name + " " + name_of(scope) + " " + hash_of_word(out.token);
  return out;
}

}  // namespace cellcrush::access
