#include "case_file/text_case.h"

#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <regex>

#include "case_file/suggestion.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

using google::protobuf::DescriptorPool;

struct Explanation {
  std::string message;
  std::string word;  ///< that is wrong; the parser reports the place behind it
};

// The parser's message, with what may have been meant added.
Explanation explain(const std::string& message) {
  static const std::regex kUnknownField(R"re(Message type "([^"]+)" has no field named "([^"]+)")re");
  static const std::regex kUnknownEnum(R"re(Unknown enumeration value of "([^"]+)" for field "([^"]+)")re");
  std::smatch match;
  if (std::regex_search(message, match, kUnknownField)) {
    const auto* type = DescriptorPool::generated_pool()->FindMessageTypeByName(match[1].str());
    if (type != nullptr) return {unknown_field_message(match[2].str(), *type), match[2].str()};
  }
  if (std::regex_search(message, match, kUnknownEnum)) {
    return {fmt::format("{}: {}", match[2].str(), message), match[1].str()};
  }
  if (message == "Expected identifier, got: ")
    return {"the file ends too early: a field's name or \"}\" is missing", ""};
  return {message, ""};
}

struct Place {
  int line = 0;  ///< from 0
  int column = 0;
};

// Where `word` begins that ends before `place`; `place` itself when it is not found.
Place find_word(const std::string& text, const std::string& word, const Place& place) {
  std::size_t begin = 0;
  for (int line = 0; line < place.line; ++line) begin = text.find('\n', begin) + 1;
  const std::size_t found =
      word.empty() ? std::string::npos : text.rfind(word, begin + static_cast<std::size_t>(place.column));
  if (found == std::string::npos) return place;
  const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(found), '\n');
  const std::size_t line_begin = found == 0 ? 0 : text.rfind('\n', found - 1) + 1;
  return {static_cast<int>(lines), static_cast<int>(found - line_begin)};
}

class ErrorLines : public google::protobuf::io::ErrorCollector {
 public:
  ErrorLines(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void AddError(int line, int column, const std::string& message) override {
    const Explanation explanation = explain(message);
    const Place place = find_word(text_, explanation.word, {line, column});
    if (!lines_.empty()) lines_ += '\n';
    lines_ += fmt::format("{}:{}:{}: {}", file_, place.line + 1, place.column + 1, explanation.message);
  }
  void AddWarning(int line, int column, const std::string& message) override { AddError(line, column, message); }

  [[nodiscard]] const std::string& lines() const { return lines_; }

 private:
  const std::string& text_;
  const std::string& file_;
  std::string lines_;
};

}  // namespace

v1::Case parse_text_case(const std::string& text, const std::string& file) {
  ErrorLines errors(text, file);
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&errors);
  // The parser then goes on behind an unknown field, and reports it as a warning: all of them are found at once.
  parser.AllowUnknownField(true);
  v1::Case result;
  const bool parsed = parser.ParseFromString(text, &result);
  if (!errors.lines().empty()) throw CommandError(ExitCode::refused, "the case cannot be read\n" + errors.lines());
  if (!parsed) throw CommandError(ExitCode::refused, file + ": this is not a case in protobuf text");
  return result;
}

}  // namespace cellcrush::client
