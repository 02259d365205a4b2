#include "jobs/case_field.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "error.h"

namespace cellcrush::jobs {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// One part of a path: a name, and an index if it is a list.
struct Segment {
  std::string name;
  std::optional<int> position;
};

std::string names_in(const Descriptor& message) {
  std::string out;
  for (int i = 0; i < message.field_count(); ++i) out += (out.empty() ? "" : ", ") + message.field(i)->name();
  return out;
}

[[noreturn]] void refuse_part(const std::string& path, const std::string& name, const Descriptor& message) {
  throw InvalidField(path, "is not a field of a case: it has no \"" + name + "\".",
                     "Available fields: " + names_in(message) + ".");
}

[[noreturn]] void refuse_kind(const std::string& path) {
  throw InvalidField(path, "is not a single number.", "Vary only fields that hold a single number.");
}

// "nodes[3]" or "rows".
Segment parse_segment(const std::string& path, std::string_view text) {
  const auto bracket = text.find('[');
  if (bracket == std::string_view::npos) return {std::string(text), std::nullopt};
  int position = 0;
  const char* begin = text.data() + bracket + 1;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(begin, end, position);
  if (error != std::errc() || position < 0 || stopped + 1 != end || *stopped != ']')
    throw InvalidField(path, "cannot be read.", "Write list items as nodes[3], counting from 0.");
  return {std::string(text.substr(0, bracket)), position};
}

void refuse_beyond(int position, int size, const std::string& list, const std::string& path) {
  if (position < size) return;
  throw InvalidField(path, "is not in the case, which has " + std::to_string(size) + " items in " + list + ".",
                     "Count from 0.");
}

// Descends into a message.
Message& descend(Message& at, const FieldDescriptor& field, const Segment& segment, const std::string& path) {
  const auto& reflection = *at.GetReflection();
  if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE || field.is_repeated() != segment.position.has_value())
    refuse_kind(path);
  if (segment.position) {
    refuse_beyond(*segment.position, reflection.FieldSize(at, &field), segment.name, path);
    return *reflection.MutableRepeatedMessage(&at, &field, *segment.position);
  }
  if (const auto* choice = field.real_containing_oneof(); choice != nullptr && !reflection.HasField(at, &field)) {
    const auto* present = reflection.GetOneofFieldDescriptor(at, choice);
    throw InvalidField(
        path, "is not in the case, which has " + (present != nullptr ? present->name() + " instead" : "none") + ".",
        "Vary a field that the case sets.");
  }
  return *reflection.MutableMessage(&at, &field);
}

template <class Whole>
Whole whole_of(double value, const std::string& path) {
  // The limits as doubles: the upper one is the first that does not fit.
  const double low = static_cast<double>(std::numeric_limits<Whole>::min());
  const double high = std::ldexp(1.0, std::numeric_limits<Whole>::digits);
  if (!(value >= low && value < high) || std::trunc(value) != value)
    throw InvalidField(path, "is " + text_of(value) + ", which is not a whole number in range.",
                       low < 0.0 ? "Use whole numbers." : "Use whole numbers from 0.");
  return static_cast<Whole>(value);
}

// An entry of a list of numbers.
void set_entry(Message& at, const FieldDescriptor& field, int position, const std::string& path, double value) {
  const auto& reflection = *at.GetReflection();
  if (!field.is_repeated()) refuse_kind(path);
  refuse_beyond(position, reflection.FieldSize(at, &field), field.name(), path);
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: return reflection.SetRepeatedDouble(&at, &field, position, value);
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.SetRepeatedInt32(&at, &field, position, whole_of<std::int32_t>(value, path));
    default: refuse_kind(path);
  }
}

void set_number(Message& at, const FieldDescriptor& field, const std::string& path, double value) {
  const auto& reflection = *at.GetReflection();
  if (field.is_repeated()) refuse_kind(path);
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: return reflection.SetDouble(&at, &field, value);
    case FieldDescriptor::CPPTYPE_INT32: return reflection.SetInt32(&at, &field, whole_of<std::int32_t>(value, path));
    case FieldDescriptor::CPPTYPE_INT64: return reflection.SetInt64(&at, &field, whole_of<std::int64_t>(value, path));
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.SetUInt64(&at, &field, whole_of<std::uint64_t>(value, path));
    default: refuse_kind(path);
  }
}

}  // namespace

std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), written.ptr};
}

void set_case_field(v1::Case& target, const std::string& path, double value) {
  Message* at = &target;
  std::string_view rest = path;
  while (true) {
    const auto dot = rest.find('.');
    const Segment segment = parse_segment(path, rest.substr(0, dot));
    const auto* field = at->GetDescriptor()->FindFieldByName(segment.name);
    if (field == nullptr) refuse_part(path, segment.name, *at->GetDescriptor());
    if (dot == std::string_view::npos) {
      if (segment.position) return set_entry(*at, *field, *segment.position, path, value);
      return set_number(*at, *field, path, value);
    }
    at = &descend(*at, *field, segment, path);
    rest.remove_prefix(dot + 1);
  }
}

}  // namespace cellcrush::jobs
