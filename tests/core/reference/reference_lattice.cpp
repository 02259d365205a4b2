#include <algorithm>

#include "core/reference/reference_crush.h"

namespace cellcrush::reference {

namespace {

/// Of each particle, whether it has no rotation: the common nodes of two elements that are solved together (E5b).
std::vector<bool> have_no_rotation(const Lattice& lattice) {
  std::vector<bool> have_none(lattice.position.size(), false);
  for (const std::vector<int>& wall : lattice.walls) {
    for (const std::vector<int>& unit : units_of(lattice.rule, wall)) {
      if (unit.size() == 2) {
        have_none[lattice.segments[unit.front()].end] = true;
      }
    }
  }
  return have_none;
}

}  // namespace

std::vector<int> Lattice::segments_at(int particle) const {
  std::vector<int> at;
  for (std::size_t e = 0; e < segments.size(); ++e) {
    if (segments[e].start == particle || segments[e].end == particle) {
      at.push_back(static_cast<int>(e));
    }
  }
  return at;
}

Particles lump(const Lattice& lattice) {
  const std::size_t count = lattice.position.size();
  Particles particles = {std::vector<double>(count), std::vector<double>(count), std::vector<double>(count),
                         grown_with(lattice)};
  const std::vector<bool> have_none = have_no_rotation(lattice);
  for (const Segment& segment : lattice.segments) {
    const double length = (lattice.position[segment.end] - lattice.position[segment.start]).norm();
    const double mass = segment.material.density * lattice.depth * segment.thickness * length / 2.0;  // Eq. 2, E1
    for (const int particle : {segment.start, segment.end}) {
      const int other = particle == segment.start ? segment.end : segment.start;
      const int turning = have_none[particle] ? other : particle;
      particles.mass[particle] += mass;
      particles.inertia[turning] += mass * segment.thickness * segment.thickness / 12.0;           // Eq. 3, E1
      particles.radius[particle] = std::max(particles.radius[particle], segment.thickness / 2.0);  // R of E8
    }
  }
  return particles;
}

ElementData element_data_of(const Lattice& lattice, int segment) {
  const Segment& of = lattice.segments[segment];
  const double undeformed_length = (lattice.position[of.end] - lattice.position[of.start]).norm();
  return {of.material, of.thickness, lattice.depth, undeformed_length, of.in_pair};
}

Thickening thickening_of(const Lattice& lattice, int segment, const std::vector<Vector>& position) {
  if (segment >= lattice.element_count) {
    return {};  // of a rigid body
  }
  const Segment& of = lattice.segments[segment];
  return thickening_of(lattice.rule, element_data_of(lattice, segment), (position[of.end] - position[of.start]).norm());
}

std::vector<std::vector<int>> grown_with(const Lattice& lattice) {
  std::vector<std::vector<int>> all(lattice.position.size());
  for (const std::vector<int>& wall : lattice.walls) {
    for (std::size_t k = 1; k < wall.size(); ++k) {
      all[lattice.segments[wall[k]].start] = {wall[k - 1], wall[k]};
    }
  }
  return all;
}

namespace {

Vector span_of(const Lattice& lattice, const Motion& motion, int segment) {
  return motion.position[lattice.segments[segment].end] - motion.position[lattice.segments[segment].start];
}

double length_of(const Rim& rim, const Lattice& lattice, const Motion& motion) {
  double length = 0.0;
  for (const int segment : rim.segments) {
    length += span_of(lattice, motion, segment).norm();
  }
  return length;
}

}  // namespace

double Rim::speed(const Lattice& lattice, const Motion& motion) const {
  double turning = 0.0;  // rad/s, the mean by length
  for (const int segment : segments) {
    const int start = lattice.segments[segment].start;
    const int end = lattice.segments[segment].end;
    const Vector span = span_of(lattice, motion, segment);
    const double of_segment = cross(span, motion.velocity[end] - motion.velocity[start]) / span.squaredNorm();
    turning += of_segment * span.norm() / length_of(*this, lattice, motion);
  }
  return turning * arm;
}

void Rim::turn(const Lattice& lattice, const Motion& motion, double friction, std::vector<Vector>& forces) const {
  for (const int segment : segments) {
    const Vector span = span_of(lattice, motion, segment);
    const double couple = arm * friction * span.norm() / length_of(*this, lattice, motion);
    const Vector on_end = couple / span.squaredNorm() * turned_left(span);
    forces[lattice.segments[segment].end] += on_end;
    forces[lattice.segments[segment].start] -= on_end;
  }
}

double Rim::leverage(const Lattice& lattice, const Motion& motion) const {
  const double length = length_of(*this, lattice, motion);
  return 2.0 * arm * arm / (length * length);
}

}  // namespace cellcrush::reference
