#include "help/field_comment.h"

#include <array>
#include <cctype>
#include <sstream>
#include <utility>

namespace cellcrush::client {

namespace {

// Longer suffixes first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 13> kUnits = {{
    {"_mm_or_rad", "mm or rad"},
    {"_kg_per_m3", "kg/m3"},
    {"_n_or_n_mm", "N or N mm"},
    {"_rad_per_s", "rad/s"},
    {"_n_per_mm", "N/mm"},
    {"_m_per_s2", "m/s2"},
    {"_m_per_s", "m/s"},
    {"_per_s", "1/s"},
    {"_g_mm2", "g mm2"},
    {"_mpa", "MPa"},
    {"_mm", "mm"},
    {"_s", "s"},
    {"_g", "g"},
}};

// Where `separator` first stands outside parentheses; npos when nowhere.
std::size_t find_outside_parentheses(std::string_view text, char separator) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (text[i] == separator && depth == 0) return i;
  }
  return std::string_view::npos;
}

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" ,:");
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(" .") - begin + 1));
}

}  // namespace

std::vector<std::string> split_sentences(std::string_view text) {
  std::vector<std::string> sentences;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool last = i + 1 == text.size();
    const bool stop = text[i] == '.' && i + 2 < text.size() && (text[i + 1] == ' ' || text[i + 1] == '\n') &&
                      std::isdigit(static_cast<unsigned char>(text[i + 2])) == 0;
    if (!last && !stop) continue;
    sentences.emplace_back(text.substr(begin, i + 1 - begin));
    begin = text.find_first_not_of(" \n", i + 1);
    if (begin == std::string_view::npos) break;
  }
  return sentences;
}

std::string join_comment(const std::string& lines) {
  std::istringstream stream(lines);
  std::string text;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin == std::string::npos) {
      text += "\n\n";
      continue;
    }
    if (!text.empty() && text.back() != '\n') text += ' ';
    text += line.substr(begin);
  }
  return text;
}

FieldComment parse_field_comment(std::string_view comment) {
  FieldComment out;
  for (const std::string& sentence : split_sentences(comment)) {
    const std::string_view text = sentence;
    if (text.starts_with("Required")) {
      out.default_value = "required";
      out.limits = trimmed(text.substr(std::string_view("Required").size()));
    } else if (text.starts_with("Default")) {
      const std::string_view rest = text.substr(std::string_view("Default").size());
      const std::size_t end = find_outside_parentheses(rest, ';');
      out.default_value = trimmed(rest.substr(0, end));
      if (end != std::string_view::npos) out.limits = trimmed(rest.substr(end + 1));
    } else if (out.summary.empty()) {
      out.summary = sentence;
    }
  }
  return out;
}

std::string unit_of(std::string_view field_name) {
  const std::string name = "_" + std::string(field_name);
  for (const auto& [suffix, unit] : kUnits) {
    if (name.ends_with(suffix)) return std::string(unit);
  }
  return {};
}

}  // namespace cellcrush::client
