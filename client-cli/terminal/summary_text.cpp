#include "terminal/summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "results/energy_terms.h"
#include "results/sweep_results.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;

// "shock theory (Eq. 51), 4.7 % higher".
std::string theory_text(const char* theory, bool known, double error) {
  if (!known) return theory;
  return fmt::format("{}, {} {}", theory, percent_text(std::abs(error)), error < 0.0 ? "lower" : "higher");
}

// Whether the run went on to where the lattice is closed.
bool has_closed(const v1::Summary& summary) {
  return summary.end() == v1::Summary::END_CLOSED || std::ranges::any_of(summary.warnings(), [](const auto& warning) {
           return warning.kind() == v1::Warning::CLOSED;
         });
}

void add_plateau_rows(Table& table, const v1::Job& job) {
  const v1::Summary& summary = job.summary();
  const bool theory = summary.has_theory() && summary.theory().shock_mpa() > 0;
  const bool has_moduli = summary.theory().has_modulus_mpa();
  const ShownUnit unit =
      unit_by_size("MPa", std::max({summary.plateau_stress_impact_mpa(), summary.plateau_stress_support_mpa(),
                                    summary.plateau_stress_to_densification_mpa(), summary.theory().shock_mpa()}));
  const auto stress_text = [&](double stress) { return number_text(unit.factor * stress) + " " + unit.name; };
  const auto stress_row = [&](const char* plate, bool known, double stress, double expected,
                              const std::string& source) {
    const bool closed = summary.has_valid_to_strain() && summary.valid_to_strain() < summary.plateau_window_high();
    table.add({fmt::format("  at the {} plate", plate),
               known    ? stress_text(stress)
               : closed ? "closed before"
                        : "not reached",
               theory ? stress_text(expected) : "", theory ? source : ""});
  };
  table.add({fmt::format("plateau stress, {:.0f}-{:.0f} % strain", 100 * summary.plateau_window_low(),
                         100 * summary.plateau_window_high()),
             "computed", theory || has_moduli ? "theory" : "", theory ? "" : "no theory applies"});
  stress_row("impact", summary.has_plateau_stress_impact_mpa(), summary.plateau_stress_impact_mpa(),
             summary.theory().shock_mpa(),
             theory_text("shock theory (Eq. 51)", summary.has_shock_error_relative(), summary.shock_error_relative()));
  if (summary.has_front()) {
    const v1::FrontSummary& front = summary.front();
    table.add({"", "", stress_text(front.shock_mpa()),
               theory_text("shock theory with measured jumps (Eq. 52)", front.has_shock_error_relative(),
                           front.shock_error_relative())});
  } else if (const std::string absent = absent_theory_text(summary); !absent.empty()) {
    table.add({"", "", "none", absent});
  }
  if (has_support(job)) {
    stress_row("support", summary.has_plateau_stress_support_mpa(), summary.plateau_stress_support_mpa(),
               summary.theory().gibson_ashby_mpa(), "quasi-static (Gibson-Ashby)");
  }
  if (summary.has_peak_stress_mpa()) {
    table.add({"peak stress, impact plate", quantity_text(summary.peak_stress_mpa(), "MPa"), "",
               fmt::format("mean over {:.3g} % strain, at {:.3g}", 100 * summary.peak_stress_window(),
                           summary.peak_stress_strain())});
  }
  if (summary.has_crush_forces()) {
    const v1::CrushForces& forces = summary.crush_forces();
    table.add({"mean crush force, impact plate", quantity_text(forces.mean_n(), "N"), "",
               fmt::format("over {} mm; {:.3g} of the peak", number_text(forces.stroke_mm()), forces.efficiency())});
    table.add(
        {"specific energy absorbed", number_text(forces.specific_energy_j_per_g()) + " J/g", "", "over that travel"});
  }
  // A file of an earlier version lacks it.
  const bool of_theory = theory && summary.theory().densification_strain() > 0.0;
  table.add({"densification strain",
             summary.has_densification_strain() ? number_text(summary.densification_strain())
             : summary.has_other_rise_strain()  ? "none"
             : has_closed(summary)              ? "closed before"
                                                : "not reached",
             of_theory ? number_text(summary.theory().densification_strain()) : "",
             of_theory ? "1 - 1.4 relative density" : ""});
  if (summary.has_other_rise_strain()) {
    table.add({"other lasting rise of the stress", number_text(summary.other_rise_strain()), "",
               printable(summary.other_rise_words())});
  }
  if (summary.has_plateau_stress_to_densification_mpa()) {
    table.add({"plateau stress to densification", stress_text(summary.plateau_stress_to_densification_mpa())});
  }
  if (summary.has_solid_fraction_at_densification()) {
    table.add({"solid fraction at densification", number_text(summary.solid_fraction_at_densification())});
  }
  if (has_moduli) {
    table.add(
        {"elastic modulus", "", quantity_text(summary.theory().modulus_mpa(), "MPa"), "E* of an endless lattice"});
  }
  if (summary.has_poissons_ratio()) {
    table.add({"Poisson's ratio", number_text(summary.poissons_ratio()),
               has_moduli ? number_text(summary.theory().poissons_ratio()) : "",
               has_moduli ? fmt::format("secant to {:.3g}; theory: elastic", summary.plateau_window_high())
                          : fmt::format("secant, up to {:.3g} strain", summary.plateau_window_high())});
  }
  if (summary.has_valid_to_strain()) {
    table.add({"valid to strain", number_text(summary.valid_to_strain()), "", "the lattice is closed from there on"});
  }
  if (!has_support(job)) return;
  // For a run that ended earlier, this is the total work of its plate.
  const bool whole = summary.absorbed_energy_mj() > (1.0 - 1e-9) * summary.ledger().work_external_mj();
  const double to = std::min(0.5, summary.has_valid_to_strain() ? summary.valid_to_strain() : 0.5);
  table.add({whole && summary.has_ledger() ? "energy absorbed to the end"
                                           : fmt::format("energy absorbed to {:.3g} % strain", 100 * to),
             quantity_text(summary.absorbed_energy_mj(), "mJ")});
}

