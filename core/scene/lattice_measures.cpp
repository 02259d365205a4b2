#include "scene/lattice_measures.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "scene/lattice_overlap.h"
#include "scene/masses.h"
#include "scene/stable_step.h"

namespace cellcrush {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

using CountByKind = std::array<std::size_t, kWallKinds>;

CountByKind count_walls(const LatticePattern& pattern) {
  CountByKind count = {};
  for (const LatticePattern::Wall& wall : pattern.walls) {
    ++count[wall.kind];
  }
  return count;
}

/// What follows from how many walls of each kind there are.
struct MeshCount {
  std::size_t elements = 0;
  std::size_t particles = 0;
  double thinnest = kInfinite;  // mm
  double thickest = 0.0;        // mm
};

MeshCount count_mesh(std::size_t joints, const CountByKind& walls, const LatticeSizes& sizes) {
  MeshCount count;
  count.particles = joints;
  for (int kind = 0; kind < kWallKinds; ++kind) {
    const std::size_t parts = is_rigid(sizes, kind) ? 1 : sizes.elements_per_wall;
    count.elements += parts * walls[kind];
    count.particles += (parts - 1) * walls[kind];
    if (walls[kind] > 0) {
      count.thinnest = std::min(count.thinnest, sizes.thickness[kind]);
      count.thickest = std::max(count.thickest, sizes.thickness[kind]);
    }
  }
  return count;
}

/// The stable step grows with the length of an element, in the last bit too: of each kind the shortest has the least.
void measure_steps(const LatticeLengths& lengths, const LatticeSizes& sizes, const MassScaling& scaling,
                   MeshMeasures& measures) {
  measures.stable_step = kInfinite;
  measures.shortest_element = kInfinite;
  for (int kind = 0; kind < kWallKinds; ++kind) {
    const double length = lengths.shortest[kind] / sizes.elements_per_wall;
    if (length < kInfinite) {
      measures.shortest_element = std::min(measures.shortest_element, length);
      measures.stable_step = std::min(
          measures.stable_step, stable_step_of_element(length, sizes.thickness[kind], measures.material, scaling));
    }
  }
}

double lightest_mass_of(const LatticeLengths& lengths, const ByWallKind& thickness, const Material& material,
                        double depth, double mass_scaling) {
  double lightest = kInfinite;
  for (const ParticleLengths& particle : lengths.light) {
    double mass = 0.0;
    for (int i = 0; i < particle.count; ++i) {
      mass += mass_scaling * half_mass_of(material, depth, thickness[particle.kind[i]], particle.length[i]);
    }
    lightest = std::min(lightest, mass);
  }
  return lightest;
}

}  // namespace

struct LatticeMeasurer::KnownPattern {
  LatticeShape shape;
  bool rigid = false;
  int elements_per_wall = 0;
  LatticePattern pattern;
  CountByKind walls = {};
  JointWalls light_joints;
};

struct LatticeMeasurer::KnownLengths {
  double side = 0.0;
  Imperfection imperfection;
  LatticeLengths lengths;
};

LatticeMeasurer::LatticeMeasurer() = default;
LatticeMeasurer::~LatticeMeasurer() = default;

std::optional<MeshMeasures> LatticeMeasurer::measure(const SceneSpec& part) {
  const auto lattice = regular_lattice_of(part);
  if (!lattice) {
    return std::nullopt;
  }
  const KnownPattern& known = pattern_of(*lattice);
  const MeshCount count = count_mesh(known.pattern.joints.size(), known.walls, lattice->sizes);
  if (!is_free_of_overlap(*lattice, count.thickest, part.imperfection.amplitude_mm, count.particles, count.elements)) {
    return std::nullopt;
  }
  const LatticeLengths& lengths = lengths_of(*lattice, part.imperfection);
  const MassScaling scaling = {part.numerics.mass_scaling, part.numerics.rotary_scaling};
  MeshMeasures measures;
  measures.particle_count = count.particles;
  measures.element_count = count.elements;
  measures.length = envelope_of(*lattice)[crush_axis_of(part)];
  measures.material = material_of(part.material);
  measures.hardening = measures.material.hardening_modulus > 0.0;
  measure_steps(lengths, lattice->sizes, scaling, measures);
  measures.lightest_mass =
      lightest_mass_of(lengths, lattice->sizes.thickness, measures.material, *part.depth_mm, scaling.mass);
  measures.thinnest_wall = count.thinnest;
  measures.contact = true;
  return measures;
}

const LatticeMeasurer::KnownPattern& LatticeMeasurer::pattern_of(const RegularLattice& lattice) {
  const LatticeSizes& sizes = lattice.sizes;
  if (!pattern_ || pattern_->shape != lattice.shape || pattern_->rigid != sizes.rigid ||
      pattern_->elements_per_wall != sizes.elements_per_wall) {
    lengths_.reset();
    LatticePattern pattern = cellcrush::pattern_of(lattice.shape);
    const CountByKind walls = count_walls(pattern);
    JointWalls joints = find_light_joints(pattern, sizes);
    pattern_ = std::make_unique<KnownPattern>(KnownPattern{lattice.shape, sizes.rigid, sizes.elements_per_wall,
                                                           std::move(pattern), walls, std::move(joints)});
  }
  return *pattern_;
}

const LatticeLengths& LatticeMeasurer::lengths_of(const RegularLattice& lattice, const Imperfection& imperfection) {
  if (!lengths_ || lengths_->side != lattice.sizes.side || lengths_->imperfection != imperfection) {
    const KnownPattern& known = pattern_of(lattice);
    lengths_ = std::make_unique<KnownLengths>(KnownLengths{
        lattice.sizes.side, imperfection, measure_lengths(known.pattern, known.light_joints, lattice, imperfection)});
  }
  return lengths_->lengths;
}

}  // namespace cellcrush
