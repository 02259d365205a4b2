#include "case_file/text_case.h"

#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <regex>

#include "case_file/enum_value.h"
#include "case_file/suggestion.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

using google::protobuf::DescriptorPool;

struct Explanation {
  std::string message;
  std::string word;         ///< that is wrong; the parser reports the place behind it
  std::string replacement;  ///< what is meant without doubt in its place, as long as it; may be empty
};

// The parser's message, with what may have been meant added.
Explanation explain(const std::string& message) {
  static const std::regex kUnknownField(R"re(Message type "([^"]+)" has no field named "([^"]+)")re");
  static const std::regex kUnknownEnum(R"re(Unknown enumeration value of "([^"]+)" for field "([^"]+)")re");
  std::smatch match;
  if (std::regex_search(message, match, kUnknownField)) {
    const auto* type = DescriptorPool::generated_pool()->FindMessageTypeByName(match[1].str());
    if (type != nullptr) return {unknown_field_message(match[2].str(), *type), match[2].str(), ""};
  }
  if (std::regex_search(message, match, kUnknownEnum)) {
    const std::string value = match[1].str();
    const auto* type = find_enum_of_field(match[2].str());
    if (type == nullptr) return {fmt::format("{}: {}", match[2].str(), message), value, ""};
    const auto* meant = find_enum_value(value, *type);
    return {fmt::format("{}: {}", match[2].str(), unknown_enum_message(value, *type)), value,
            meant == nullptr ? "" : meant->name()};
  }
  if (message == "Expected identifier, got: ")
    return {"the file ends too early: a field's name or \"}\" is missing", "", ""};
  return {message, "", ""};
}

struct Place {
  int line = 0;  ///< from 0
  int column = 0;
};

// Where `word` begins that ends before `place`; npos when it is not found.
std::size_t find_word(const std::string& text, const std::string& word, const Place& place) {
  std::size_t begin = 0;
  for (int line = 0; line < place.line; ++line) begin = text.find('\n', begin) + 1;
  return word.empty() ? std::string::npos : text.rfind(word, begin + static_cast<std::size_t>(place.column));
}

Place place_of(const std::string& text, std::size_t found) {
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(found), '\n');
  const std::size_t line_begin = found == 0 ? 0 : text.rfind('\n', found - 1) + 1;
  return {static_cast<int>(lines), static_cast<int>(found - line_begin)};
}

class ErrorLines : public google::protobuf::io::ErrorCollector {
 public:
  ErrorLines(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void AddError(int line, int column, const std::string& message) override {
    const Explanation explanation = explain(message);
    const std::size_t found = find_word(text_, explanation.word, {line, column});
    if (!explanation.replacement.empty() && found != std::string::npos) {
      corrected_ = text_;
      corrected_.replace(found, explanation.word.size(), explanation.replacement);
    }
    const Place place = found == std::string::npos ? Place{line, column} : place_of(text_, found);
    if (!lines_.empty()) lines_ += '\n';
    lines_ += fmt::format("{}:{}:{}: {}", file_, place.line + 1, place.column + 1, explanation.message);
  }
  void AddWarning(int line, int column, const std::string& message) override { AddError(line, column, message); }

  [[nodiscard]] const std::string& lines() const { return lines_; }
  /// The text with one value more in capitals, where that is what an error asks for; else empty.
  [[nodiscard]] const std::string& corrected() const { return corrected_; }

 private:
  const std::string& text_;
  const std::string& file_;
  std::string lines_;
  std::string corrected_;
};

}  // namespace

v1::Case parse_text_case(const std::string& given, const std::string& file) {
  for (std::string text = given;;) {
    ErrorLines errors(text, file);
    google::protobuf::TextFormat::Parser parser;
    parser.RecordErrorsTo(&errors);
    // The parser then goes on behind an unknown field, and reports it as a warning: all of them are found at once.
    parser.AllowUnknownField(true);
    v1::Case result;
    const bool parsed = parser.ParseFromString(text, &result);
    // `direction: y` is meant as Y. The parser stops there, so each turn corrects one value.
    if (!errors.corrected().empty() && errors.corrected() != text) {
      text = errors.corrected();
      continue;
    }
    if (!errors.lines().empty()) throw CommandError(ExitCode::refused, "the case cannot be read\n" + errors.lines());
    if (!parsed) throw CommandError(ExitCode::refused, file + ": this is not a case in protobuf text");
    return result;
  }
}

}  // namespace cellcrush::client
