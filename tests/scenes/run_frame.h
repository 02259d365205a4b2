#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// The samples of a case, run to its end; fails the test with the cause when it does not come there.
std::vector<Sample> run_frame(const SceneSpec& spec);

}  // namespace cellcrush::scenes
