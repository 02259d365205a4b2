#include "worker/step_cost.h"

#include "cellcrush/simulation.h"
#include "translate/presets.h"
#include "worker/stage_timer.h"

namespace cellcrush::worker {
namespace {

constexpr double kLongest = 0.05;  // seconds
// Fallback if the measurement fails: the cost on a core of 2022.
constexpr double kUnmeasured = 1e-7;

}  // namespace

double measure_step_cost() {
  const translate::Preset* preset = translate::find_preset("hexagon-small");
  if (preset == nullptr) return kUnmeasured;
  // About the first third of its crush, with contacts. In a smaller lattice the outer walls, which fill no vectors, and
  // the plates would dominate.
  const auto built = build_scene(preset->spec);
  if (!built.scene) return kUnmeasured;
  const auto facts = facts_of(*built.scene);
  Simulation simulation(built.scene);
  const double start = processor_seconds(CLOCK_THREAD_CPUTIME_ID);
  while (simulation.step() < facts.step_count && processor_seconds(CLOCK_THREAD_CPUTIME_ID) - start < kLongest)
    simulation.advance(32);
  const double seconds = processor_seconds(CLOCK_THREAD_CPUTIME_ID) - start;
  const auto element_steps = static_cast<double>(simulation.step()) * static_cast<double>(facts.element_count);
  return element_steps > 0.0 ? seconds / element_steps : kUnmeasured;
}

}  // namespace cellcrush::worker
