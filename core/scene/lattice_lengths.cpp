#include "scene/lattice_lengths.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scene/imperfection.h"
#include "scene/mesh.h"

namespace cellcrush {
namespace {

/// What the length of an element may owe to round-off, relative to it.
constexpr double kRoundOff = 1e-7;

/// Calls visit(joint, wall, at_end) for every end of a wall in the order of the elements there (scene/mesh.h): of a block the
/// starts of its walls, then their ends; walls of one element one after another; the rigid ones last.
template <class Visit>
void visit_ends(const LatticePattern& pattern, const LatticeSizes& sizes, Visit&& visit) {
  std::vector<int> divided;
  std::vector<int> whole;
  for (int w = 0; w < static_cast<int>(pattern.walls.size()); ++w) {
    (is_rigid(sizes, pattern.walls[w].kind) ? whole : divided).push_back(w);
  }
  const std::size_t in_block = sizes.elements_per_wall == 1 ? 1 : kMostWallsInBlock;
  for (std::size_t first = 0; first < divided.size(); first += in_block) {
    const std::size_t end = std::min(first + in_block, divided.size());
    for (const bool at_end : {false, true}) {
      for (std::size_t i = first; i < end; ++i) {
        const LatticePattern::Wall& wall = pattern.walls[divided[i]];
        visit(at_end ? wall.end : wall.start, divided[i], at_end);
      }
    }
  }
  for (const int w : whole) {
    visit(pattern.walls[w].start, w, false);
    visit(pattern.walls[w].end, w, true);
  }
}

/// The particles that may be the lightest, whatever the walls' thickness.
class LightestParticles {
 public:
  void add(const ParticleLengths& particle) {
    ByWallKind sum = {};
    for (int i = 0; i < particle.count; ++i) {
      sum[particle.kind[i]] += particle.length[i];
    }
    const Entry entry = {particle, sum};
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (is_under(found_[i], entry)) {
        std::swap(found_[i], found_[i / 2]);  // what often decides is looked at early
        return;
      }
    }
    std::erase_if(found_, [&](const Entry& other) { return is_under(entry, other); });
    found_.push_back(entry);
  }

  [[nodiscard]] std::vector<ParticleLengths> take() const {
    std::vector<ParticleLengths> particles;
    for (const Entry& entry : found_) {
      particles.push_back(entry.particle);
    }
    return particles;
  }

 private:
  struct Entry {
    ParticleLengths particle;
    ByWallKind sum;  // of lengths, mm
  };

  static bool is_under(const Entry& a, const Entry& b) {
    return is_shorter(a.sum, b.sum) || is_within(a.particle, b.particle);
  }

  /// In every kind by more than round-off.
  static bool is_shorter(const ByWallKind& a, const ByWallKind& b) {
    bool shorter = true;
    for (int kind = 0; kind < kWallKinds; ++kind) {
      shorter = shorter && (1.0 + kRoundOff) * a[kind] <= b[kind];
    }
    return shorter;
  }

  /// Masses are sums of rounded products, which grow with every factor: where no element is longer, in the last bit too.
  static bool is_within(const ParticleLengths& a, const ParticleLengths& b) {
    if (a.count != b.count) {
      return false;
    }
    for (int i = 0; i < a.count; ++i) {
      if (a.kind[i] != b.kind[i] || a.length[i] > b.length[i]) {
        return false;
      }
    }
    return true;
  }

  std::vector<Entry> found_;
};

class LengthsFinder {
 public:
  LengthsFinder(const LatticePattern& pattern, const RegularLattice& lattice, const Imperfection& imperfection)
      : pattern_(pattern),
        sizes_(lattice.sizes),
        joints_(place_joints(pattern, lattice.shape.cell, lattice.sizes.side)) {
    perturb(imperfection, joints_);
    for (int part = 0; part < sizes_.elements_per_wall; ++part) {
      shares_.push_back(static_cast<double>(part) / sizes_.elements_per_wall);
    }
  }

  void find_shortest_walls() {
    lengths_.shortest.fill(std::numeric_limits<double>::infinity());
    squared_.reserve(pattern_.walls.size());
    ByWallKind least = lengths_.shortest;
    for (const LatticePattern::Wall& wall : pattern_.walls) {
      const double squared = (joints_[wall.end] - joints_[wall.start]).squaredNorm();
      squared_.push_back(squared);
      if (squared < least[wall.kind]) {  // seldom, and then not a chain through memory
        least[wall.kind] = squared;
      }
    }
    for (int kind = 0; kind < kWallKinds; ++kind) {
      if (!is_rigid(sizes_, kind)) {
        lengths_.shortest[kind] = std::sqrt(least[kind]);
      }
    }
  }

