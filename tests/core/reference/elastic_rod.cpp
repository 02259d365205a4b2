#include "core/reference/elastic_rod.h"

#include <cmath>
#include <stdexcept>

namespace cellcrush::reference {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::Vector4d;

/// x, y, angle, moment.
using Section = Vector4d;

Section slope(const ElasticRod& rod, const Section& at, const Vector2d& n) {
  const Vector2d tangent(std::cos(at[2]), std::sin(at[2]));
  const Vector2d way = (1.0 + n.dot(tangent) / rod.stretching) * tangent;
  return {way.x(), way.y(), rod.curvature + at[3] / rod.bending, -(way.x() * n.y() - way.y() * n.x())};
}

Section advanced(const ElasticRod& rod, Section at, const Vector2d& n, double way) {
  constexpr int kSteps = 60;
  const double h = way / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const Section k1 = slope(rod, at, n);
    const Section k2 = slope(rod, at + 0.5 * h * k1, n);
    const Section k3 = slope(rod, at + 0.5 * h * k2, n);
    const Section k4 = slope(rod, at + h * k3, n);
    at += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return at;
}

/// Newton's method from a guess, with differences for derivatives. `scale`: of the unknowns.
template <int kSize, class Residual>
Eigen::Vector<double, kSize> root_of(const Residual& residual, Eigen::Vector<double, kSize> guess,
                                     const Eigen::Vector<double, kSize>& scale) {
  for (int round = 0; round < 30; ++round) {
    const Eigen::Vector<double, kSize> here = residual(guess);
    if (here.norm() < 1e-10) return guess;
    Eigen::Matrix<double, kSize, kSize> derivative;
    for (int i = 0; i < kSize; ++i) {
      Eigen::Vector<double, kSize> near = guess;
      near[i] += 1e-6 * scale[i];
      derivative.col(i) = (residual(near) - here) / (1e-6 * scale[i]);
    }
    guess -= derivative.partialPivLu().solve(here);
  }
  throw std::runtime_error("the elastic rod was not shot to its end");
}

}  // namespace

ElasticRod::Shape ElasticRod::shape_under(const Vector2d& n, double moment, const Vector2d& load) const {
  const Section middle = advanced(*this, Section(0.0, 0.0, angle, moment), n, 0.5 * length);
  const Section end = advanced(*this, middle, n - load, 0.5 * length);
  return {middle.head<2>(), end.head<2>(), end[2], end[3]};
}

std::vector<double> toggle_loads(const ElasticRod& rod, const std::vector<double>& deflections) {
  const double force = rod.bending / (rod.length * rod.length);
  const Vector3d scale(force, force, force * rod.length);
  const Vector2d apex = rod.length * Vector2d(std::cos(rod.angle), std::sin(rod.angle));
  Vector3d found = Vector3d::Zero();
  std::vector<double> loads;
  for (const double deflection : deflections) {
    const auto residual = [&](const Vector3d& forces) {
      const ElasticRod::Shape shape = rod.shape_under(forces.head<2>(), forces[2], Vector2d::Zero());
      const Vector2d miss = (shape.end - apex + Vector2d(0.0, deflection)) / rod.length;
      return Vector3d(miss.x(), miss.y(), shape.end_angle - rod.angle);
    };
    found = root_of<3>(residual, found, scale);
    loads.push_back(-2.0 * found[1]);
  }
  return loads;
}

std::vector<double> arch_loads(const ElasticRod& arch, const std::vector<double>& deflections) {
  const double force = arch.bending * arch.curvature * arch.curvature;
  const Vector4d scale(force, force, force / std::abs(arch.curvature), force);
  const ElasticRod::Shape unloaded = arch.shape_under(Vector2d::Zero(), 0.0, Vector2d::Zero());
  Vector4d found = Vector4d::Zero();
  Vector4d before = found;
  std::vector<double> loads;
  for (const double deflection : deflections) {
    const auto residual = [&](const Vector4d& forces) {
      const ElasticRod::Shape shape = arch.shape_under(forces.head<2>(), forces[2], Vector2d(0.0, -forces[3]));
      const Vector2d miss = (shape.end - unloaded.end) / arch.length;
      return Vector4d(miss.x(), miss.y(), shape.end_moment / scale[2],
                      (shape.middle.y() - unloaded.middle.y() + deflection) / arch.length);
    };
    const Vector4d next = root_of<4>(residual, Vector4d(2.0 * found - before), scale);
    before = found;
    found = next;
    loads.push_back(found[3]);
  }
  return loads;
}

}  // namespace cellcrush::reference
