#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A case that is shipped with cellcrush.
struct Preset {
  std::string name;
  std::string title;
  std::vector<std::string> assumptions;  ///< choices made here where the source is silent
  SceneSpec spec;
};

/// All presets, in the order in which they are listed.
std::span<const Preset> presets();

/// The preset with that name, or nullptr.
const Preset* find_preset(std::string_view name);

}  // namespace cellcrush
