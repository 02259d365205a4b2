#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "cellcrush/spec_checker.h"
#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/cases_service.pb.h"
#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::translate {

/// The lists of the case that are longer than any case needs; checked before anything else. A message of 4 MiB can hold
/// millions of empty entries, each of which would cause several problems. Limits: 200000 nodes, beams, supports, loads
/// and points of time functions; 10000 motions and watched nodes; 1000 rigid walls; 10000 rows of inclusions.
google::protobuf::RepeatedPtrField<v1::Problem> find_long_lists(const v1::Case& submitted);

v1::Problem to_proto(const Problem& problem, v1::Problem::Kind kind = v1::Problem::INVALID);

/// Maximum number of problems listed for one case; the rest are only counted.
inline constexpr int kMostProblems = 1000;

/// Truncates the problems to kMostProblems plus one that counts the rest.
void cut_problems(google::protobuf::RepeatedPtrField<v1::Problem>& problems);

/// The solver's check of a case.
struct CaseCheck {
  v1::CheckCaseResponse response;  ///< all but predicted time and disk space, or only problems
  std::int64_t wall_count = 0;
  double reference_steps = 0.0;                  ///< time of the run (SpecChecker::Verdict)
  std::int64_t sample_count = 0;                 ///< of the run
  std::int64_t frame_count = 0;                  ///< of the run, including the undeformed frame
  std::int64_t checkpoint_bytes = 0;             ///< of its largest checkpoint
  std::optional<std::string> why_not_on_device;  ///< nothing: a device can advance it
  std::unique_ptr<SpecChecker> meshes = std::make_unique<SpecChecker>();  ///< holds the mesh of a case without problems
};

/// Builds and describes the case's scene, or returns all problems. Calls `between_stages` between the stages, each of
/// which takes about a second for the largest mesh; its exceptions propagate. Throws std::bad_alloc if the scene does
/// not fit.
CaseCheck check_case(
    const v1::Case& submitted, const std::function<void()>& between_stages = [] {});

/// Bytes that the run of a case without problems is predicted to need. Builds its scene.
std::int64_t predicted_memory(const v1::Case& submitted);

}  // namespace cellcrush::translate