// On lines of their own: words in a column of numbers would widen it.
std::string end_text(const v1::Summary& summary, int width) {
  if (summary.end() != v1::Summary::END_CLOSED) return {};
  return wrapped("ended by itself: " + printable(summary.end_words()), width, "  ", "    ");
}

std::string mode_text(const v1::Summary& summary, int width) {
  const std::string mode = printable(summary.crush_mode_words());
  if (mode.empty()) return {};
  return wrapped(fmt::format("crush mode: {}{}", mode,
                             summary.has_crush_mode_strain()
                                 ? fmt::format(", first seen at strain {:.2f}", summary.crush_mode_strain())
                                 : std::string()),
                 width, "  ", "    ");
}

std::string front_text(const v1::FrontSummary& front, int width) {
  Table table({Align::left, Align::right, Align::right, Align::left});
  const auto row = [&](const char* what, double behind, double ahead, const char* unit) {
    table.add({what, number_text(behind), number_text(ahead), unit});
  };
  table.add({"front over the plateau window", "behind", "ahead"});
  row("strain", front.strain_behind(), front.strain_ahead(), "");
  row("velocity", front.velocity_behind_m_per_s(), front.velocity_ahead_m_per_s(), "m/s");
  const ShownUnit unit = unit_by_size("MPa", front.stress_ahead_mpa());
  table.add({"stress", "", number_text(unit.factor * front.stress_ahead_mpa()),
             fmt::format("{}, ahead of the front (sigma_A of Eq. 52)", unit.name)});
  table.add({"solid fraction", number_text(front.solid_fraction_behind()), "", "from the undeformed wall volume"});
  table.add({"", number_text(front.wall_fraction_behind()), "", "from the current walls"});
  return table.text(2, width);
}

// How quasi-static a slow run was; nothing for a fast one.
void add_quasi_static_rows(Table& table, const v1::Summary& summary) {
  constexpr double kSlow = 0.1;
  const v1::QuasiStatic& found = summary.quasi_static();
  if (!summary.has_quasi_static() || found.kinetic_share() >= kSlow) return;
  table.add({"plate stress difference beyond 5 % strain", percent_text(found.plate_difference_relative(), 2), "",
             "of the mean stress; at most " + percent_text(found.plate_difference_greatest(), 2) +
                 " in any 5 % strain interval"});
}

void add_inertia_row(Table& table, const v1::Summary& summary) {
  if (!summary.has_inertia_share()) return;
  table.add({"inertia's share of the work", percent_text(summary.inertia_share(), 2), "",
             "largest kinetic energy on the plateau"});
}

void add_fibre_strain_row(Table& table, const v1::Summary& summary, bool plates) {
  if (!summary.has_fibre_strain()) return;
  const v1::FibreStrain& found = summary.fibre_strain();
  const std::string when =
      plates ? fmt::format("strain {:.3g}", found.nominal_strain()) : fmt::format("{:.3g} s", found.time_s());
  table.add({"largest fibre strain", percent_text(found.largest(), 2), "",
             fmt::format("wall {} at ({:.3g}, {:.3g}) mm, {}", found.wall(), found.x_mm(), found.y_mm(), when)});
}

void add_rigid_links_row(Table& table, const v1::Summary& summary) {
  if (summary.rigid_link_count() == 0) return;
  table.add({"rigid links", count_text(summary.rigid_link_count()), "", "beams too short to bend"});
}

