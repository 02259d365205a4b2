#pragma once

#include <span>
#include <string>
#include <string_view>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

struct NamedSpec {
  std::string name;
  SceneSpec spec;
};

/// The presets of server/presets/presets.txtpb, for programs without the server. tests/server/presets_test.cpp holds
/// them equal.
std::span<const NamedSpec> presets();

/// Throws std::invalid_argument if none has that name.
const SceneSpec& preset(std::string_view name);

}  // namespace cellcrush::scenes
