#include "cellcrush/fidelity.h"

#include <algorithm>
#include <string>
#include <vector>

#include "lattice/lattice.h"
#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

using Fidelity = NumericsSpec::Fidelity;

bool is_force_based(const SceneSpec& spec) { return spec.section.formulation == SectionSpec::Formulation::force_based; }

/// That of the lattice. The elements of the paper keep the paper's mesh, and a frame has it if it gives none.
DefaultMesh default_mesh_of(const SceneSpec& spec) {
  const LatticeKind* kind = kind_of(spec);
  if (!is_force_based(spec)) return {is_fast_crush(spec) ? 2 : 1, 2, 8, {}};
  if (kind != nullptr) return mesh_of(*kind, spec);
  if (std::holds_alternative<VoronoiWalls>(spec.lattice)) return mesh_of_bent_walls(spec, "Voronoi honeycombs");
  if (!std::holds_alternative<NetworkWalls>(spec.lattice)) return mesh_of_bent_walls(spec, "");
  return has_walls_along_crush(spec) ? mesh_of_stacked_walls(spec, "networks with more than three walls at a joint")
                                     : mesh_of_bent_walls(spec, "networks with at most three walls at a joint");
}

FidelityPoint point_of(const SceneSpec& spec) {
  const std::vector<FidelityPoint> points = fidelity_points(spec);
  const auto found = std::ranges::find(points, spec.numerics.fidelity, &FidelityPoint::fidelity);
  return found == points.end() ? points[1] : *found;
}

}  // namespace

// The number of elements per wall trades time for accuracy at every speed, so it is all that a fidelity sets.
std::vector<FidelityPoint> fidelity_points(const SceneSpec& spec) {
  const DefaultMesh mesh = default_mesh_of(spec);
  return {{Fidelity::draft, "DRAFT", mesh.draft},
          {Fidelity::standard, "STANDARD", mesh.standard},
          {Fidelity::reference, "REFERENCE", mesh.reference}};
}

SceneSpec fill_in_fidelity(const SceneSpec& spec) {
  SceneSpec filled = spec;
  filled.elements_per_wall = spec.elements_per_wall.value_or(point_of(spec).elements_per_wall);
  return filled;
}

std::string describe_fidelity(const SceneSpec& spec) {
  if (std::holds_alternative<FrameWalls>(spec.lattice)) return {};
  const FidelityPoint point = point_of(spec);
  const bool names_one = spec.numerics.fidelity != Fidelity::unspecified;
  if (spec.elements_per_wall) {
    return names_one ? "Fidelity " + point.name + ": no effect, as elements_per_wall is given explicitly." : "";
  }
  const std::string mesh = "Mesh: elements_per_wall is " + std::to_string(point.elements_per_wall) + ", " + point.name;
  return mesh + (is_force_based(spec) ? " for " + default_mesh_of(spec).of_what + "."
                                      : "; its error is not known for displacement-based elements.");
}

}  // namespace cellcrush
