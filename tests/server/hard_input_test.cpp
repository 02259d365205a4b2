#include <google/protobuf/util/message_differencer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scenes/presets.h"
#include "scenes/textbook.h"
#include "translate/check_case.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Where a single field of a message is, its path as problems write it, and how to get to it in a copy.
struct Leaf {
  std::string path;
  std::function<Message*(Message&)> parent;
  const FieldDescriptor* field;
  int index;  ///< in a repeated field, or -1
};

void collect_leaves(const Message& message, const std::string& path, const std::function<Message*(Message&)>& parent,
                    std::vector<Leaf>& leaves) {
  const auto* reflection = message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const int count = field->is_repeated() ? reflection->FieldSize(message, field) : 1;
    for (int i = 0; i < std::min(count, 2); ++i) {
      const int index = field->is_repeated() ? i : -1;
      const std::string name = path + field->name() + (index >= 0 ? "[" + std::to_string(i) + "]" : "");
      if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
        leaves.push_back({name, parent, field, index});
        continue;
      }
      const Message& child =
          index >= 0 ? reflection->GetRepeatedMessage(message, field, i) : reflection->GetMessage(message, field);
      collect_leaves(
          child, name + ".",
          [parent, field, index](Message& root) {
            Message* holder = parent(root);
            return index >= 0 ? holder->GetReflection()->MutableRepeatedMessage(holder, field, index)
                              : holder->GetReflection()->MutableMessage(holder, field);
          },
          leaves);
    }
  }
}

void set_number(Message& message, const Leaf& leaf, double value) {
  const auto* reflection = message.GetReflection();
  const auto put = [&](auto set, auto set_repeated, auto typed) {
    leaf.index >= 0 ? (reflection->*set_repeated)(&message, leaf.field, leaf.index, typed)
                    : (reflection->*set)(&message, leaf.field, typed);
  };
  using R = google::protobuf::Reflection;
  switch (leaf.field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE: put(&R::SetDouble, &R::SetRepeatedDouble, value); break;
    case FieldDescriptor::CPPTYPE_INT32:
      put(&R::SetInt32, &R::SetRepeatedInt32, static_cast<int>(std::clamp(value, -2147483648.0, 2147483647.0)));
      break;
    default: break;
  }
}

/// Cases that are right, whose fields the tests spoil one by one.
std::vector<v1::Case> sound_cases() {
  std::vector<v1::Case> cases;
  for (const char* name : {"hexagon-small", "papka-kyriakides-1", "type-ii-as-counted", "type-iii-as-counted"})
    cases.push_back(translate::to_case(scenes::preset(name)));
  SceneSpec stiff = scenes::preset("hexagon-small");
  stiff.inclusions.rows = {2, 4};
  cases.push_back(translate::to_case(stiff));
  cases.push_back(translate::to_case(scenes::bent_cantilever(1.5)));
  cases.push_back(translate::to_case(scenes::lee_frame(60.0)));
  return cases;
}

bool names(const v1::CheckCaseResponse& response, const std::string& path) {
  const std::string field = path.substr(0, path.find(".points"));
  for (const auto& problem : response.problems()) {
    if (problem.field().rfind(field, 0) == 0) return true;
  }
  return false;
}

// Every number of every kind of case is spoiled in every way: nothing crashes, nothing hangs, what is refused says what
// is wrong and what to do, and what is not a number is refused by the name of its field.
TEST(HardInput, SpoiledNumbersAreRefusedByTheirFields) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  int tried = 0;
  int refused = 0;
  for (const v1::Case& sound : sound_cases()) {
    ASSERT_EQ(translate::check_case(sound).response.problems_size(), 0);
    std::vector<Leaf> leaves;
    collect_leaves(
        sound, "", [](Message& root) { return &root; }, leaves);
    for (const Leaf& leaf : leaves) {
      const auto type = leaf.field->cpp_type();
      if (type != FieldDescriptor::CPPTYPE_DOUBLE && type != FieldDescriptor::CPPTYPE_INT32) continue;
      for (const double value : {kNan, kInfinity, -kInfinity, -1.0, 0.0, 1e-300, 1e300, -1e300}) {
        if (type == FieldDescriptor::CPPTYPE_INT32 && !std::isfinite(value)) continue;
        v1::Case spoiled = sound;
        set_number(*leaf.parent(spoiled), leaf, value);
        const auto response = translate::check_case(spoiled).response;
        ++tried;
        refused += response.problems_size() > 0 ? 1 : 0;
        if (!std::isfinite(value)) {
          EXPECT_TRUE(names(response, leaf.path)) << leaf.path << " = " << value;
        }
        for (const auto& problem : response.problems()) {
          EXPECT_FALSE(problem.field().empty()) << leaf.path << " = " << value;
          EXPECT_FALSE(problem.message().empty()) << problem.field();
          EXPECT_FALSE(problem.remedy().empty()) << problem.field();
        }
      }
    }
  }
  EXPECT_GT(refused, 200);
  RecordProperty("tried", tried);
  RecordProperty("refused", refused);
}

// A field that is left out is refused by its name or has a default; the case never runs half-defined.
TEST(HardInput, FieldsLeftOutAreNamedOrHaveADefault) {
  int refused = 0;
  for (const v1::Case& sound : sound_cases()) {
    std::vector<Leaf> leaves;
    collect_leaves(
        sound, "", [](Message& root) { return &root; }, leaves);
    for (const Leaf& leaf : leaves) {
      if (leaf.index >= 0) continue;
      v1::Case spoiled = sound;
      Message* parent = leaf.parent(spoiled);
      parent->GetReflection()->ClearField(parent, leaf.field);
      const auto response = translate::check_case(spoiled).response;
      refused += response.problems_size() > 0 ? 1 : 0;
      if (response.problems_size() == 0) {
        EXPECT_GT(response.step_count(), 0) << leaf.path;
      }
    }
  }
  EXPECT_GT(refused, 40);
}

}  // namespace
}  // namespace cellcrush
