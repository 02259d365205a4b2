#include "lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <sstream>
#include <utility>

#include "cellcrush/lattice_words.h"
#include "lattice/network.h"

namespace cellcrush {
namespace {

const LatticeKind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(lattice_kinds(), name, [](const LatticeKind* kind) { return kind->name; });
  return found == lattice_kinds().end() ? nullptr : *found;
}

/// Those that differ from their defaults: "vertical wall thickness 0.4 mm".
std::string own_numbers_in_words(const RegularLattice& lattice, const LatticeKind& kind) {
  std::ostringstream text;
  for (const OwnNumber& number : kind.own_numbers) {
    const auto given = lattice.own.find(std::string(number.name));
    if (given == lattice.own.end() || given->second == number.default_value(lattice)) continue;
    const std::size_t unit = number.name.rfind('_');
    std::string name(number.name.substr(0, unit));
    std::ranges::replace(name, '_', ' ');
    text << (text.tellp() > 0 ? ", " : "") << name << ' ' << given->second << ' ' << number.name.substr(unit + 1);
  }
  return text.str();
}

/// The walls whose lengths and angles to the crush are known; empty if they are not looked at. The spec is not checked
/// yet.
std::vector<Vector2> known_walls(const SceneSpec& spec) {
  if (const LatticeKind* kind = kind_of(spec)) {
    return kind->walls_of_cell == nullptr ? std::vector<Vector2>() : kind->walls_of_cell(*regular_lattice_of(spec));
  }
  std::vector<Vector2> walls;
  const auto* network = std::get_if<NetworkWalls>(&spec.lattice);
  for (std::size_t wall = 0; network != nullptr && wall < network->wall_count(); ++wall) {
    const auto joint = [&](std::size_t end) { return static_cast<std::size_t>(network->walls[2 * wall + end]); };
    if (std::max(joint(0), joint(1)) >= network->joint_count()) continue;
    const auto place = [&](std::size_t end) {
      return Vector2(network->joints_mm[2 * joint(end)], network->joints_mm[2 * joint(end) + 1]);
    };
    walls.push_back(place(1) - place(0));
  }
  return walls;
}

/// Whether more than a quarter of the length of the walls lies within 15 degrees of the crush.
bool has_long_walls_along_crush(const SceneSpec& spec) {
  constexpr double kAlong = 0.259;  // sine of 15 degrees
  constexpr double kShare = 0.25;
  const double turn = -spec.changes.rotation_degrees * std::numbers::pi / 180.0;
  const Vector2 turned = {std::cos(turn), std::sin(turn)};
  const Vector2 crush = spec.loading.direction == LoadingSpec::Direction::x ? turned : normal_of(turned);
  double all = 0.0;
  double along = 0.0;
  for (const Vector2& wall : known_walls(spec)) {
    const double length = wall.norm();
    all += length;
    if (std::abs(cross(crush, wall)) < kAlong * length) along += length;
  }
  return along > kShare * all;
}

/// Thickness of the walls, the mean where they differ; not a number where it is not given.
double thickness_of(const SceneSpec& spec) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (const auto* lattice = regular_lattice_of(spec)) return lattice->wall_thickness_mm.value_or(kNone);
  if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) {
    const double of_density =
        0.5 * std::numbers::sqrt3 * voronoi->relative_density.value_or(kNone) * voronoi->side_mm.value_or(kNone);
    return voronoi->wall_thickness_mm.value_or(of_density);
  }
  const auto* network = std::get_if<NetworkWalls>(&spec.lattice);
  if (network == nullptr) return kNone;
  const std::vector<double>& all = network->thicknesses_mm;
  if (all.empty()) return network->wall_thickness_mm.value_or(kNone);
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

/// Mean length of the walls, of equal cells their side where no more is known. Not a number where it is not given.
double length_of_walls(const SceneSpec& spec) {
  const std::vector<Vector2> walls = known_walls(spec);
  if (walls.empty()) {
    if (const auto* lattice = regular_lattice_of(spec)) return lattice->side_mm.value_or(0.0);
    const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice);
    return voronoi == nullptr ? 0.0 : voronoi->side_mm.value_or(0.0);
  }
  double length = 0.0;
  for (const Vector2& wall : walls) length += wall.norm();
  return length / static_cast<double>(walls.size());
}

/// Length of the walls over their thickness; where one of these is not known, such that no walls are slender or stout.
double slenderness_of(const SceneSpec& spec) {
  const double ratio = length_of_walls(spec) / thickness_of(spec);
  return ratio > 0.0 ? ratio : 10.0;
}

}  // namespace

