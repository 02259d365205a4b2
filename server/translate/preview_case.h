#pragma once

#include <functional>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// The lattice of a case before loading, with marks and problems; without a mesh if it cannot be meshed. Calls
/// `between_stages` as check_case does. Throws std::bad_alloc if the mesh does not fit.
v1::PreviewCaseResponse preview_case(
    const v1::Case& submitted, const std::function<void()>& between_stages = [] {});

}  // namespace cellcrush::translate
