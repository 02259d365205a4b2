#include "rpc/page.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <limits>

#include "error.h"
#include "rpc/request_limits.h"

namespace cellcrush::rpc {
namespace {

constexpr int kDefaultSize = 50;
constexpr int kLargestSize = 1000;

// FNV-1a: distinguishes lists, but keeps nothing secret.
std::string mark_of(const std::string& question) {
  std::uint32_t hash = 2166136261U;
  for (const char character : question) hash = (hash ^ static_cast<unsigned char>(character)) * 16777619U;
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08x", static_cast<unsigned>(hash));
  return text.data();
}

// The number in a token; 0 for no token.
std::int64_t read_token(const std::string& text, const std::string& question) {
  if (text.empty()) return 0;
  check_length("page_token", text, kLongestPageToken);
  std::int64_t after = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), after);
  if (error != std::errc() || after < 1 || text != page_token(after, question)) {
    throw InvalidField("page_token", "is not a token of this list.",
                       "Use the next_page_token of the previous page, with the same filter and order_by, or name.");
  }
  return after;
}

}  // namespace

Page read_page(int page_size, const std::string& page_token_text, const std::string& question) {
  if (page_size < 0) throw InvalidField("page_size", "is negative.", "Use 1 to 1000, or 0 for 50.");
  return {page_size == 0 ? kDefaultSize : std::min(page_size, kLargestSize), read_token(page_token_text, question)};
}

Page read_full_page(int page_size, const std::string& page_token_text, const std::string& question) {
  if (page_size < 0) throw InvalidField("page_size", "is negative.", "Use 0 for as many as fit.");
  return {page_size == 0 ? std::numeric_limits<int>::max() : page_size, read_token(page_token_text, question)};
}

std::string page_token(std::int64_t last, const std::string& question) {
  return std::to_string(last) + "-" + mark_of(question);
}

}  // namespace cellcrush::rpc