const RegularLattice* regular_lattice_of(const SceneSpec& spec) { return std::get_if<RegularLattice>(&spec.lattice); }

const LatticeKind* kind_of(const SceneSpec& spec) {
  const RegularLattice* lattice = regular_lattice_of(spec);
  return lattice == nullptr ? nullptr : find_kind(lattice->kind);
}

bool has_walls_along_crush(const SceneSpec& spec) {
  if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) return has_stacked_walls(*network);
  const LatticeKind* kind = kind_of(spec);
  return kind != nullptr && kind->has_walls_along_crush;
}

std::string path_of_lattice(const SceneSpec& spec) {
  const RegularLattice* lattice = regular_lattice_of(spec);
  return lattice == nullptr ? "lattice." : "lattice." + lattice->kind + ".";
}

RegularLattice with_own_numbers(RegularLattice lattice) {
  for (const OwnNumber& number : find_kind(lattice.kind)->own_numbers) {
    lattice.own.try_emplace(std::string(number.name), number.default_value(lattice));
  }
  return lattice;
}

double own_number(const RegularLattice& lattice, std::string_view name) {
  const auto given = lattice.own.find(std::string(name));
  if (given != lattice.own.end()) return given->second;
  return std::ranges::find(find_kind(lattice.kind)->own_numbers, name, &OwnNumber::name)->default_value(lattice);
}

bool is_fast_crush(const SceneSpec& spec) { return spec.loading.speed_m_per_s.value_or(0.0) > kSlowCrush; }

DefaultMesh mesh_of(const LatticeKind& kind, const SceneSpec& spec) {
  if (kind.mesh != nullptr) return kind.mesh(spec);
  return kind.has_walls_along_crush ? mesh_of_stacked_walls(spec, kind.plural)
                                    : mesh_of_bent_walls(spec, std::string(kind.plural));
}

DefaultMesh mesh_of_bent_walls(const SceneSpec& spec, std::string of_what) {
  constexpr double kStout = 8.0;
  constexpr double kSlender = 13.0;
  constexpr double kVerySlender = 17.0;
  constexpr double kQuasiStatic = 10.0;  // m/s
  const double slenderness = slenderness_of(spec);
  const int draft = is_fast_crush(spec) ? 2 : 1;
  if (is_fast_crush(spec) && has_long_walls_along_crush(spec)) {
    return {draft, 8, 16, of_what + " with walls along the crush, faster than 25 m/s"};
  }
  if (slenderness <= kStout) return {draft, 4, 8, of_what + " with walls at most 8 times as long as thick"};
  if (slenderness < kSlender || spec.loading.speed_m_per_s.value_or(0.0) <= kQuasiStatic) {
    return {draft, 2, 8, std::move(of_what)};
  }
  if (slenderness < kVerySlender) {
    return {draft, 4, 8, of_what + " with walls 13 to 17 times as long as thick, faster than 10 m/s"};
  }
  return {draft, 8, 16, of_what + " with walls at least 17 times as long as thick, faster than 10 m/s"};
}

DefaultMesh mesh_of_stacked_walls(const SceneSpec& spec, std::string_view plural) {
  constexpr double kStout = 12.0;
  const std::string words = std::string(plural) + ", whose walls along the crush buckle in short waves";
  if (slenderness_of(spec) <= kStout) return {4, 8, 16, words + ", at most 12 times as long as thick"};
  return {8, 16, 32, words};
}

std::string note_of_stretched_walls(const std::string& plural) {
  return plural +
         " are stretch-dominated: the quasi-static stress is the axial yield stress of straight walls, an upper bound. "
         "If the walls buckle, the lattice crushes at a far lower stress. Then neither the quasi-static stress nor "
         "Eq. 51, which builds on it, predicts the plateau.";
}

std::string note_of_turning_walls(const std::string& measured) {
  return "The quasi-static stress is that at which the walls of an endless lattice begin to turn. Plateaus of 8 x 8 "
         "cells were " +
         measured + " of it.";
}

LatticeWords words_of(const RegularLattice& lattice) {
  const LatticeKind* kind = find_kind(lattice.kind);
  if (kind == nullptr) {
    return {};
  }
  return {std::string(kind->plural), own_numbers_in_words(lattice, *kind),
          kind->theory_note == nullptr ? "" : kind->theory_note(lattice)};
}

std::vector<std::string> lattice_names() {
  std::vector<std::string> names;
  for (const LatticeKind* kind : lattice_kinds()) {
    names.emplace_back(kind->name);
  }
  return names;
}

}  // namespace cellcrush
