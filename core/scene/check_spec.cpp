#include "scene/check_spec.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "contact/topology/initial_overlap.h"
#include "lattice/lattice.h"
#include "lattice/period.h"
#include "lattice/voronoi.h"
#include "push/half_planes.h"
#include "scene/grips.h"
#include "scene/mesh_part.h"
#include "scene/repeat_mesh.h"
#include "scene/rigid_links.h"
#include "scene/unit_sets.h"

namespace cellcrush {
namespace {

/// Checks the fields common to all regular lattices. Returns the side, mm; an endless one if it is not valid.
double check_regular(const SceneSpec& spec, const RegularLattice& lattice, FieldChecker& check) {
  const std::string path = path_of_lattice(spec);
  const bool columns = check.within_limits(path + "columns", lattice.columns);
  const bool rows = check.within_limits(path + "rows", lattice.rows);
  const bool is_sound = check.within_limits(path + "side_mm", lattice.side_mm);
  const double side = is_sound ? *lattice.side_mm : std::numeric_limits<double>::infinity();
  check.in_range(path + "wall_thickness_mm", lattice.wall_thickness_mm, {1e-6, 0.5 * side}, unit_of_share(0.5, side));
  if (columns && rows) {
    const double elements = count_elements(spec);
    if (elements > kMostElements) {
      check.add(path + "columns", std::to_string(*lattice.columns),
                "makes about " + to_text(std::round(elements)) + " elements with the rows and elements_per_wall given.",
                "Keep columns x rows x " + to_text(kind_of(spec)->walls_per_cell) +
                    " x elements_per_wall at or below " + to_text(kMostElements) + ".");
    }
  }
  return side;
}

/// Checks the numbers that only one kind of lattice has. `side`: mm, endless if it is not valid.
bool check_own_numbers(const RegularLattice& lattice, const LatticeKind& kind, double side, FieldChecker& check) {
  bool are_sound = true;
  for (const OwnNumber& number : kind.own_numbers) {
    const auto given = lattice.own.find(std::string(number.name));
    if (given == lattice.own.end()) continue;
    const std::string field = "lattice." + lattice.kind + "." + given->first;
    are_sound &= number.most_of_side == 0.0 ? check.within_limits(field, given->second)
                                            : check.in_range(field, given->second, {1e-6, number.most_of_side * side},
                                                             unit_of_share(number.most_of_side, side));
  }
  return are_sound;
}

/// Checks that all walls are at least twice as long as thick. Returns the length of the shortest one, mm.
/// REQUIRES: a lattice without problems but for this one.
double check_wall_lengths(const SceneSpec& spec, FieldChecker& check) {
  SceneSpec few = spec;
  auto& cells = std::get<RegularLattice>(few.lattice);
  cells.columns = std::min(2, *cells.columns);
  cells.rows = std::min(2, *cells.rows);
  few.inclusions = {};
  const Layout layout = kind_of(few)->lay_out(few);
  double shortest = std::numeric_limits<double>::infinity();
  double thickest = 0.0;  // over half of its length
  for (const LayoutWall& wall : layout.walls) {
    const double length = (layout.joints[wall.end] - layout.joints[wall.start]).norm();
    shortest = std::min(shortest, length);
    thickest = std::max(thickest, wall.thickness / (0.5 * length));
  }
  if (thickest > 1.0 + 1e-9) {
    const double most = *cells.wall_thickness_mm / thickest;
    check.add(path_of_lattice(spec) + "wall_thickness_mm", to_text(*cells.wall_thickness_mm),
              "makes walls thicker than half of their length, " + to_text(shortest) + " mm of the shortest.",
              "Give at most " + to_text(most) + ".");
  }
  return shortest;
}

/// `length`: of a wall, the shortest one, called so.
void check_imperfection(const SceneSpec& spec, double length, const std::string& name, FieldChecker& check) {
  const auto unit = [&](const char* share) {
    return std::isfinite(length) ? " mm (" + (share + name) + ")" : std::string(" mm");
  };
  check.in_range("lattice.imperfection.amplitude_mm", spec.imperfection.amplitude_mm, {0.0, 0.1 * length},
                 unit("a tenth of "));
  check.in_range("lattice.imperfection.bow_mm", spec.imperfection.bow_mm, {0.0, 0.05 * length},
                 unit("a twentieth of "));
  if (spec.imperfection.bow_mm > 0.0 && *spec.elements_per_wall == 1) {
    check.add("lattice.imperfection.bow_mm", to_text(spec.imperfection.bow_mm),
              "cannot be shown by one straight element per wall.", "Use an elements_per_wall of at least 2.");
  }
}

void check_no_imperfection(const Imperfection& imperfection, FieldChecker& check) {
  if (imperfection.amplitude_mm != 0.0) {
    check.add("lattice.imperfection.amplitude_mm", to_text(imperfection.amplitude_mm),
              "applies to regular lattices only, not to a frame.", "Remove it, and move the frame's nodes instead.");
  }
  if (imperfection.bow_mm != 0.0) {
    check.add("lattice.imperfection.bow_mm", to_text(imperfection.bow_mm),
              "applies to regular lattices only, not to a frame.", "Remove it, and give bowed beams nodes between.");
  }
}

/// The kinds of which `is_meant` holds, in a sentence: with `before` each.
template <class Predicate>
std::string list_kinds(const char* before, std::string_view LatticeKind::*word, const Predicate& is_meant) {
  std::string list;
  for (const LatticeKind* kind : lattice_kinds()) {
    if (is_meant(*kind)) list += (list.empty() ? "" : ", ") + std::string(before) + std::string(kind->*word);
  }
  return list;
}

void check_lattice(const SceneSpec& spec, FieldChecker& check) {
  const LatticeKind* kind = kind_of(spec);
  if (kind != nullptr) {
    const RegularLattice& lattice = *regular_lattice_of(spec);
    const double side = check_regular(spec, lattice, check);
    const bool are_sound = check_own_numbers(lattice, *kind, side, check);
    if (are_sound && kind->check != nullptr) kind->check(spec, side, check);
    const double shortest = check.is_empty() ? check_wall_lengths(spec, check) : side;
    const bool is_side = !(shortest < (1.0 - 1e-9) * side);
    check_imperfection(spec, is_side ? side : shortest, is_side ? "side_mm" : "the shortest wall", check);
  } else if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    check_network(spec, check);
    check_imperfection(spec, shortest_wall_of(*network), "the shortest wall", check);
  } else if (std::holds_alternative<VoronoiWalls>(spec.lattice)) {
    check_imperfection(spec, check_voronoi(spec, check), "side_mm", check);
  } else if (std::holds_alternative<FrameWalls>(spec.lattice)) {
    check_frame(spec, check);
    check_no_imperfection(spec.imperfection, check);
  } else {
    check.add("lattice", "", "is missing.",
              "Give one of " + list_kinds("lattice.", &LatticeKind::name, [](const LatticeKind&) { return true; }) +
                  ", lattice.voronoi, lattice.network, lattice.frame.");
  }
  check_changes(spec, check);
  if ((kind == nullptr || !kind->has_rows_of_cells) && !spec.inclusions.rows.empty()) {
    const auto has_rows = [](const LatticeKind& other) { return other.has_rows_of_cells; };
    check.add("lattice.inclusions.rows", std::to_string(spec.inclusions.rows.size()) + " rows",
              "apply to " + list_kinds("", &LatticeKind::plural, has_rows) + " only.",
              "Remove them, or use " + list_kinds("lattice.", &LatticeKind::name, has_rows) + ".");
  }
}

/// A quasi-static crush has the speed, the ramp and the end that the solver chooses, and real masses.
void check_quasi_static(const SceneSpec& spec, FieldChecker& check) {
  const LoadingSpec& loading = spec.loading;
  const bool is_sound = check.within_limits("loading.kinetic_share", loading.kinetic_share);
  if (is_sound && !loading.quasi_static && loading.kinetic_share != LoadingSpec().kinetic_share) {
    check.add("loading.kinetic_share", to_text(loading.kinetic_share), "is that of a quasi-static crush.",
              "Set loading.quasi_static, or remove it.");
  }
  if (!loading.quasi_static) return;
  const auto exclude = [&check](bool is_given, const char* field, double value) {
    if (is_given) {
      check.add(field, to_text(value), "does not go with loading.quasi_static, which chooses speed and masses.",
                "Remove it, or loading.quasi_static.");
    }
  };
  exclude(loading.speed_m_per_s.has_value(), "loading.speed_m_per_s", loading.speed_m_per_s.value_or(0.0));
  exclude(loading.ramp_strain != 0.0, "loading.ramp_strain", loading.ramp_strain);
  exclude(loading.end_time_s.has_value(), "loading.end_time_s", loading.end_time_s.value_or(0.0));
  exclude(spec.numerics.mass_scaling != 1.0, "numerics.mass_scaling", spec.numerics.mass_scaling);
  if (std::ranges::any_of(material_specs_of(spec), &LawParameters::depends_on_rate)) {
    check.add("loading.quasi_static", "true",
              "does not go with a yield stress that depends on the rate: the solver chooses the speed.",
              "Give loading.speed_m_per_s, or the yield stress at the rate of the test without a law of the rate.");
  }
}

void check_plates(const LoadingSpec& loading, FieldChecker& check) {
  if (!loading.quasi_static) check.within_limits("loading.speed_m_per_s", loading.speed_m_per_s);
  const double end = loading.end_strain.value_or(LoadingSpec::kDefaultEndStrain);
  const bool ends = check.within_limits("loading.end_strain", end);
  const double latest = ends ? end : FieldChecker::greatest_of("loading.end_strain");
  check.in_range("loading.ramp_strain", loading.ramp_strain, {.low = 0.0, .high = latest, .high_open = true},
                 " (end_strain)");
}

void check_sides(const SceneSpec& spec, FieldChecker& check) {
  const LoadingSpec::Sides& sides = spec.loading.sides;
  if (check.within_limits("loading.sides.friction", sides.friction) && sides.friction > 0.0 &&
      sides.kind != LoadingSpec::Sides::Kind::rigid) {
    check.add("loading.sides.friction", to_text(sides.friction), "is that of side walls, but there are none.",
              "Set loading.sides.kind to RIGID, or remove it.");
  }
  const bool is_periodic = sides.kind == LoadingSpec::Sides::Kind::periodic;
  if (is_periodic && std::ranges::any_of(material_specs_of(spec), &LawParameters::fails)) {
    check.add("material.failure_strain", to_text(spec.material.failure_strain), "does not go with sides that repeat.",
              "Leave it out, or set loading.sides.kind to FREE or RIGID.");
  }
  if (sides.fixed_width && !is_periodic) {
    check.add("loading.sides.fixed_width", "true", "is of sides that repeat, but these do not.",
              "Set loading.sides.kind to PERIODIC, or remove it.");
  }
  if (sides.period_mm && !is_periodic && check.within_limits("loading.sides.period_mm", sides.period_mm)) {
    check.add("loading.sides.period_mm", to_text(*sides.period_mm), "is of sides that repeat, but these do not.",
              "Set loading.sides.kind to PERIODIC, or remove it.");
  }
  if (is_periodic && check.is_empty()) check_period(spec, check);
}

/// A run has plates or an end time. Of what has neither, a frame lacks the time, and all else the plates.
void check_loading(const SceneSpec& spec, FieldChecker& check) {
  const LoadingSpec& loading = spec.loading;
  if (has_plates(spec) || (!loading.end_time_s && !std::holds_alternative<FrameWalls>(spec.lattice))) {
    check_quasi_static(spec, check);
    check_plates(loading, check);
  } else if (!loading.end_time_s) {
    check.within_limits("loading.end_time_s", {});
  }
  if (!has_plates(spec) && loading.end_time_s && loading.end_strain) {
    if (has_crushing_walls(spec.loads.rigid_walls)) {
      check.within_limits("loading.end_strain", loading.end_strain);
    } else {
      check.add("loading.end_strain", to_text(*loading.end_strain), "is that of a crush, but nothing crushes.",
                "Remove it, or give loading.speed_m_per_s or rigid walls in place of the plates.");
    }
  }
  if (loading.end_time_s) {
    check.within_limits("loading.end_time_s", loading.end_time_s);
  }
  check.within_limits("loading.end_at_rest", loading.end_at_rest, " (0: it does not end at rest)");
  check.within_limits("loading.gravity_x_m_per_s2", spec.loads.gravity_x_m_per_s2);
  check.within_limits("loading.gravity_y_m_per_s2", spec.loads.gravity_y_m_per_s2);
  check.within_limits("loading.velocity_x_m_per_s", spec.loads.velocity_x_m_per_s);
  check.within_limits("loading.velocity_y_m_per_s", spec.loads.velocity_y_m_per_s);
  check_half_planes(spec, check);
  check_sides(spec, check);
  check_grips(spec, check);
}

/// A mass that meets the lattice, or a lattice in flight, exchanges momentum: fictitious masses would change it. They
/// have weight, too.
void check_real_masses(const SceneSpec& spec, FieldChecker& check) {
  const bool strikes = std::ranges::any_of(
      spec.loads.rigid_walls, [](const LoadsSpec::RigidWall& wall) { return wall.own.contains("mass_g"); });
  const bool flies = spec.loads.velocity_x_m_per_s != 0.0 || spec.loads.velocity_y_m_per_s != 0.0;
  const bool weighs = spec.loads.gravity_x_m_per_s2 != 0.0 || spec.loads.gravity_y_m_per_s2 != 0.0;
  if (spec.numerics.mass_scaling != 1.0 && (strikes || flies || weighs)) {
    check.add("numerics.mass_scaling", to_text(spec.numerics.mass_scaling),
              strikes ? "makes the lattice heavier than it is for the rigid wall with a mass that meets it."
              : flies ? "gives the lattice more kinetic energy than its real mass has."
                      : "makes the lattice heavier under gravity than it is.",
              "Set it to 1.");
  }
}

void check_numerics(const NumericsSpec& numerics, FieldChecker& check) {
  check.within_limits("numerics.time_step_s", numerics.time_step_s, " (0: automatic)");
  check.within_limits("numerics.mass_damping_per_s", numerics.mass_damping_per_s);
  check.within_limits("numerics.mass_scaling", numerics.mass_scaling, " (1: real masses)");
  check.within_limits("numerics.rotary_scaling", numerics.rotary_scaling, " (1: real inertias)");
  check.within_limits("numerics.rigid_link_slenderness", numerics.rigid_link_slenderness, " (0: no rigid links)");
  check.within_limits("numerics.threads", numerics.threads);
}

std::string place_text(const Vector2& place) { return "(" + to_text(place.x()) + ", " + to_text(place.y()) + ") mm"; }

std::string field_of_beam(int beam) { return "lattice.frame.beams[" + std::to_string(beam) + "]"; }

/// The walls that cross, each pair once.
Problems name_crossings(const SceneSpec& spec, const Scene& scene, const std::vector<InitialCrossing>& crossings) {
  const bool is_network = std::holds_alternative<NetworkWalls>(spec.lattice);
  std::set<std::pair<int, int>> named;
  Problems problems;
  for (const InitialCrossing& crossing : crossings) {
    const auto [one, other] =
        std::minmax({listed_wall_of(scene, crossing.first), listed_wall_of(scene, crossing.second)});
    if (!named.emplace(one, other).second) continue;
    const std::string place = " before loading, at " + place_text(crossing.place) + ".";
    if (is_network) {
      problems.push_back({"lattice.network.walls[" + std::to_string(2 * other) + "]", "",
                          "begins wall " + std::to_string(other) + ", whose mid-line meets that of wall " +
                              std::to_string(one) + " without a joint" + place,
                          "Divide both walls at a joint there, or move their joints apart."});
    } else {
      problems.push_back({field_of_beam(other), "", "crosses " + field_of_beam(one) + " without a node" + place,
                          "Connect the beams at a node there, move their nodes apart, or set "
                          "lattice.frame.self_contact to false."});
    }
  }
  return problems;
}

}  // namespace

