#pragma once

#include <array>

namespace cellcrush {

/// Energies and works accumulated over time (E10), N mm. Written by integrate_motion and evaluate_internal_forces.
struct Ledger {
  double plastic = 0.0;          ///< stress times plastic strain increment
  double contact = 0.0;          ///< work against the elastic normal forces of contacts, walls' and plates'
  double contact_damping = 0.0;  ///< work against the viscous forces of contacts
  double friction = 0.0;
  double mass_damping = 0.0;
  double external = 0.0;  ///< work of the plates, of rigid walls and of nodal loads
  double initial = 0.0;   ///< kinetic energy at the start
};

/// The ledger at one time, and the energies at that time. Dissipation is positive. The residual is external + initial
/// minus all others.
struct Energies : Ledger {
  double kinetic = 0.0;
  double elastic = 0.0;
  double fracture = 0.0;  ///< work of the forces between ends that break off and their joints (E6g)
  double residual = 0.0;
};

struct LedgerTerm {
  const char* name;  ///< of the column of the history, if it is one: a field of cellcrush.v1.Sample
  double Energies::*value;
  bool is_supplied;  ///< enters the residual with its own sign; otherwise with the opposite one
};

/// All terms of the balance, in the order in which the residual adds them. Samples and outputs follow this list.
inline constexpr std::array kLedgerTerms = {
    LedgerTerm{"work_external_mj", &Energies::external, true},
    LedgerTerm{"energy_initial_mj", &Energies::initial, true},
    LedgerTerm{"energy_kinetic_mj", &Energies::kinetic, false},
    LedgerTerm{"energy_elastic_mj", &Energies::elastic, false},
    LedgerTerm{"energy_plastic_mj", &Energies::plastic, false},
    LedgerTerm{"energy_fracture_mj", &Energies::fracture, false},
    LedgerTerm{"energy_contact_mj", &Energies::contact, false},
    LedgerTerm{"energy_contact_damping_mj", &Energies::contact_damping, false},
    LedgerTerm{"energy_friction_mj", &Energies::friction, false},
    LedgerTerm{"energy_mass_damping_mj", &Energies::mass_damping, false},
};
static_assert(kLedgerTerms.size() + 1 == sizeof(Energies) / sizeof(double), "Every term but the residual is listed.");

inline double residual_of(const Energies& energies) {
  double residual = 0.0;
  for (const LedgerTerm& term : kLedgerTerms) {
    residual += term.is_supplied ? energies.*term.value : -(energies.*term.value);
  }
  return residual;
}

}  // namespace cellcrush
