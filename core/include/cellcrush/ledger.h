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
  double residual = 0.0;
};

struct LedgerTerm {
  const char* name;
  double Energies::*value;
  bool is_supplied;  ///< enters the residual with its own sign; otherwise with the opposite one
};

/// All terms of the balance, in the order in which the residual adds them.
inline constexpr std::array kLedgerTerms = {
    LedgerTerm{"external", &Energies::external, true},
    LedgerTerm{"initial", &Energies::initial, true},
    LedgerTerm{"kinetic", &Energies::kinetic, false},
    LedgerTerm{"elastic", &Energies::elastic, false},
    LedgerTerm{"plastic", &Energies::plastic, false},
    LedgerTerm{"contact", &Energies::contact, false},
    LedgerTerm{"contact_damping", &Energies::contact_damping, false},
    LedgerTerm{"friction", &Energies::friction, false},
    LedgerTerm{"mass_damping", &Energies::mass_damping, false},
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
