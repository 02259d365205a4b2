#include "translate/preset_cases.h"

#include "cellcrush/presets.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

v1::Preset head_of(const Preset& preset) {
  v1::Preset out;
  out.set_name(preset.name);
  out.set_title(preset.title);
  for (const auto& assumption : preset.assumptions) out.add_assumptions(assumption);
  return out;
}

}  // namespace

std::vector<v1::Preset> list_presets() {
  std::vector<v1::Preset> out;
  for (const auto& preset : presets()) out.push_back(head_of(preset));
  return out;
}

std::optional<v1::Preset> find_preset_case(const std::string& name) {
  const Preset* preset = find_preset(name);
  if (preset == nullptr) return std::nullopt;
  v1::Preset out = head_of(*preset);
  *out.mutable_case_() = to_case(preset->spec);
  return out;
}

}  // namespace cellcrush::translate
