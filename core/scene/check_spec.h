#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// All problems of a spec that can be found without building its mesh, in the order of the fields. This is the only
/// validator of the physics: build_scene can build whatever it accepts.
/// REQUIRES: the fidelity has been filled in.
Problems check_spec(const SceneSpec& spec);

/// A number as shown in problems: the shortest text that reads back as the same value.
std::string to_text(double value);

}  // namespace cellcrush
