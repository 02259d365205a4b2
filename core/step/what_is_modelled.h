#pragma once

#include <string>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// What is modelled and what is left out, with the reason for each simplification; one or two sentences each.
std::vector<std::string> what_is_modelled(const Scene& scene);

}  // namespace cellcrush