double count_elements(const SceneSpec& spec) {
  const int arms = spec.section.rigid_joints ? 2 : 0;
  const int elements_per_wall = *spec.elements_per_wall + arms;
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    return kind_of(spec)->walls_per_cell * *lattice->columns * *lattice->rows * elements_per_wall;
  }
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    return static_cast<double>(network->wall_count()) * elements_per_wall;
  }
  if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) {
    return count_elements(*voronoi, elements_per_wall);
  }
  double elements = 0.0;
  for (const FrameWalls::Beam& beam : std::get<FrameWalls>(spec.lattice).beams) {
    elements += std::max(1, beam.elements.value_or(elements_per_wall));
  }
  return elements;
}

Problems check_spec(const SceneSpec& spec) {
  FieldChecker check;
  check_lattice(spec, check);
  check.within_limits("depth_mm", spec.depth_mm);
  check.within_limits("elements_per_wall", spec.elements_per_wall);
  check_material("material.", spec.material, check);
  check_section_and_contact(spec, check);
  check.within_limits("plates.friction", spec.plates.friction);
  check_loading(spec, check);
  check_numerics(spec.numerics, check);
  check_real_masses(spec, check);
  check.within_limits("output.sample_count", spec.output.sample_count);
  check.within_limits("output.frame_count", spec.output.frame_count);
  Problems problems = check.take();
  ask_about_units_first(spec, problems);
  return problems;
}

