#pragma once

#include <google/protobuf/generated_enum_reflection.h>

#include <string>

#include "cellcrush/scene_spec.h"

namespace cellcrush::translate {

// Sets `out` to the meaning of the wire value; 0 (unspecified) leaves it unchanged. The enum of the spec lists the same
// values in the same order, from `first` on.
template <class Wire, class Out>
void read_choice(Wire in, const std::string& field, Out& out, Problems& problems, Out first = Out()) {
  const auto& values = *google::protobuf::GetEnumDescriptor<Wire>();
  if (static_cast<int>(in) == 0) return;
  if (values.FindValueByNumber(in) != nullptr) {
    out = static_cast<Out>(static_cast<int>(in) - 1 + static_cast<int>(first));
    return;
  }
  std::string names = values.value(1)->name();
  for (int i = 2; i < values.value_count(); ++i)
    names += (i + 1 < values.value_count() ? ", " : " or ") + values.value(i)->name();
  problems.push_back({field, std::to_string(in), "is not a valid value.", "Use " + names + "."});
}

}  // namespace cellcrush::translate
