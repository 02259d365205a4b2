#include "worker/step_cost.h"

#include <ctime>

#include "cellcrush/presets.h"
#include "cellcrush/simulation.h"

namespace cellcrush::worker {
namespace {

constexpr double kLongest = 0.1;  // seconds
// Used when nothing could be measured: what a core of 2022 took.
constexpr double kUnmeasured = 1e-7;

// Of this thread: what else the machine does at the moment is no part of the cost.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace

double measure_step_cost() {
  const Preset* preset = find_preset("hexagon-small");
  if (preset == nullptr) return kUnmeasured;
  SceneSpec spec = preset->spec;
  // Few and fast: the whole crush, with all its contacts, is over within the time there is.
  if (auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    hexagon->columns = 6;
    hexagon->rows = 4;
  }
  const auto built = build_scene(spec);
  if (!built.scene) return kUnmeasured;
  const auto facts = facts_of(*built.scene);
  Simulation simulation(built.scene);
  const double start = processor_seconds();
  while (simulation.step() < facts.step_count && processor_seconds() - start < kLongest) simulation.advance(32);
  const double seconds = processor_seconds() - start;
  const auto element_steps = static_cast<double>(simulation.step()) * static_cast<double>(facts.element_count);
  return element_steps > 0.0 ? seconds / element_steps : kUnmeasured;
}

}  // namespace cellcrush::worker
