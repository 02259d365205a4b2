#include "core/reference/beam_network.h"

#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>

namespace cellcrush::reference {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Stiffness of a beam for the displacements and rotations of its ends.
Matrix6 stiffness_of(double x, double y, double thickness, double shear_flexibility) {
  const double length = std::hypot(x, y);
  const double axial = thickness / length;
  // Deflection of guided ends by shear over that by bending.
  const double sheared = shear_flexibility * thickness * thickness / (length * length);
  const double bending = thickness * thickness * thickness / (12.0 * length * length * length) / (1.0 + sheared);
  Matrix6 local = Matrix6::Zero();
  local(0, 0) = local(3, 3) = axial;
  local(0, 3) = local(3, 0) = -axial;
  const double across = 12.0 * bending;
  const double arm = 6.0 * bending * length;
  const double turn = bending * length * length;
  local(1, 1) = local(4, 4) = across;
  local(1, 4) = local(4, 1) = -across;
  local(1, 2) = local(2, 1) = local(1, 5) = local(5, 1) = arm;
  local(2, 4) = local(4, 2) = local(4, 5) = local(5, 4) = -arm;
  local(2, 2) = local(5, 5) = (4.0 + sheared) * turn;
  local(2, 5) = local(5, 2) = (2.0 - sheared) * turn;
  Matrix6 rotation = Matrix6::Identity();
  for (const int at : {0, 3}) {
    rotation(at, at) = rotation(at + 1, at + 1) = x / length;
    rotation(at, at + 1) = y / length;
    rotation(at + 1, at) = -y / length;
  }
  return rotation.transpose() * local * rotation;
}

/// What is imposed on displacements and rotations, three a joint.
struct Imposed {
  explicit Imposed(std::size_t joints)
      : value(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * joints))), is_held(3 * joints, 0) {}
  void hold(std::size_t joint, int component, double to = 0.0) {
    is_held[3 * joint + component] = 1;
    value[static_cast<Eigen::Index>(3 * joint + component)] = to;
  }
  Eigen::VectorXd value;
  std::vector<char> is_held;
};

/// Forces and moments on the joints, three a joint.
Eigen::VectorXd forces_of(const BeamNetwork& network, const Imposed& imposed) {
  const auto size = static_cast<Eigen::Index>(3 * network.joints.size());
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Eigen::Triplet<double>> free_entries;
  for (const BeamNetwork::Wall& wall : network.walls) {
    const auto& start = network.joints[wall.start];
    const auto& end = network.joints[wall.end];
    const Matrix6 stiffness =
        stiffness_of(end[0] - start[0], end[1] - start[1], wall.thickness, network.shear_flexibility);
    const auto index = [&](int i) { return 3 * (i < 3 ? wall.start : wall.end) + i % 3; };
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) {
        entries.emplace_back(index(i), index(j), stiffness(i, j));
        if (imposed.is_held[index(i)] == 0 && imposed.is_held[index(j)] == 0) {
          free_entries.emplace_back(index(i), index(j), stiffness(i, j));
        }
      }
    }
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    if (imposed.is_held[i] != 0) free_entries.emplace_back(i, i, 1.0);
  }
  Eigen::SparseMatrix<double> whole(size, size);
  whole.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseMatrix<double> free(size, size);
  free.setFromTriplets(free_entries.begin(), free_entries.end());
  Eigen::VectorXd load = -(whole * imposed.value);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (imposed.is_held[i] != 0) load[i] = 0.0;
  }
  const Eigen::VectorXd moved =
      imposed.value + Eigen::VectorXd(Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(free).solve(load));
  return whole * moved;
}

}  // namespace

double modulus_between_plates(const BeamNetwork& network, int axis) {
  const auto along = [&](std::size_t joint, int of_axis) { return network.joints[joint][of_axis]; };
  std::array<double, 2> low{};
  std::array<double, 2> high{};
  for (const int each : {0, 1}) {
    const auto [least, most] =
        std::ranges::minmax(network.joints, {}, [each](const auto& joint) { return joint[each]; });
    low[each] = least[each];
    high[each] = most[each];
  }
  const double near = 1e-9 * (high[axis] - low[axis]);
  // The plate at the low end stands; that at the high end moves by -1.
  Imposed imposed(network.joints.size());
  bool is_anchored = false;
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    const bool at_low = along(joint, axis) < low[axis] + near;
    if (at_low) imposed.hold(joint, axis);
    if (along(joint, axis) > high[axis] - near) imposed.hold(joint, axis, -1.0);
    if (at_low && !is_anchored) imposed.hold(joint, 1 - axis);
    is_anchored = is_anchored || at_low;
  }
  const Eigen::VectorXd force = forces_of(network, imposed);
  double reaction = 0.0;
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    if (along(joint, axis) > high[axis] - near) reaction -= force[static_cast<Eigen::Index>(3 * joint + axis)];
  }
  return reaction / (high[1 - axis] - low[1 - axis]) * (high[axis] - low[axis]);
}

double stiffness_between_grips(const BeamNetwork& network, double low, double high) {
  Imposed imposed(network.joints.size());
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    const double y = network.joints[joint][1];
    if (y > low && y < high) continue;
    for (const int component : {0, 1, 2}) imposed.hold(joint, component);
    if (y >= high) imposed.hold(joint, 1, -1.0);
  }
  const Eigen::VectorXd force = forces_of(network, imposed);
  double reaction = 0.0;
  for (std::size_t joint = 0; joint < network.joints.size(); ++joint) {
    if (network.joints[joint][1] >= high) reaction -= force[static_cast<Eigen::Index>(3 * joint + 1)];
  }
  return reaction;
}

}  // namespace cellcrush::reference
