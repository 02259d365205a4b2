#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

// The ledger of a run (E10): work of plates, rigid walls and loads = kinetic + elastic + plastic + contact + friction +
// damping + residual. Every term is computed on its own; the residual is the energy lost or created by the integration.
//
// With the works of motion/motion_works.h, the kinetic energy is m v(n-1/2) . v(n+1/2) / 2, and a linear system closes
// to round-off. The plastic work is the returned stress times the plastic strain increment, and the elastic energy is a
// function of the stresses alone. An unstable integration therefore shows in the residual, even where plasticity would
// hide it as dissipation.

/// Opens the ledger at time 0: sets the initial kinetic energy and subtracts the work of the half step before.
void open_ledger(const Scene& scene, State& state);

/// The ledger at the time of a state, and the energies at that time, in pieces for any threads. What a piece is depends
/// on the scene alone, so the bits of the sum do, too.
class EnergyPieces {
 public:
  /// The state must outlive it, and not change.
  EnergyPieces(const Scene& scene, const State& state);

  [[nodiscard]] std::size_t count() const;

  /// Does not throw; each piece once.
  void evaluate(std::size_t piece);

  /// REQUIRES: every piece is evaluated.
  [[nodiscard]] Energies total() const;

 private:
  const Scene& scene_;
  const State& state_;
  std::vector<double> walls_;           ///< elastic energy of each piece, N mm
  std::vector<MotionWorks> particles_;  ///< of each chunk of free particles
};

/// All of them at once.
Energies evaluate_energies(const Scene& scene, const State& state);

}  // namespace cellcrush
