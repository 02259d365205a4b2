#include "measure/local_strain.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cellcrush/simulation.h"
#include "push/crush.h"

namespace cellcrush {
namespace {

/// Joints lie on a line if the square of the area that they span is below this fraction of what a round cell spans.
constexpr double kOnALine = 1e-6;

std::vector<bool> find_joints(const Scene& scene) {
  std::vector<bool> is_joint(scene.particle_count());
  for (const std::vector<int>* ends : {&scene.walls.start, &scene.walls.end}) {
    for (const int joint : *ends) is_joint[joint] = true;
  }
  for (std::size_t e = scene.rigid.first_element; e < scene.element_count(); ++e) {
    is_joint[scene.elements[e].start] = is_joint[scene.elements[e].end] = true;
  }
  return is_joint;
}

}  // namespace

LocalStrain::LocalStrain(const Scene& scene, const Faces& faces) : wall_count_(scene.wall_count()) {
  const Scene& mesh = scene.repeated != nullptr ? *scene.repeated : scene;
  const auto original_of = [&scene](int particle) { return particle % static_cast<int>(scene.particle_count()); };
  const std::vector<bool> is_joint = find_joints(scene);
  const std::vector<int> wall_of = mesh_of(scene).element_wall;
  offset_.push_back(0);
  wall_offset_.push_back(0);
  for (std::size_t face = 0; face < faces.count(); ++face) {
    std::vector<int> corners;
    std::ranges::copy_if(faces.particles_of(face), std::back_inserter(corners),
                         [&](int p) { return is_joint[original_of(p)]; });
    Vector2 centre = Vector2::Zero();
    for (const int corner : corners) centre += mesh.position[corner] / static_cast<double>(corners.size());
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    for (const int corner : corners) {
      const Vector2 from_centre = mesh.position[corner] - centre;
      squares += from_centre * from_centre.transpose();
    }
    if (squares.determinant() > kOnALine * squares.trace() * squares.trace()) {
      const Vector2 column = squares.inverse().col(crush_axis_of(scene));
      for (const int corner : corners) joints_.push_back({corner, (mesh.position[corner] - centre).dot(column)});
      for (const int element : faces.elements_of(face))
        walls_.push_back(wall_of[element % static_cast<int>(scene.element_count())]);
      std::sort(walls_.begin() + wall_offset_.back(), walls_.end());
      walls_.erase(std::unique(walls_.begin() + wall_offset_.back(), walls_.end()), walls_.end());
    }
    offset_.push_back(static_cast<int>(joints_.size()));
    wall_offset_.push_back(static_cast<int>(walls_.size()));
  }
}

void LocalStrain::evaluate(std::span<const Vector2> position, std::vector<float>& strains) const {
  strains.assign(joints_.empty() ? 0 : wall_count_, 0.0F);
  std::vector<int> cells(strains.size(), 0);
  for (std::size_t cell = 0; cell + 1 < offset_.size(); ++cell) {
    Vector2 line = Vector2::Zero();
    for (int j = offset_[cell]; j < offset_[cell + 1]; ++j) line += joints_[j].weight * position[joints_[j].particle];
    for (int w = wall_offset_[cell]; w < wall_offset_[cell + 1]; ++w) {
      strains[walls_[w]] += static_cast<float>(1.0 - line.norm());
      ++cells[walls_[w]];
    }
  }
  for (std::size_t wall = 0; wall < strains.size(); ++wall) {
    if (cells[wall] > 1) strains[wall] /= static_cast<float>(cells[wall]);
  }
}

}  // namespace cellcrush
