#pragma once

#include <cstddef>
#include <functional>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// Size of a mesh, bytes, that fits with all marks in a message of 4 MiB.
inline constexpr std::size_t kLargestPreview = 4'000'000;

/// The lattice of a case before loading, with marks and problems; without a mesh if it cannot be meshed. A mesh above
/// kLargestPreview is made with elements_per_wall 1 instead, and may still be larger. Calls `between_stages` as
/// check_case does. Throws std::bad_alloc if the mesh does not fit.
v1::PreviewCaseResponse preview_case(
    const v1::Case& submitted, const std::function<void()>& between_stages = [] {});

}  // namespace cellcrush::translate
