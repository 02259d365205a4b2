#pragma once

#include <array>

namespace cellcrush {

/// The stages of a step, in order. advance_step, timers and core/README.md use the same names.
enum class Stage {
  integrate_motion,
  evaluate_internal_forces,
  find_contacts,
  evaluate_contact_forces,
  evaluate_plate_forces,
  evaluate_loads,
};
inline constexpr int kStageCount = 6;

/// Names of the stages, in the order of the enumerators.
inline constexpr std::array<const char*, kStageCount> kStageNames = {
    "integrate_motion",        "evaluate_internal_forces", "find_contacts",
    "evaluate_contact_forces", "evaluate_plate_forces",    "evaluate_loads"};

/// Called when a stage begins and when a step ends. A large lattice advances by wavefronts of steps
/// (step/advance_wavefront.h); end_step() is then called once for each wavefront. The solver has no clock: an observer
/// that measures times brings its own.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void begin(Stage stage) = 0;
  virtual void end_step() = 0;
};

}  // namespace cellcrush
