#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// All problems of a spec that can be seen without building its mesh, in the order of the fields. The only validator of
/// physics; what it lets pass, build_scene can build.
/// REQUIRES: its fidelity has been filled in.
Problems check_spec(const SceneSpec& spec);

/// A number as problems show it: the shortest text that reads back as the same value.
std::string to_text(double value);

}  // namespace cellcrush
