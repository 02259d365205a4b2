#include "translate/case_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cellcrush/lattice_words.h"
#include "translate/case_to_spec.h"
#include "translate/fact_words.h"
#include "translate/loads_places.h"
#include "translate/network_lists.h"

namespace cellcrush::translate {
namespace {

std::string plural(int count, const char* noun) { return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s"); }

template <typename Values>
std::string range_text(const Values& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *low == *high ? fmt::format("{:.6g}", *low) : fmt::format("{:.6g} to {:.6g}", *low, *high);
}

std::string support_text(const v1::Frame::Support& support) {
  std::vector<const char*> held;
  if (support.fix_x()) held.push_back("x");
  if (support.fix_y()) held.push_back("y");
  if (support.fix_rotation()) held.push_back("rotation");
  return fmt::format("{} ({})", support.node(), fmt::join(held, " "));
}

const char* component_text(v1::Frame::Component component) {
  switch (component) {
    case v1::Frame::COMPONENT_X: return "x";
    case v1::Frame::COMPONENT_Y: return "y";
    case v1::Frame::COMPONENT_ROTATION: return "rotation";
    default: return "?";
  }
}

void describe_masses(const v1::Frame& frame, v1::CaseWords& words) {
  const auto has_mass = [](const v1::Frame::Node& node) {
    return node.attached_mass_g() > 0.0 || node.attached_inertia_g_mm2() > 0.0;
  };
  const auto count = std::count_if(frame.nodes().begin(), frame.nodes().end(), has_mass);
  if (count > 0) add_fact(words, "attached masses", "on " + plural(static_cast<int>(count), "node"));
}

void describe_loads(const v1::Frame& frame, v1::CaseWords& words) {
  const auto moved = [](const auto& load) {
    return fmt::format("{} ({})", load.node(), component_text(load.component()));
  };
  add_list(words, "forces and moments", frame.loads(), moved);
  add_list(words, "prescribed motion", frame.motions(), moved);
  if (frame.distributed_loads_size() > 0)
    add_fact(words, "distributed loads", plural(frame.distributed_loads_size(), "load"));
  add_list(words, "initial velocities", frame.initial_velocities(),
           [](const auto& velocity) { return velocity.node(); });
}

void describe_frame(const v1::Frame& frame, v1::CaseWords& words) {
  words.set_lattice(
      fmt::format("frame of {} and {}", plural(frame.nodes_size(), "node"), plural(frame.beams_size(), "beam")));
  if (frame.beams_size() > 0) {
    std::vector<double> thicknesses;
    for (const auto& beam : frame.beams()) thicknesses.push_back(beam.thickness_mm());
    add_fact(words, "beams", fmt::format("{}, {} mm thick", frame.beams_size(), range_text(thicknesses)));
  }
  int pins = 0;
  for (const auto& beam : frame.beams()) pins += (beam.pin_start() ? 1 : 0) + (beam.pin_end() ? 1 : 0);
  if (pins > 0) add_fact(words, "pins", plural(pins, "end") + " of beams");
  add_list(words, "supports", frame.supports(), support_text);
  if (frame.supports_size() == 0) add_fact(words, "supports", "none");
  describe_masses(frame, words);
  describe_loads(frame, words);
  add_fact(words, "contact between beams", frame.self_contact() ? "modelled" : "ignored");
  if (frame.watched_nodes_size() > 0) add_fact(words, "watched nodes", names_text(frame.watched_nodes()));
}

void describe_network(const v1::Lattice::Network& network, v1::CaseWords& words) {
  const NetworkWalls lists = lists_of(network);
  const int walls = static_cast<int>(lists.wall_count());
  words.set_lattice(fmt::format("network of {} and {}", plural(static_cast<int>(lists.joint_count()), "joint"),
                                plural(walls, "wall")));
  words.set_theory_note("The quasi-static stress of a network is not known: no theory applies.");
  std::vector<double> thicknesses = lists.thicknesses_mm;
  if (thicknesses.empty()) thicknesses.push_back(network.wall_thickness_mm());
  add_fact(words, "walls", fmt::format("{}, {} mm thick", walls, range_text(thicknesses)));
  const auto arcs = std::ranges::count_if(lists.rises_mm, [](double rise) { return rise != 0.0; });
  if (arcs > 0) add_fact(words, "arcs", plural(static_cast<int>(arcs), "wall"));
  if (network.materials_size() > 0) add_fact(words, "further materials", std::to_string(network.materials_size()));
}

void describe_voronoi(const v1::Lattice::Voronoi& voronoi, v1::CaseWords& words) {
  words.set_lattice(fmt::format("Voronoi honeycomb, {} x {} cells, irregularity {:.4g}", voronoi.columns(),
                                voronoi.rows(), voronoi.irregularity()));
  words.set_theory_note("The quasi-static stress of a Voronoi honeycomb is not known: no theory applies.");
  add_fact(
      words, "cells",
      fmt::format("{} x {}, of regular ones {:.6g} mm a side", voronoi.columns(), voronoi.rows(), voronoi.side_mm()));
  std::string nuclei = fmt::format("irregularity {:.4g}, seed {}", voronoi.irregularity(), voronoi.seed());
  if (voronoi.relaxation_steps() > 0) nuclei += ", " + plural(voronoi.relaxation_steps(), "relaxation step");
  add_fact(words, "nuclei", std::move(nuclei));
  add_fact(words, "walls",
           (voronoi.has_relative_density() ? fmt::format("relative density {:.4g}", voronoi.relative_density())
                                           : fmt::format("{:.6g} mm thick", voronoi.wall_thickness_mm())) +
               (voronoi.edge_walls() ? ", along the edges too" : ""));
}

void describe_cells(const RegularLattice& regular, v1::CaseWords& words) {
  const LatticeWords kind = words_of(regular);
  const std::string cells = fmt::format("{} x {} cells", regular.columns.value_or(0), regular.rows.value_or(0));
  words.set_lattice(fmt::format("{}, {}", kind.plural, cells));
  words.set_theory_note(kind.theory_note);
  add_fact(words, kind.plural, cells);
  add_fact(words, "walls",
           fmt::format("{:.6g} mm long, {:.6g} mm thick{}{}", regular.side_mm.value_or(0.0),
                       regular.wall_thickness_mm.value_or(0.0), kind.walls.empty() ? "" : "; ", kind.walls));
}

std::string factors_text(const char* what, const google::protobuf::RepeatedField<double>& steps,
                         const google::protobuf::RepeatedField<double>& polynomial) {
  if (steps.empty() && polynomial.empty()) return {};
  return steps.empty() ? fmt::format(", {} by the polynomial {}", what, fmt::join(polynomial, ", "))
                       : fmt::format(", {} by steps {}", what, names_text(steps));
}

// What makes other walls of those of the lattice. Its theory does not apply to them.
void describe_made_walls(const v1::Lattice& lattice, v1::CaseWords& words) {
  const auto& [defects, grading, outline] = std::tie(lattice.defects(), lattice.grading(), lattice.outline());
  const int facts = words.facts_size();
  std::string missing;
  if (defects.missing_walls() > 0.0)
    missing += fmt::format("{:.4g} % of the walls missing, ", 100.0 * defects.missing_walls());
  if (defects.thickness_scatter() > 0.0)
    missing += fmt::format("thicknesses scattered by up to {:.4g} %, ", 100.0 * defects.thickness_scatter());
  if (!missing.empty()) add_fact(words, "defects", missing + fmt::format("seed {}", defects.seed()));
  const std::string graded = factors_text("thickness", grading.thickness_steps(), grading.thickness_polynomial()) +
                             factors_text("size", grading.size_steps(), grading.size_polynomial());
  if (!graded.empty())
    add_fact(words, "grading", fmt::format("along {}{}", grading.axis() == v1::Loading::Y ? 'y' : 'x', graded));
  if (lattice.rotation_degrees() != 0.0)
    add_fact(words, "rotation", fmt::format("{:.6g} degrees", lattice.rotation_degrees()));
  if (!outline.corners_mm().empty()) {
    const int corners = outline.corners_mm_size() / 2;
    add_fact(words, "outline", corners == 2 ? "a rectangle" : fmt::format("a polygon of {} corners", corners));
  }
  if (words.facts_size() > facts && !lattice.has_network() && !lattice.has_voronoi())
    words.set_theory_note("Walls were changed: no theory applies, not even that of the unchanged lattice.");
}

void describe_changes(const v1::Lattice& lattice, v1::CaseWords& words) {
  describe_made_walls(lattice, words);
  const v1::Lattice::Imperfection& imperfection = lattice.imperfection();
  std::string offsets;
  if (imperfection.amplitude_mm() > 0.0)
    offsets += fmt::format("joints displaced by up to {:.6g} mm, ", imperfection.amplitude_mm());
  if (imperfection.bow_mm() > 0.0) offsets += fmt::format("walls bowed by up to {:.6g} mm, ", imperfection.bow_mm());
  if (!offsets.empty()) add_fact(words, "imperfection", offsets + fmt::format("seed {}", imperfection.seed()));
  const v1::Lattice::Inclusions& inclusions = lattice.inclusions();
  if (inclusions.rows_size() == 0) return;
  std::string text = fmt::format("stiff cells in row{} {}", inclusions.rows_size() == 1 ? "" : "s",
                                 fmt::join(inclusions.rows(), ", "));
  if (inclusions.has_thickness_factor())
    text += fmt::format(", walls {} times as thick", inclusions.thickness_factor());
  text += inclusions.model() == v1::Lattice::Inclusions::MESHED ? ", meshed" : ", rigid";
  add_fact(words, "inclusions", std::move(text));
  words.set_theory_note(words.theory_note() + (words.theory_note().empty() ? "" : " ") +
                        "The theory ignores the stiff cells.");
}

std::string words_of(const HardeningTable& table) {
  constexpr const char* kBeyond[] = {"at the last stress", "at the last slope", "as a power"};
  return fmt::format(", hardening table to plastic strain {:.6g}, then {}", table.plastic_strains.back(),
                     kBeyond[static_cast<int>(table.beyond)]);
}

v1::CaseWords describe_case(const v1::Case& scene) {
  v1::CaseWords words;
  words.set_plates(has_plates(scene));
  if (scene.lattice().has_frame()) describe_frame(scene.lattice().frame(), words);
  if (scene.lattice().has_network()) describe_network(scene.lattice().network(), words);
  if (scene.lattice().has_voronoi()) describe_voronoi(scene.lattice().voronoi(), words);
  if (const auto regular = read_regular(scene.lattice())) describe_cells(*regular, words);
  describe_changes(scene.lattice(), words);
  describe_loading(loading_of(scene), words);
  if (scene.has_depth_mm()) add_fact(words, "depth", fmt::format("{} mm", scene.depth_mm()));
  if (scene.has_material()) add_fact(words, "material", material_text(scene.material()));
  if (scene.elements_per_wall() > 0) add_fact(words, mesh_words(scene), std::to_string(scene.elements_per_wall()));
  const auto add_above_zero = [&](const char* heading, double value, const char* unit) {
    if (value > 0.0) add_fact(words, heading, fmt::format("{}{}", value, unit));
  };
  add_above_zero("friction between walls", scene.contact().friction(), "");
  add_above_zero("friction at the plates", scene.plates().friction(), "");
  add_above_zero("mass damping", scene.numerics().mass_damping_per_s(), " 1/s");
  return words;
}

const char* words_of(v1::Summary::CrushMode mode) {
  switch (mode) {
    case v1::Summary::CRUSH_MODE_NONE: return "none (too few cells have collapsed)";
    case v1::Summary::CRUSH_MODE_X: return "crossed bands (X)";
    case v1::Summary::CRUSH_MODE_V: return "V-shaped band (V)";
    case v1::Summary::CRUSH_MODE_I: return "layer by layer (I)";
    case v1::Summary::CRUSH_MODE_C: return "curved band (C)";
    case v1::Summary::CRUSH_MODE_MIXED: return "mixed";
    default: return "";
  }
}

const char* words_of(v1::Summary::OtherRise rise) {
  switch (rise) {
    case v1::Summary::OTHER_RISE_HARDENING: return "hardening of the walls";
    case v1::Summary::OTHER_RISE_SECOND_COLLAPSE: return "second collapse";
    case v1::Summary::OTHER_RISE_STIFFENING: return "stiffening of the lattice";
    default: return "";
  }
}

std::string end_words_of(const v1::Summary& summary) {
  switch (summary.end()) {
    case v1::Summary::END_STRAIN: return "at the end strain";
    case v1::Summary::END_CLOSED:
      return fmt::format("at strain {:.3f}, where the lattice is closed", summary.valid_to_strain());
    case v1::Summary::END_TIME: return "at the end time";
    case v1::Summary::END_AT_REST: return "at rest";
    default: return "";
  }
}

}  // namespace

std::string material_text(const v1::Material& material) {
  Problems ignored;
  const MaterialSpec law = to_spec(material, "", ignored);
  std::string text = material.named().empty() ? "" : material.named() + ": ";
  text += fmt::format("E {:.6g} MPa, yield {:.6g} MPa", law.youngs_modulus_mpa.value_or(0.0),
                      law.yield_stress_mpa.value_or(0.0));
  for (const LawParameter& parameter : kLawParameters) {
    if (const double value = law.*parameter.value; value != LawParameters().*parameter.value)
      text += ", " + fmt::format(fmt::runtime(parameter.words), value);
  }
  if (!law.hardening_table.plastic_strains.empty()) text += words_of(law.hardening_table);
  if (!law.rate_table.rates_per_s.empty()) {
    text += fmt::format(", rate table from {:.6g} to {:.6g} 1/s", law.rate_table.rates_per_s.front(),
                        law.rate_table.rates_per_s.back());
  }
  text += fmt::format(", {} kg/m3", law.density_kg_per_m3.value_or(0.0));
  return text + (law.plane == MaterialSpec::Plane::strain  ? ", plane strain"
                 : law.plane == MaterialSpec::Plane::strip ? ", strip"
                                                           : "");
}

bool has_plates(const v1::Case& scene) { return scene.loading().has_speed_m_per_s() || scene.loading().quasi_static(); }

std::string mesh_words(const v1::Case& scene) {
  return scene.lattice().has_frame() ? "elements per beam" : "elements per wall";
}

void add_words(v1::CheckCaseResponse& check) {
  if (check.has_completed_case()) *check.mutable_words() = describe_case(check.completed_case());
}

void add_words(v1::Job& job) {
  if (job.has_case_()) *job.mutable_words() = describe_case(job.case_());
  if (!job.has_summary()) return;
  v1::Summary& summary = *job.mutable_summary();
  summary.set_crush_mode_words(words_of(summary.crush_mode()));
  summary.set_end_words(end_words_of(summary));
  summary.set_other_rise_words(words_of(summary.other_rise()));
}

void add_words(v1::ListJobsResponse& jobs) {
  for (auto& job : *jobs.mutable_jobs()) {
    add_words(job);
    if (job.has_words()) job.mutable_words()->clear_facts();
  }
}

void add_words(v1::Sweep& sweep) {
  if (!sweep.has_case_()) return;
  *sweep.mutable_words() = describe_case(sweep.case_());
  sweep.mutable_words()->clear_facts();
}

void add_words(v1::ListSweepsResponse& sweeps) {
  for (auto& sweep : *sweeps.mutable_sweeps()) add_words(sweep);
}

void add_words(v1::SweepTable& table) {
  for (auto& row : *table.mutable_rows()) add_words(*row.mutable_result());
  for (auto& means : *table.mutable_means()) {
    for (auto& counted : *means.mutable_crush_modes()) counted.set_words(words_of(counted.mode()));
  }
}

void add_words(v1::JobEvent& event) {
  if (event.has_snapshot()) add_words(*event.mutable_snapshot()->mutable_job());
  if (event.has_state()) add_words(*event.mutable_state());
}

void add_words(v1::WatchJobsResponse& message) {
  if (message.has_job()) add_words(*message.mutable_job());
  if (message.has_watched()) add_words(*message.mutable_watched()->mutable_event());
}

void add_words(v1::WatchSweepResponse& message) {
  if (message.has_snapshot()) add_words(*message.mutable_snapshot());
  if (message.has_event()) add_words(*message.mutable_event());
}

}  // namespace cellcrush::translate
