#include "plots/rigid_walls.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cellcrush::client {

namespace {

std::vector<WallFace> faces_of(const v1::Case& submitted) {
  std::vector<WallFace> faces;
  const auto add = [&faces](const auto& walls) {
    for (const auto& wall : walls) {
      const double length = std::hypot(wall.normal_x(), wall.normal_y());
      if (length > 0.0) faces.push_back({wall.x_mm(), wall.y_mm(), wall.normal_x() / length, wall.normal_y() / length});
    }
  };
  add(submitted.lattice().frame().rigid_walls());
  add(submitted.loading().rigid_walls());
  return faces;
}

}  // namespace

RigidWalls::RigidWalls(const v1::Case& submitted, std::vector<v1::Sample> samples)
    : start_(faces_of(submitted)), samples_(std::move(samples)) {}

std::vector<WallFace> RigidWalls::at(double time_s) const {
  std::vector<WallFace> faces = start_;
  const auto after = std::ranges::upper_bound(samples_, time_s, {}, &v1::Sample::time_s);
  if (faces.empty() || after == samples_.begin()) return faces;
  const v1::Sample& before = *std::prev(after);
  const v1::Sample& next = after == samples_.end() ? before : *after;
  const double span = next.time_s() - before.time_s();
  const double mix = span > 0.0 ? (time_s - before.time_s()) / span : 0.0;
  for (int i = 0; i < std::min(static_cast<int>(faces.size()), next.rigid_walls_size()); ++i) {
    const double low = i < before.rigid_walls_size() ? before.rigid_walls(i).displacement_mm() : 0.0;
    const double moved = low + mix * (next.rigid_walls(i).displacement_mm() - low);
    WallFace& face = faces[static_cast<std::size_t>(i)];
    face.x += moved * face.normal_x;
    face.y += moved * face.normal_y;
  }
  return faces;
}

RigidWalls fetch_rigid_walls(Connection& connection, const std::string& job) {
  const v1::Case submitted = fetch_job(connection, job).case_();
  if (faces_of(submitted).empty()) return {};
  const v1::GetHistoryResponse history = fetch_history(connection, job);
  return {submitted, {history.samples().begin(), history.samples().end()}};
}

}  // namespace cellcrush::client
