#pragma once

#include <algorithm>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "energy/ledger.h"

namespace cellcrush {

/// Judges whether a lattice, with the masses that strike it, has come to rest: its kinetic energy has stayed below a
/// fraction of the greatest one since the start (loading.end_at_rest) for a hundredth of the longest run. It looks
/// every so many steps, whatever samples and checkpoints are taken.
struct RestWatch {
  double greatest = 0.0;  ///< kinetic energy, N mm
  std::int64_t calm = 0;  ///< looks in a row at which the energy was below the fraction

  [[nodiscard]] static std::int64_t interval(const Schedule& schedule) {
    return std::max<std::int64_t>(1, schedule.step_count / 1000);
  }
  [[nodiscard]] bool is_at_rest() const { return calm >= 10; }

  void look(const Scene& scene, const State& state) {
    const double kinetic = evaluate_energies(scene, state).kinetic;
    greatest = std::max(greatest, kinetic);
    calm = kinetic < scene.schedule.end_at_rest * greatest ? calm + 1 : 0;
  }
};

}  // namespace cellcrush
