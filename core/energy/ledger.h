#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "step/integrate_motion.h"

namespace cellcrush {

// The ledger of a run: work of the plates and loads = kinetic + elastic + plastic + contact + friction + damping + residual.
// Every term is integrated by itself; the residual is what the integration lost or made.
//
// Forces act at whole steps, velocities stand half a step off. A force's work is F(t_n) . dt (v(n-1/2) + v(n+1/2)) / 2, the
// trapezoidal rule over the displacements; with it kinetic energy is m v(n-1/2) . v(n+1/2) / 2 and a linear system closes to
// round-off. Plastic work is the returned stress times the plastic strain increment and elastic energy a function of the
// stresses alone, so that an unstable integration, which plasticity can hide as heat, opens the ledger.

/// Displacement of a particle that forces at one time do work over.
struct MeanMotion {
  Vector2 displacement;  ///< mm
  double turn;           ///< rad
};

/// Adds the work that the forces on a particle do over a mean motion to the ledger.
void accumulate_work(const Scene& scene, const State& state, std::size_t particle, const NextVelocity& next,
                     const MeanMotion& mean, Ledger& ledger);

/// Adds the work of the impact plate over a mean displacement of it, mm. On the particles' side its forces are among the
/// contacts'.
void accumulate_plate_work(const State& state, double displacement, Ledger& ledger);

/// Starts the ledger at time 0: books the kinetic energy and takes back the half step before it.
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
