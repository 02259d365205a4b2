#include "core/reference/reference_rim.h"

namespace cellcrush::reference {
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