  /// Of walls of one kind, the particles inside the shortest are the lightest. In a lattice without an imperfection all walls are
  /// as long but for round-off, and squares tell which are the shorter ones without as many roots.
  void find_light_particles_in_walls() {
    std::array<std::vector<SquaredLengths>, kWallKinds> light;
    const int parts = sizes_.elements_per_wall;
    for (std::size_t w = 0; w < pattern_.walls.size() && parts > 1; ++w) {
      const LatticePattern::Wall& wall = pattern_.walls[w];
      const double shortest = lengths_.shortest[wall.kind];
      if (is_rigid(sizes_, wall.kind) || squared_[w] > (1.0 + 2.0 * kRoundOff) * shortest * shortest) {
        continue;
      }
      double before = element_span(wall, 0).squaredNorm();
      for (int part = 1; part < parts; ++part) {
        const double after = element_span(wall, part).squaredNorm();
        keep_shorter({std::min(before, after), std::max(before, after)}, light[wall.kind]);
        before = after;
      }
    }
    for (int kind = 0; kind < kWallKinds; ++kind) {
      for (const SquaredLengths& squared : light[kind]) {
        light_.add({2, {kind, kind}, {std::sqrt(squared.shorter), std::sqrt(squared.longer)}});
      }
    }
  }

  void find_light_joints(const JointWalls& joints) {
    for (std::size_t j = 0; j + 1 < joints.offset.size(); ++j) {
      ParticleLengths particle;
      for (int k = joints.offset[j]; k < joints.offset[j + 1]; ++k) {
        const LatticePattern::Wall& wall = pattern_.walls[joints.ends[k].wall];
        particle.kind[particle.count] = wall.kind;
        particle.length[particle.count] =
            element_span(wall, joints.ends[k].at_end ? elements_of(wall.kind) - 1 : 0).norm();
        ++particle.count;
      }
      light_.add(particle);
    }
  }

  LatticeLengths take() {
    lengths_.light = light_.take();
    return std::move(lengths_);
  }

 private:
  [[nodiscard]] int elements_of(int kind) const { return is_rigid(sizes_, kind) ? 1 : sizes_.elements_per_wall; }

  /// Of the elements at a particle inside a wall, mm^2.
  struct SquaredLengths {
    double shorter;
    double longer;
  };

  /// Unless one of the kept ones has no longer elements; those that have drop out.
  static void keep_shorter(const SquaredLengths& squared, std::vector<SquaredLengths>& kept) {
    const auto is_within = [](const SquaredLengths& a, const SquaredLengths& b) {
      return a.shorter <= b.shorter && a.longer <= b.longer;
    };
    if (std::none_of(kept.begin(), kept.end(), [&](const auto& other) { return is_within(other, squared); })) {
      std::erase_if(kept, [&](const auto& other) { return is_within(squared, other); });
      kept.push_back(squared);
    }
  }

  /// From end to end of a wall's element behind its first `part` ones.
  [[nodiscard]] Vector2 element_span(const LatticePattern::Wall& wall, int part) const {
    const Vector2& from = joints_[wall.start];
    const Vector2& to = joints_[wall.end];
    const int parts = elements_of(wall.kind);
    const Vector2 start = part == 0 ? from : place_in_wall(from, to, shares_[part]);
    const Vector2 end = part + 1 == parts ? to : place_in_wall(from, to, shares_[part + 1]);
    return end - start;
  }

  const LatticePattern& pattern_;
  const LatticeSizes& sizes_;
  std::vector<Vector2> joints_;
  std::vector<double> shares_;   // of a wall, before each of its elements
  std::vector<double> squared_;  // lengths of walls, mm^2
  LatticeLengths lengths_;
  LightestParticles light_;
};

}  // namespace

bool is_rigid(const LatticeSizes& sizes, int kind) { return sizes.rigid && (kind & kStiffWall) != 0; }

// Of divided walls, a joint of three or more is half as heavy again as the particles inside the lightest of them.
JointWalls find_light_joints(const LatticePattern& pattern, const LatticeSizes& sizes) {
  std::vector<int> count(pattern.joints.size(), 0);
  std::vector<bool> light(pattern.joints.size(), sizes.elements_per_wall == 1);
  for (const LatticePattern::Wall& wall : pattern.walls) {
    for (const int joint : {wall.start, wall.end}) {
      ++count[joint];
      light[joint] = light[joint] || is_rigid(sizes, wall.kind);
    }
  }
  JointWalls joints;
  joints.offset.push_back(0);
  std::vector<int> place(pattern.joints.size(), -1);
  for (std::size_t joint = 0; joint < pattern.joints.size(); ++joint) {
    if (light[joint] || count[joint] <= 2) {
      place[joint] = joints.offset.back();
      joints.offset.push_back(joints.offset.back() + count[joint]);
    }
  }
  joints.ends.resize(joints.offset.back());
  visit_ends(pattern, sizes, [&](int joint, int wall, bool at_end) {
    if (place[joint] >= 0) {
      joints.ends[place[joint]++] = {wall, at_end};
    }
  });
  return joints;
}

LatticeLengths measure_lengths(const LatticePattern& pattern, const JointWalls& joints, const RegularLattice& lattice,
                               const Imperfection& imperfection) {
  LengthsFinder finder(pattern, lattice, imperfection);
  finder.find_shortest_walls();
  finder.find_light_particles_in_walls();
  finder.find_light_joints(joints);
  return finder.take();
}

}  // namespace cellcrush