// What instruments at the walls would have shown. A wall that stands still has no stroke.
std::string rigid_walls_text(const v1::Summary& summary, int width) {
  if (summary.rigid_walls().empty()) return {};
  Table table({Align::left, Align::right, Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"rigid walls", "peak force", "deceleration", "stroke", "end velocity", "impulse", "work"});
  for (const v1::RigidWallSummary& wall : summary.rigid_walls()) {
    table.add({"  " + printable(wall.wall()), quantity_text(wall.peak_force_n(), "N"),
               number_text(wall.peak_deceleration_m_per_s2()) + " m/s2", number_text(wall.stroke_mm()) + " mm",
               number_text(wall.end_velocity_m_per_s()) + " m/s", number_text(wall.impulse_n_s()) + " N s",
               quantity_text(wall.work_mj(), "mJ")});
  }
  return '\n' + table.text(2, width);
}

void add_overlaps_row(Table& table, const v1::Summary& summary) {
  if (summary.start_overlap_count() == 0) return;
  table.add({"overlaps before loading", count_text(summary.start_overlap_count()), "", "pairs of walls"});
}

void add_breaks_row(Table& table, const v1::Summary& summary, bool plates) {
  if (summary.break_count() == 0) return;
  table.add({"broken walls", count_text(summary.break_count()), "",
             plates ? fmt::format("the first at strain {:.3g}", summary.first_break_strain())
                    : fmt::format("the first at {:.3g} s", summary.first_break_time_s())});
}

std::string warning_text(const v1::Warning& warning, int width) {
  return wrapped(fmt::format("Warning ({}): {}", v1::Warning::Kind_Name(warning.kind()), printable(warning.message())),
                 width, "  ", "    ") +
         wrapped("Remedy: " + printable(warning.remedy()), width, "    ", "    ");
}

std::string ledger_text(const v1::Ledger& ledger, int width) {
  Table table({Align::left, Align::right, Align::right});
  const auto terms = energy_terms_of(*v1::Ledger::descriptor());
  double spent = 0.0;
  for (const EnergyTerm& term : terms) spent += term.value(ledger);
  const double whole = std::max(std::abs(spent), std::abs(ledger.work_external_mj()));
  const ShownUnit unit = unit_by_size("mJ", whole);
  const auto row = [&](const std::string& what, double energy) {
    table.add({what, number_text(unit.factor * energy) + " " + unit.name,
               whole > 0.0 ? percent_text(energy / whole, 2) : ""});
  };
  row("energy ledger: work of plates and loads", ledger.work_external_mj());
  // Round-off of the sum is not shown as energy.
  const double start = spent - ledger.work_external_mj();
  const bool knows_all = ledger.GetReflection()->GetUnknownFields(ledger).empty();
  const char* rest = knows_all ? "initial energy" : "initial energy less terms of a newer server";
  if (std::abs(start) > 1e-9 * whole) row(rest, start);
  for (const EnergyTerm& term : terms) row(term.label, term.value(ledger));
  return table.text(2, width);
}

}  // namespace

std::string summary_text(const v1::Job& job, int width) {
  const v1::Summary& summary = job.summary();
  const bool plates = has_strain(job.words());
  Table table({Align::left, Align::right, Align::right, Align::left});
  if (plates) {
    if (job.words().rigid_wall_plates())
      table.add({"impact plate", "", "", "the rigid wall that moves, or stands alone"});
    add_plateau_rows(table, job);
    add_quasi_static_rows(table, summary);
    add_inertia_row(table, summary);
  }
  add_fibre_strain_row(table, summary, plates);
  add_breaks_row(table, summary, plates);
  add_rigid_links_row(table, summary);
  add_overlaps_row(table, summary);
  if (summary.has_valid_to_time_s()) {
    table.add(
        {"valid to time", quantity_text(summary.valid_to_time_s(), "s"), "", "the frame is closed from there on"});
  }
  table.add({"energy ledger error", percent_text(summary.energy_error_relative(), 2)});
  table.add({"deepest penetration", percent_text(summary.deepest_penetration()), "", "of the thinner wall"});
  std::string text = table.text(2, width);
  if (plates) text += end_text(summary, width);
  if (job.words().plates()) text += mode_text(summary, width);
  const std::string& note = job.words().theory_note();
  if (!note.empty() && plates) text += '\n' + wrapped("Note: " + printable(note), width, "  ", "  ");
  for (const v1::Warning& warning : summary.warnings()) text += '\n' + warning_text(warning, width);
  if (plates && summary.has_front()) text += '\n' + front_text(summary.front(), width);
  text += rigid_walls_text(summary, width);
  if (summary.has_ledger()) text += '\n' + ledger_text(summary.ledger(), width);
  return text;
}

}  // namespace cellcrush::client
