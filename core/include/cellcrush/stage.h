#pragma once

#include <array>

namespace cellcrush {

/// The stages of a step, in their order; the same names stand in advance_step, in timers and in core/README.md.
enum class Stage {
  integrate_motion,
  evaluate_internal_forces,
  find_contacts,
  evaluate_contact_forces,
  evaluate_plate_forces,
  evaluate_loads,
};
inline constexpr int kStageCount = 6;

/// Their names, in the order of the enumerators.
inline constexpr std::array<const char*, kStageCount> kStageNames = {
    "integrate_motion",        "evaluate_internal_forces", "find_contacts",
    "evaluate_contact_forces", "evaluate_plate_forces",    "evaluate_loads"};

/// Told when a stage begins, and when the step ends; of a large lattice, whose bands do several steps while they are in
/// the caches, when these end. The solver has no clock: who wants times brings one.
class StageObserver {
 public:
  virtual ~StageObserver() = default;
  virtual void begin(Stage stage) = 0;
  virtual void end_step() = 0;
};

}  // namespace cellcrush
