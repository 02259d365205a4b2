#include "bench/crushed_states.h"

#include <cmath>
#include <stdexcept>

#include "bench/machine.h"
#include "bench/state_file.h"
#include "cellcrush/simd.h"
#include "scenes/frames.h"

namespace cellcrush::bench {

const CrushedStates::Crushed& CrushedStates::at(const scenes::Crush& crush, double strain) {
  if (!crushed_.contains(crush.name)) run(crush);
  return crushed_.at(crush.name).at(strain);
}

void CrushedStates::run(const scenes::Crush& crush) {
  static const std::string kBuild = build_name();
  const std::string target = simd_target();
  use_simd_target("");
  const auto scene = scenes::build(crush.spec);
  std::map<double, Crushed>& states = crushed_[crush.name];
  Simulation simulation(scene);
  for (const double strain : crush.strains) {
    const std::string name = crush.name + "-" + std::to_string(std::lround(100.0 * strain)) + "-" + kBuild + ".state";
    std::optional<State> kept = folder_.empty() ? std::nullopt : load_state(folder_ / name);
    if (!kept) {
      while (simulation.strain() < strain && simulation.status().kind == RunStatus::Kind::running) {
        simulation.advance(16);
      }
      kept = simulation.state();
      if (!folder_.empty()) save_state(folder_ / name, *kept);
    }
    states[strain] = {scene, *std::move(kept)};
  }
  use_simd_target(target);
}

}  // namespace cellcrush::bench
