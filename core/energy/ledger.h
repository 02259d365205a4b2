#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The ledger of a run: work of the plates and loads = kinetic + elastic + plastic + contact + friction + damping +
// residual. Every term is integrated by itself; the residual is what the integration lost or made.
//
// With the works of motion/motion_works.h, kinetic energy is m v(n-1/2) . v(n+1/2) / 2 and a linear system closes to
// round-off. Plastic work is the returned stress times the plastic strain increment and elastic energy a function of
// the stresses alone, so that an unstable integration, which plasticity can hide as heat, opens the ledger.

/// Starts the ledger at time 0: sets the initial kinetic energy and subtracts the half step before it.
void open_ledger(const Scene& scene, State& state);

/// The ledger at the state's time, N mm. Positive dissipation; the residual is external + initial - all others.
struct Energies {
  double kinetic = 0.0;
  double elastic = 0.0;
  double plastic = 0.0;
  double contact = 0.0;
  double contact_damping = 0.0;
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;
  double residual = 0.0;
};
Energies evaluate_energies(const Scene& scene, const State& state);

}  // namespace cellcrush
