#include "rpc/job_query.h"

#include <cctype>
#include <sstream>
#include <string_view>
#include <vector>

#include "error.h"

namespace cellcrush::rpc {
namespace {

constexpr const char* kUnderstood =
    "Valid terms are state = STATE, owner = \"NAME\", label.KEY = \"value\" and title : \"text\", joined by AND.";

// Parses the text in one pass, one condition at a time.
class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  store::JobFilter read() {
    store::JobFilter out;
    skip_space();
    if (at_end()) return out;
    while (true) {
      read_condition(out);
      skip_space();
      if (at_end()) return out;
      const std::size_t start = position_;
      if (word() != "AND") refuse(start, "expected AND or the end");
    }
  }

 private:
  void read_condition(store::JobFilter& out) {
    skip_space();
    const std::size_t start = position_;
    const std::string field = word();
    if (field == "state") {
      expect('=');
      out.states.push_back(state());
    } else if (field == "owner") {
      expect('=');
      out.owners.push_back(value());
    } else if (field == "title") {
      expect(':');
      out.titles.push_back(value());
    } else if (field.starts_with("label.")) {
      const std::string key = field == "label." ? value() : field.substr(6);
      expect('=');
      out.labels.emplace_back(key, value());
    } else {
      refuse(start, "expected state, owner, label.KEY or title");
    }
  }

  v1::Job::State state() {
    skip_space();
    const std::size_t start = position_;
    const std::string name = value();
    v1::Job::State out = v1::Job::JOB_STATE_UNSPECIFIED;
    if (!v1::Job::State_Parse(name, &out) || out == v1::Job::JOB_STATE_UNSPECIFIED)
      refuse(start, "expected one of " + state_names());
    return out;
  }

  static std::string state_names() {
    std::string out;
    for (int state = v1::Job::PENDING; state <= v1::Job::State_MAX; ++state)
      out += (out.empty() ? "" : ", ") + v1::Job::State_Name(static_cast<v1::Job::State>(state));
    return out;
  }

  // A quoted text, in which a backslash makes the next character ordinary, or a word.
  std::string value() {
    skip_space();
    const std::size_t start = position_;
    if (at_end() || text_[position_] != '"') {
      std::string out = word();
      if (out.empty()) refuse(start, "expected a value");
      return out;
    }
    ++position_;
    std::string out;
    while (!at_end() && text_[position_] != '"') {
      if (text_[position_] == '\\' && position_ + 1 < text_.size()) ++position_;
      out.push_back(text_[position_++]);
    }
    if (at_end()) refuse(start, "the quoted text that starts here has no closing quote");
    ++position_;
    return out;
  }

  std::string word() {
    skip_space();
    const auto belongs = [](unsigned char character) {
      return std::isalnum(character) != 0 || std::string_view("._-/").find(static_cast<char>(character)) < 4;
    };
    const std::size_t start = position_;
    while (!at_end() && belongs(static_cast<unsigned char>(text_[position_]))) ++position_;
    return text_.substr(start, position_ - start);
  }

  void expect(char wanted) {
    skip_space();
    if (at_end() || text_[position_] != wanted) refuse(position_, std::string("expected ") + wanted);
    ++position_;
  }

  void skip_space() {
    while (!at_end() && std::isspace(static_cast<unsigned char>(text_[position_])) != 0) ++position_;
  }

  [[nodiscard]] bool at_end() const { return position_ == text_.size(); }

  [[noreturn]] static void refuse(std::size_t position, const std::string& message) {
    throw InvalidField("filter", "cannot be read at position " + std::to_string(position + 1) + ": " + message + ".",
                       kUnderstood);
  }

  const std::string& text_;
  std::size_t position_ = 0;
};

}  // namespace

store::JobFilter parse_filter(const std::string& text) { return Reader(text).read(); }

bool parse_newest_first(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  if (words.empty()) return true;
  const bool known_field = words[0] == "create_time" || words[0] == "name";
  const bool known_direction = words.size() == 1 || (words.size() == 2 && (words[1] == "desc" || words[1] == "asc"));
  if (!known_field || !known_direction) {
    throw InvalidField("order_by", "is \"" + text + "\", which is not a valid order.",
                       "Use create_time, create_time desc, name or name desc.");
  }
  return words.size() == 2 && words[1] == "desc";
}

}  // namespace cellcrush::rpc