Problems check_crossings(const SceneSpec& spec, const Scene& scene, StartOverlaps& touching) {
  constexpr std::size_t kMostCrossings = 20;  // enough to see what is wrong
  InitialOverlaps overlaps = find_initial_overlaps(scene, kMostCrossings);
  if (scene.period.repeats()) {
    const std::shared_ptr<Scene> repeated = repeat_mesh(scene);
    overlaps = find_initial_overlaps(*repeated, kMostCrossings);
    overlaps.touching = overlaps_of_balls(*repeated, overlaps.touching);
    for (InitialCrossing& crossing : overlaps.crossings) {
      crossing.first %= static_cast<int>(scene.element_count());
      crossing.second %= static_cast<int>(scene.element_count());
    }
  }
  touching = std::move(overlaps.touching);
  const bool is_regular = regular_lattice_of(spec) != nullptr;
  if (overlaps.too_dense && overlaps.crossings.empty()) {
    const bool is_network = std::holds_alternative<NetworkWalls>(spec.lattice);
    return {{is_regular   ? path_of_lattice(spec) + "wall_thickness_mm"
             : is_network ? "lattice.network.walls"
                          : "lattice.frame.beams",
             "", "are too thick or too tangled for contact: each particle has hundreds of elements within reach.",
             "Use thinner walls or longer elements."}};
  }
  if (is_regular && !overlaps.crossings.empty()) {
    return {{"lattice.imperfection.amplitude_mm", "",
             "makes walls cross before loading, first at " + place_text(overlaps.crossings.front().place) + ".",
             "Use a smaller lattice.imperfection.amplitude_mm or bow_mm."}};
  }
  return name_crossings(spec, scene, overlaps.crossings);
}

}  // namespace cellcrush
