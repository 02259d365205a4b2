#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "cellcrush/spec_checker.h"
#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// The solver's word on a case.
struct CaseCheck {
  v1::CheckCaseResponse response;  ///< all but predicted_seconds and predicted_bytes, or only problems
  std::int64_t sample_count = 0;   ///< that the run will give
  std::int64_t frame_count = 0;    ///< the same, with the undeformed one
  std::unique_ptr<SpecChecker> meshes = std::make_unique<SpecChecker>();  ///< knows the mesh of a case without problems
};

/// Builds the case's scene and describes it, or reports all problems. `between_stages` is called between the stages,
/// each of which takes about a second for the largest mesh; what it throws is passed on. Throws std::bad_alloc when the
/// scene does not fit.
CaseCheck check_case(
    const v1::Case& submitted, const std::function<void()>& between_stages = [] {});

/// Bytes that the run of a case without problems is predicted to need. Builds its scene.
std::int64_t predicted_memory(const v1::Case& submitted);

}  // namespace cellcrush::translate
