#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <utility>

#include "case_file/case_source.h"
#include "case_file/field_names.h"
#include "command_error.h"

namespace cellcrush::client {

namespace {

using google::protobuf::DescriptorPool;

struct Explanation {
  std::string message;
  std::string word;  ///< the wrong word; the parser reports the position after it
  bool is_right_in_capitals = false;
};

// The parser's message, with a suggestion added.
Explanation explain(const std::string& message) {
  static const std::regex kUnknownField(R"re(Message type "([^"]+)" has no field named "([^"]+)")re");
  static const std::regex kUnknownEnum(R"re(Unknown enumeration value of "([^"]+)" for field "([^"]+)")re");
  std::smatch match;
  if (std::regex_search(message, match, kUnknownField)) {
    const auto* type = DescriptorPool::generated_pool()->FindMessageTypeByName(match[1].str());
    if (type != nullptr) return {unknown_field_message(match[2].str(), *type), match[2].str()};
  }
  if (std::regex_search(message, match, kUnknownEnum)) {
    const std::string value = match[1].str();
    const auto* type = find_enum_of_field(match[2].str());
    if (type == nullptr) return {fmt::format("{}: {}", match[2].str(), message), value};
    return {fmt::format("{}: {}", match[2].str(), unknown_enum_message(value, *type)), value,
            find_enum_value(value, *type) != nullptr};
  }
  if (message == "Expected identifier, got: ")
    return {"the file ends too early: a field's name or \"}\" is missing", ""};
  return {message, ""};
}

struct Place {
  int line = 0;  ///< from 0
  int column = 0;
};

// Where `word`, which ends before `place`, begins; npos if it is not found.
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

// Capitalizes values such as the `y` of `direction: y` that exist only so in the field's enum. One pass, since a frame
// may have a hundred thousand.
class EnumCorrection {
 public:
  explicit EnumCorrection(std::string text) : text_(std::move(text)) {}

  std::string corrected() {
    while (at_ < text_.size()) {
      const char character = text_[at_];
      if (character == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (character == '"' || character == '\'') {
        skip_string(character);
      } else if (is_word(character)) {
        read_word();
      } else {
        read_sign(character);
      }
    }
    return std::move(text_);
  }

 private:
  static bool is_word(char character) {
    return std::isalnum(static_cast<unsigned char>(character)) != 0 || character == '_';
  }

  void skip_string(char quote) {
    for (++at_; at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; ++at_) {
      if (text_[at_] == '\\') ++at_;
    }
    ++at_;
  }

  void read_sign(char sign) {
    if (sign == ':' && !after_colon_) {
      type_ = type_of(word_);
      after_colon_ = true;
    } else if (sign == '[' && after_colon_) {
      in_list_ = true;
    } else if (std::isspace(static_cast<unsigned char>(sign)) == 0 && !(sign == ',' && in_list_)) {
      after_colon_ = in_list_ = false;
    }
    ++at_;
  }

  void read_word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && is_word(text_[at_])) ++at_;
    word_ = text_.substr(begin, at_ - begin);
    if (after_colon_ && type_ != nullptr) {
      if (const auto* value = find_enum_value(word_, *type_)) text_.replace(begin, word_.size(), value->name());
    }
    after_colon_ = in_list_;
  }

  const google::protobuf::EnumDescriptor* type_of(const std::string& field) {
    const auto [found, is_new] = types_.try_emplace(field, nullptr);
    if (is_new) found->second = find_enum_of_field(field);
    return found->second;
  }

  std::string text_;
  std::size_t at_ = 0;
  std::string word_;
  const google::protobuf::EnumDescriptor* type_ = nullptr;  ///< enum type of the field before the colon
  bool after_colon_ = false;
  bool in_list_ = false;
  std::map<std::string, const google::protobuf::EnumDescriptor*> types_;
};

class ErrorLines : public google::protobuf::io::ErrorCollector {
 public:
  ErrorLines(const std::string& text, const std::string& file) : text_(text), file_(file) {}

  void AddError(int line, int column, const std::string& message) override {
    if (++count_ > kShown) return;
    const Explanation explanation = explain(message);
    const std::size_t found = find_word(text_, explanation.word, {line, column});
    wrong_capitals_ = wrong_capitals_ || explanation.is_right_in_capitals;
    const Place place = found == std::string::npos ? Place{line, column} : place_of(text_, found);
    if (!lines_.empty()) lines_ += '\n';
    lines_ += fmt::format("{}:{}:{}: {}", file_, place.line + 1, place.column + 1, explanation.message);
  }
  void AddWarning(int line, int column, const std::string& message) override { AddError(line, column, message); }

  /// The first errors, and how many more there are.
  [[nodiscard]] std::string lines() const {
    return count_ > kShown ? lines_ + fmt::format("\nand {} more", count_ - kShown) : lines_;
  }
  /// Whether one of them is an enum value that only needs capitals.
  [[nodiscard]] bool wrong_capitals() const { return wrong_capitals_; }

 private:
  static constexpr int kShown = 50;

  const std::string& text_;
  const std::string& file_;
  std::string lines_;
  int count_ = 0;
  bool wrong_capitals_ = false;
};

}  // namespace

v1::Case parse_text_case(const std::string& given, const std::string& file) {
  std::string text = given;
  for (bool is_corrected = false;; is_corrected = true) {
    ErrorLines errors(text, file);
    google::protobuf::TextFormat::Parser parser;
    parser.RecordErrorsTo(&errors);
    // The parser continues after an unknown field and reports a warning, so that all of them are found at once.
    parser.AllowUnknownField(true);
    v1::Case result;
    const bool parsed = parser.ParseFromString(text, &result);
    // `direction: y` means Y. The parser stops at the first of these.
    if (errors.wrong_capitals() && !is_corrected) {
      text = EnumCorrection(text).corrected();
      continue;
    }
    if (!errors.lines().empty()) refuse("the case cannot be read\n" + errors.lines());
    if (!parsed) refuse(file + ": not a case in protobuf text");
    return result;
  }
}

}  // namespace cellcrush::client
