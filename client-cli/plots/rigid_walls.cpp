#include "plots/rigid_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cellcrush::client {

namespace {

// Out of a wall, towards the lattice; zero without any.
std::pair<double, double> normal_of(const v1::Frame::RigidWall& wall) {
  switch (wall.edge()) {
    case v1::Loading::Grip::LEFT: return {1.0, 0.0};
    case v1::Loading::Grip::RIGHT: return {-1.0, 0.0};
    case v1::Loading::Grip::BOTTOM: return {0.0, 1.0};
    case v1::Loading::Grip::TOP: return {0.0, -1.0};
    default: break;
  }
  const double length = std::hypot(wall.normal_x(), wall.normal_y());
  return length > 0.0 ? std::pair(wall.normal_x() / length, wall.normal_y() / length) : std::pair(0.0, 0.0);
}

std::vector<RigidWalls::Start> starts_of(const v1::Case& submitted) {
  std::vector<RigidWalls::Start> starts;
  const auto add = [&starts](const auto& walls) {
    for (const auto& wall : walls) {
      const auto [x, y] = normal_of(wall);
      const bool at_edge = wall.edge() != v1::Loading::Grip::EDGE_UNSPECIFIED;
      if (x != 0.0 || y != 0.0) starts.push_back({{wall.x_mm(), wall.y_mm(), x, y}, at_edge});
    }
  };
  add(submitted.lattice().frame().rigid_walls());
  add(submitted.loading().rigid_walls());
  return starts;
}

// Of the surfaces of all walls before loading, the least place along a normal.
double outermost_along(const v1::Mesh& mesh, const WallFace& face) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < mesh.element_nodes_size(); ++i) {
    const int particle = 2 * mesh.element_nodes(i);
    const double place = mesh.position_mm(particle) * face.normal_x + mesh.position_mm(particle + 1) * face.normal_y;
    least = std::min(least, place - 0.5 * mesh.thickness_mm(i / 2));
  }
  return least;
}

void move(WallFace& face, double way) {
  face.x += way * face.normal_x;
  face.y += way * face.normal_y;
}

}  // namespace

RigidWalls::RigidWalls(const v1::Case& submitted, std::vector<v1::Sample> samples)
    : start_(starts_of(submitted)), samples_(std::move(samples)) {}

std::vector<WallFace> RigidWalls::at(double time_s, const v1::Mesh& mesh) const {
  std::vector<WallFace> faces;
  for (const auto& [start, at_edge] : start_) {
    faces.push_back(start);
    if (at_edge) move(faces.back(), outermost_along(mesh, start));
  }
  const auto after = std::ranges::upper_bound(samples_, time_s, {}, &v1::Sample::time_s);
  if (faces.empty() || after == samples_.begin()) return faces;
  const v1::Sample& before = *std::prev(after);
  const v1::Sample& next = after == samples_.end() ? before : *after;
  const double span = next.time_s() - before.time_s();
  const double mix = span > 0.0 ? (time_s - before.time_s()) / span : 0.0;
  for (int i = 0; i < std::min(static_cast<int>(faces.size()), next.rigid_walls_size()); ++i) {
    const double low = i < before.rigid_walls_size() ? before.rigid_walls(i).displacement_mm() : 0.0;
    move(faces[static_cast<std::size_t>(i)], low + mix * (next.rigid_walls(i).displacement_mm() - low));
  }
  return faces;
}

RigidWalls fetch_rigid_walls(Connection& connection, const std::string& job) {
  const v1::Case submitted = fetch_job(connection, job).case_();
  if (starts_of(submitted).empty()) return {};
  const v1::GetHistoryResponse history = fetch_history(connection, job);
  return {submitted, {history.samples().begin(), history.samples().end()}};
}

}  // namespace cellcrush::client
