#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/simulation.h"

namespace cellcrush::validation {

/// First local limit of a crush: the greatest mean of the two plates' stresses, smoothed over 0.005 of strain, at
/// strains of 2 to 20 %, and the least after it up to 14 % strain.
struct Limit {
  double stress = 0.0;       ///< MPa
  double strain = 0.0;       ///< where it stands
  double least_after = 0.0;  ///< MPa
};

/// A crush from beginning to end and what it amounts to.
struct CrushRun {
  RunStatus status;
  SceneFacts facts;
  std::vector<Sample> samples;
  Summary summary;
  Limit limit;
  std::int64_t crossings = 0;           ///< pairs of walls that cross, in all frames
  double deepest_birth = 0.0;           ///< of a wall contact, over the thinner wall's thickness
  double contact_work_share = 0.0;      ///< least accumulated contact work over the external work done by then
  double plate_force_difference = 0.0;  ///< |mean impact - mean support| / mean impact, beyond 5 % strain
  double kinetic_over_work = 0.0;       ///< greatest kinetic energy over the external work by then, beyond 5 % strain
  double kinetic_over_plastic = 0.0;    ///< the same over the plastic work, beyond 5 % strain
  double kinetic_over_plastic_flowing = 0.0;  ///< the same beyond 10 %, where the knee of the curve is passed
  double seconds = 0.0;                       ///< of wall time
  double processor_seconds = 0.0;             ///< of the steps and samples alone
  std::uint64_t state_hash = 0;               ///< of the last state
};

/// What is done while a crush goes on; each may be empty.
struct CrushWatch {
  std::function<void(const Scene&)> on_start;
  std::function<void(const Sample&)> on_sample;
  std::function<void(const FieldFrame&)> on_frame;  ///< of the undeformed lattice first
};

/// Runs a preset's spec to its end, or to the moment at which it stopped, or to the first sample at the strain `until`
/// or beyond. Throws std::invalid_argument with all problems of a spec that has any.
CrushRun run_crush(const SceneSpec& spec, double until = std::numeric_limits<double>::infinity(),
                   const CrushWatch& watch = {});

}  // namespace cellcrush::validation
