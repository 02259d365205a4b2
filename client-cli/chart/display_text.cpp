#include "chart/display_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <sstream>

namespace cellcrush::client {

namespace {

bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; }

// Number of bytes in the first `columns` characters.
std::size_t size_of_columns(std::string_view text, int columns) {
  std::size_t end = 0;
  for (int count = 0; end < text.size(); ++end) {
    if (!continues_character(text[end]) && count++ == columns) break;
  }
  return end;
}

constexpr std::string_view kNoBreakBlank = "\u00A0";

std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string out;
  while (true) {
    const std::size_t found = text.find(from);
    out += text.substr(0, found);
    if (found == std::string_view::npos) return out;
    out += to;
    text.remove_prefix(found + from.size());
  }
}

// Bytes of the start of a word to keep on a line: up to a dot, underscore, slash or hyphen in its second half.
std::size_t size_of_part(std::string_view word, int width) {
  const std::size_t most = size_of_columns(word, width);
  const std::size_t joint = word.substr(0, most).find_last_of("._/-");
  return joint != std::string_view::npos && joint + 1 > most / 2 ? joint + 1 : most;
}

// Bytes of the character that begins at `position`, 0 where none does: shortest forms only, no surrogates.
std::size_t character_size(std::string_view text, std::size_t position) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[position + i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || position + size > text.size()) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const bool too_long = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool outside = (first == 0xED && byte(1) >= 0xA0) || (first == 0xF4 && byte(1) >= 0x90);
  return too_long || outside ? 0 : size;
}

// Also the characters that change the direction of the text beside them.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return (first < 0x20 && first != '\n') || first == 0x7F;
  if (character.size() == 2)  // the second block of control characters
    return (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0) || character == "\u061C";
  return character == "\u200E" || character == "\u200F" || (character >= "\u202A" && character <= "\u202E") ||
         (character >= "\u2066" && character <= "\u2069");
}

}  // namespace

std::string unbreakable(std::string_view text) { return replaced(text, " ", kNoBreakBlank); }

std::string breakable(std::string_view text) { return replaced(text, kNoBreakBlank, " "); }

int display_width(std::string_view text) {
  return static_cast<int>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !continues_character(byte); }));
}

std::string cut(std::string_view text, int width) {
  if (display_width(text) <= width) return std::string(text);
  const int kept = width > 8 ? width - 3 : std::max(width, 0);
  return std::string(text.substr(0, size_of_columns(text, kept))) + (width > 8 ? "..." : "");
}

std::vector<std::string> wrap_words(std::string_view text, int width) {
  std::vector<std::string> lines(1);
  // Keeps a number with its per cent sign, and "Eq." with its number.
  std::istringstream words(replaced(replaced(text, " %", "\u00A0%"), "Eq. ", "Eq.\u00A0"));
  for (std::string word; words >> word;) {
    const int used = display_width(lines.back());
    if (used > 0 && used + 1 + display_width(word) > width) lines.emplace_back();
    if (!lines.back().empty()) lines.back() += ' ';
    while (lines.back().empty() && display_width(word) > width) {
      const std::size_t kept = size_of_part(word, width);
      lines.back() = word.substr(0, kept);
      lines.emplace_back();
      word.erase(0, kept);
    }
    lines.back() += word;
  }
  for (std::string& line : lines) line = breakable(line);
  return lines;
}

std::string wrap_text(std::string_view text, int width) {
  std::string out;
  for (;;) {
    const std::size_t end = text.find('\n');
    std::string_view separator;
    for (const std::string& line : wrap_words(text.substr(0, end), width)) {
      out.append(separator).append(line);
      separator = "\n";
    }
    if (end == std::string_view::npos) return out;
    out += '\n';
    text.remove_prefix(end + 1);
  }
}

std::string wrapped(std::string_view text, int width, std::string_view first, std::string_view next) {
  const int prefix = std::max(display_width(first), display_width(next));
  std::string result;
  for (const std::string& line : wrap_words(text, std::max(width - prefix, 1))) {
    result += std::string(result.empty() ? first : next) + line + '\n';
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t size = character_size(text, position);
    const auto character = text.substr(position, size == 0 ? 1 : size);
    if (size > 0 && !is_control(character)) {
      out += character;
    } else {
      for (const char byte : character) out += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
    }
    position += character.size();
  }
  return out;
}

std::string valid_utf8(std::string_view text) {
  std::string out;
  for (std::size_t position = 0; position < text.size();) {
    const std::size_t size = character_size(text, position);
    out += size == 0 ? "?" : text.substr(position, size);
    position += size == 0 ? 1 : size;
  }
  return out;
}

}  // namespace cellcrush::client
