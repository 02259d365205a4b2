#include "help/field_rules.h"

#include <fmt/format.h>

#include <cctype>

#include "cellcrush/v1/field.pb.h"

namespace cellcrush::client {

namespace {

// "1e-6", not "1e-06".
std::string number(double value) {
  std::string text = fmt::format("{:g}", value);
  const std::size_t exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  while (text[exponent + 1] == '+' || text[exponent + 1] == '0') text.erase(exponent + 1, 1);
  while (text[exponent + 1] == '-' && text[exponent + 2] == '0') text.erase(exponent + 2, 1);
  return text;
}

std::string range_of(const v1::FieldRules& rules, const std::string& things) {
  const std::string most = rules.has_maximum() ? number(rules.maximum()) : rules.up_to();
  const char* to = rules.below() ? "below " : "";
  if (rules.has_minimum() && !most.empty())
    return fmt::format("{} to {}{}{}", number(rules.minimum()), to, most, things);
  if (rules.has_minimum()) return "at least " + number(rules.minimum()) + things;
  return most.empty() ? "" : "at most " + most + things;
}

}  // namespace

std::string default_of(const google::protobuf::FieldDescriptor& field) {
  const v1::FieldRules& rules = field.options().GetExtension(v1::rules);
  return rules.required() ? "required" : rules.default_();
}

std::string limits_of(const google::protobuf::FieldDescriptor& field) {
  using google::protobuf::FieldDescriptor;
  const v1::FieldRules& rules = field.options().GetExtension(v1::rules);
  const bool is_list_of_numbers = field.is_repeated() && field.cpp_type() == FieldDescriptor::CPPTYPE_INT32;
  std::string things;
  if (is_list_of_numbers) things = " entries";
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING && !rules.counts().empty()) things = " " + rules.counts();
  const std::string range = range_of(rules, things);
  return range + (range.empty() || rules.limits().empty() ? "" : ", ") + rules.limits();
}

std::string first_sentence(const std::string& text) {
  for (std::size_t i = 0; i + 2 < text.size(); ++i) {
    if (text[i] == '.' && std::isspace(static_cast<unsigned char>(text[i + 1])) != 0 &&
        std::isdigit(static_cast<unsigned char>(text[i + 2])) == 0) {
      return text.substr(0, i + 1);
    }
  }
  return text;
}

}  // namespace cellcrush::client
