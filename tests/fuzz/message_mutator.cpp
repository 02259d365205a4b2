#include <google/protobuf/descriptor.h>

#include <cstdint>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "fuzz/wire_input.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace cellcrush::fuzz {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

std::size_t below(std::size_t end, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
}

std::string mutated_text(std::string text, std::mt19937& random) {
  constexpr std::size_t kLongest = 300;
  if (below(3, random) == 0) text.clear();  // most often replaced by a word of the dictionary
  const std::size_t size = std::min(text.size(), kLongest);
  text.resize(kLongest);
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, kLongest));
  for (char& character : text) character = static_cast<char>(character & 0x7F);
  return text;
}

double mutated_number(double value, std::mt19937& random) {
  using Limits = std::numeric_limits<double>;
  const double numbers[] = {0.0,
                            -0.0,
                            1.0,
                            -1.0,
                            0.5,
                            1e-3,
                            20.0,
                            1e3,
                            1e9,
                            1e-300,
                            1e300,
                            Limits::max(),
                            Limits::denorm_min(),
                            Limits::infinity(),
                            -Limits::infinity(),
                            Limits::quiet_NaN()};
  if (below(2, random) == 0) return numbers[below(std::size(numbers), random)];
  return value * std::uniform_real_distribution<double>(-0.5, 3.0)(random);
}

std::int64_t mutated_whole(std::int64_t value, std::mt19937& random) {
  using Limits = std::numeric_limits<std::int64_t>;
  const std::int64_t numbers[] = {
      0, 1, 2, 3, 4, 7, -1, 100, 101, 10000, 2147483647, -2147483648LL, Limits::max(), Limits::min()};
  if (below(2, random) == 0) return numbers[below(std::size(numbers), random)];
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) + below(7, random) - 3);
}

// Sets the field, or adds to it where it is repeated, `old` is what a number or text is made from.
void set_field(Message& message, const FieldDescriptor& field, std::mt19937& random) {
  const auto& to = *message.GetReflection();
  const bool adds = field.is_repeated();
  const auto put = [&](auto set, auto add, auto value) {
    adds ? (to.*add)(&message, &field, value) : (to.*set)(&message, &field, value);
  };
  using R = google::protobuf::Reflection;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return put(&R::SetInt32, &R::AddInt32,
                 static_cast<std::int32_t>(mutated_whole(adds ? 0 : to.GetInt32(message, &field), random)));
    case FieldDescriptor::CPPTYPE_INT64:
      return put(&R::SetInt64, &R::AddInt64, mutated_whole(adds ? 0 : to.GetInt64(message, &field), random));
    case FieldDescriptor::CPPTYPE_UINT32:
      return put(&R::SetUInt32, &R::AddUInt32, static_cast<std::uint32_t>(mutated_whole(1, random)));
    case FieldDescriptor::CPPTYPE_UINT64:
      return put(&R::SetUInt64, &R::AddUInt64, static_cast<std::uint64_t>(mutated_whole(1, random)));
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return put(&R::SetDouble, &R::AddDouble, mutated_number(adds ? 1.0 : to.GetDouble(message, &field), random));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return put(&R::SetFloat, &R::AddFloat, static_cast<float>(mutated_whole(1, random)));
    case FieldDescriptor::CPPTYPE_BOOL: return put(&R::SetBool, &R::AddBool, below(2, random) == 0);
    case FieldDescriptor::CPPTYPE_ENUM:
      return put(&R::SetEnumValue, &R::AddEnumValue, static_cast<int>(below(12, random)) - 1);
    case FieldDescriptor::CPPTYPE_STRING:
      return put(&R::SetString, &R::AddString,
                 mutated_text(adds ? std::string("a") : to.GetString(message, &field), random));
    case FieldDescriptor::CPPTYPE_MESSAGE: {
      Message& child = adds ? *to.AddMessage(&message, &field) : *to.MutableMessage(&message, &field);
      for (std::size_t i = below(4, random); i > 0; --i) mutate(child, random);
      return;
    }
  }
}

// An element of the field goes, comes twice, or is changed within.
void change_element(Message& message, const FieldDescriptor& field, std::mt19937& random) {
  const auto& to = *message.GetReflection();
  const int count = to.FieldSize(message, &field);
  const auto chosen = static_cast<int>(below(static_cast<std::size_t>(count), random));
  const bool is_message = field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE;
  switch (below(4, random)) {
    case 0: to.SwapElements(&message, &field, chosen, count - 1); return to.RemoveLast(&message, &field);
    case 1:
      if (!is_message) return set_field(message, field, random);
      return to.AddMessage(&message, &field)->CopyFrom(to.GetRepeatedMessage(message, &field, chosen));
    default:
      if (!is_message) return set_field(message, field, random);
      return mutate(*to.MutableRepeatedMessage(&message, &field, chosen), random);
  }
}

}  // namespace

void mutate(Message& message, std::mt19937& random) {
  const auto& descriptor = *message.GetDescriptor();
  if (descriptor.field_count() == 0) return;
  const auto& to = *message.GetReflection();
  std::vector<const FieldDescriptor*> present;
  to.ListFields(message, &present);
  // Mostly what is there, so that most of the message stays sound.
  const bool old = !present.empty() && below(4, random) != 0;
  const FieldDescriptor& field =
      old ? *present[below(present.size(), random)]
          : *descriptor.field(static_cast<int>(below(static_cast<std::size_t>(descriptor.field_count()), random)));
  if (field.is_repeated() && to.FieldSize(message, &field) > 0) return change_element(message, field, random);
  if (old && below(8, random) == 0) return to.ClearField(&message, &field);
  if (old && field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE)
    return mutate(*to.MutableMessage(&message, &field), random);
  set_field(message, field, random);
}

}  // namespace cellcrush::fuzz
