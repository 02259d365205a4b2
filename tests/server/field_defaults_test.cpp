#include <google/protobuf/message.h>
#include <gtest/gtest.h>

#include <charconv>
#include <optional>
#include <string>

#include "cellcrush/v1/field.pb.h"
#include "programs/text_proto.h"
#include "server/small_case.h"
#include "translate/case_to_spec.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

// The value that a default begins with, such as 4 of "4 (DISPLACEMENT_BASED: 2)"; nothing for one in words alone.
std::optional<double> default_value(const FieldDescriptor& field) {
  const std::string& text = field.options().GetExtension(v1::rules).default_();
  const std::string word = text.substr(0, text.find(' '));
  if (word == "true" || word == "false") return word == "true" ? 1.0 : 0.0;
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
    const auto* value = field.enum_type()->FindValueByName(word);
    return value == nullptr ? std::nullopt : std::optional<double>(value->number());
  }
  double number = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

double value_of(const Message& message, const FieldDescriptor& field) {
  const auto& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32: return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_UINT64: return static_cast<double>(reflection.GetUInt64(message, &field));
    case FieldDescriptor::CPPTYPE_BOOL: return reflection.GetBool(message, &field) ? 1.0 : 0.0;
    case FieldDescriptor::CPPTYPE_ENUM: return reflection.GetEnumValue(message, &field);
    default: return reflection.GetDouble(message, &field);
  }
}

// Compares the defaults of all fields that `given` leaves out and returns how many there are. `given` is empty, not
// null, where the message is left out.
int compare_defaults(const Message& given, const Message& completed, const std::string& prefix) {
  int count = 0;
  const auto& reflection = *completed.GetReflection();
  for (int i = 0; i < completed.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *completed.GetDescriptor()->field(i);
    const std::string path = prefix + std::string(field.name());
    if (field.is_repeated()) {
      if (field.cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) continue;
      for (int k = 0; k < reflection.FieldSize(completed, &field); ++k) {
        count += compare_defaults(reflection.GetRepeatedMessage(given, &field, k),
                                  reflection.GetRepeatedMessage(completed, &field, k), path + '.');
      }
    } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
      if (!reflection.HasField(completed, &field)) continue;
      count +=
          compare_defaults(reflection.GetMessage(given, &field), reflection.GetMessage(completed, &field), path + '.');
    } else if (const auto expected = default_value(field); expected && !reflection.HasField(given, &field)) {
      if (!reflection.HasField(completed, &field)) continue;
      EXPECT_EQ(value_of(completed, field), *expected) << path;
      ++count;
    }
  }
  return count;
}

// What the spec of the solver fills in, before it chooses a step.
int compare_completed(const v1::Case& given) {
  const auto reading = translate::to_spec(given);
  EXPECT_TRUE(reading.problems.empty());
  return compare_defaults(given, translate::to_case(reading.spec), "");
}

TEST(FieldDefaults, AreThoseOfTheSolver) {
  v1::Case crush = testing::small_case();
  crush.clear_contact();
  crush.clear_plates();
  crush.clear_section();
  crush.clear_numerics();
  crush.clear_output();
  crush.mutable_loading()->clear_end_strain();
  EXPECT_GE(compare_completed(crush), 18);
  crush.clear_loading();
  const v1::Case frame = testing::with_text(crush, R"(lattice { frame {
    nodes { id: "a" x_mm: 0 y_mm: 0 } nodes { id: "b" x_mm: 100 y_mm: 0 }
    beams { start: "a" end: "b" thickness_mm: 1 }
    supports { node: "a" fix_x: true fix_y: true }
    initial_velocities { node: "b" y_m_per_s: 1 }
    end_time_s: 0.001 } })");
  EXPECT_GE(compare_completed(frame), 18);
}

}  // namespace
}  // namespace cellcrush
