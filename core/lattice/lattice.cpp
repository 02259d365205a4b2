#include "lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// The walls whose angles to the crush are known; empty if they are not looked at. The spec is not checked yet.
std::vector<Vector2> walls_with_angles(const SceneSpec& spec) {
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
  for (const Vector2& wall : walls_with_angles(spec)) {
    const double length = wall.norm();
    all += length;
    if (std::abs(cross(crush, wall)) < kAlong * length) along += length;
  }
  return along > kShare * all;
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
  return kind.has_walls_along_crush ? mesh_of_stacked_walls(kind.plural)
                                    : mesh_of_bent_walls(spec, std::string(kind.plural));
}

DefaultMesh mesh_of_bent_walls(const SceneSpec& spec, std::string of_what) {
  if (!is_fast_crush(spec)) return {1, 2, 8, std::move(of_what)};
  if (!has_long_walls_along_crush(spec)) return {2, 2, 8, std::move(of_what)};
  return {2, 8, 16, of_what + " with walls along the crush, faster than 25 m/s"};
}

DefaultMesh mesh_of_stacked_walls(std::string_view plural) {
  return {8, 16, 32, std::string(plural) + ", whose walls along the crush buckle in short waves"};
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
