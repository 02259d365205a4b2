#include "translate/presets.h"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <stdexcept>

#include "translate/case_to_spec.h"
#include "translate/loads_places.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

std::vector<Preset> read_presets() {
  v1::ListPresetsResponse texts;
  if (!google::protobuf::TextFormat::ParseFromString(presets_text(), &texts))
    throw std::logic_error("server/presets/presets.txtpb is no ListPresetsResponse");
  std::vector<Preset> out;
  for (v1::Preset& message : *texts.mutable_presets()) {
    SceneSpec spec = to_spec(message.case_()).spec;
    v1::Case completed = to_case(spec);
    restore_ids(message.case_(), completed);
    if (!message.case_().material().named().empty()) *completed.mutable_material() = message.case_().material();
    *message.mutable_case_() = std::move(completed);
    out.push_back({std::move(message), std::move(spec)});
  }
  return out;
}

}  // namespace

const std::vector<Preset>& presets() {
  static const std::vector<Preset> kPresets = read_presets();
  return kPresets;
}

const Preset* find_preset(const std::string& name) {
  const auto found = std::ranges::find(presets(), name, [](const Preset& preset) { return preset.message.name(); });
  return found == presets().end() ? nullptr : &*found;
}

}  // namespace cellcrush::translate
