#include "lattice/lattice.h"

#include <algorithm>

#include "cellcrush/lattice_words.h"
#include "lattice/network.h"

namespace cellcrush {
namespace {

const LatticeKind* find_kind(std::string_view name) {
  const auto found = std::ranges::find(lattice_kinds(), name, [](const LatticeKind* kind) { return kind->name; });
  return found == lattice_kinds().end() ? nullptr : *found;
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

void complete_own_numbers(RegularLattice& lattice) {
  for (const OwnNumber& number : find_kind(lattice.kind)->own_numbers) {
    lattice.own.try_emplace(std::string(number.name), number.default_value(lattice));
  }
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

LatticeWords words_of(const RegularLattice& lattice) {
  const LatticeKind* kind = find_kind(lattice.kind);
  if (kind == nullptr) {
    return {};
  }
  return {std::string(kind->plural), kind->walls_in_words ? kind->walls_in_words(lattice) : "", kind->theory_note};
}

std::vector<std::string> lattice_names() {
  std::vector<std::string> names;
  for (const LatticeKind* kind : lattice_kinds()) {
    names.emplace_back(kind->name);
  }
  return names;
}

}  // namespace cellcrush
