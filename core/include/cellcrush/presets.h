#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// A case that comes with cellcrush.
struct Preset {
  std::string name;
  std::string title;
  std::vector<std::string> assumptions;  ///< what the source does not settle and was chosen here
  SceneSpec spec;
};

/// All presets, in the order they are listed in.
std::span<const Preset> presets();

/// The preset of that name, or nullptr.
const Preset* find_preset(std::string_view name);

}  // namespace cellcrush
