#include "compare/force_curve.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "error.h"

namespace cellcrush::compare {
namespace {

// What a part of the lattice bears, and how far it has moved.
struct PartSample {
  double force = 0.0;
  double displacement = 0.0;
};

std::vector<std::string> part_names(const v1::Sample& sample) {
  std::vector<std::string> out;
  for (const auto& wall : sample.rigid_walls()) out.push_back(wall.wall());
  for (const char* direction : {".x", ".y"}) {
    for (const auto& grip : sample.grips()) out.push_back(grip.grip() + direction);
    for (const auto& node : sample.watched()) out.push_back(node.node() + direction);
  }
  return out;
}

// REQUIRES: the name is one of part_names.
PartSample part_of(const v1::Sample& sample, const std::string& name) {
  for (const auto& wall : sample.rigid_walls()) {
    if (wall.wall() == name) return {wall.normal_force_n(), wall.displacement_mm()};
  }
  const std::string id = name.substr(0, name.size() - 2);
  const bool is_along_x = name.ends_with(".x");
  for (const auto& grip : sample.grips()) {
    if (grip.grip() != id) continue;
    return is_along_x ? PartSample{grip.force_x_n(), grip.displacement_x_mm()}
                      : PartSample{grip.force_y_n(), grip.displacement_y_mm()};
  }
  for (const auto& node : sample.watched()) {
    if (node.node() != id) continue;
    return is_along_x ? PartSample{node.reaction_x_n(), node.ux_mm()} : PartSample{node.reaction_y_n(), node.uy_mm()};
  }
  return {};
}

void check_part(const v1::Sample& sample, const char* field, const std::string& name) {
  const std::vector<std::string> known = part_names(sample);
  if (std::ranges::find(known, name) != known.end()) return;
  if (known.empty()) {
    throw InvalidField(field, fmt::format("is \"{}\", but the job has no rigid wall, grip or watched node.", name),
                       "Leave it out, or add one of these to the case.");
  }
  constexpr std::size_t kShown = 20;
  const auto end = known.begin() + static_cast<std::ptrdiff_t>(std::min(known.size(), kShown));
  throw InvalidField(
      field, fmt::format("is \"{}\", which the job does not have.", name),
      fmt::format("Give one of {}{}.", fmt::join(known.begin(), end, ", "), known.size() > kShown ? ", ..." : ""));
}

}  // namespace

ForceParts::ForceParts(const std::string& force, const std::string& displacement)
    : forces_(1), displacement_(displacement) {
  for (const char letter : force) {
    if (letter == '+') {
      forces_.emplace_back();
    } else {
      forces_.back() += letter;
    }
  }
  constexpr std::size_t kMostParts = 100;
  if (forces_.size() > kMostParts)
    throw InvalidField("force_part", fmt::format("adds {} parts.", forces_.size()), "Give at most 100.");
  for (auto part = forces_.begin(); part != forces_.end(); ++part) {
    if (std::find(forces_.begin(), part, *part) != part)
      throw InvalidField("force_part", fmt::format("has \"{}\" twice.", *part), "Name each part once.");
  }
  if (!displacement_.empty()) return;
  if (forces_.size() > 1) {
    throw InvalidField("displacement_part", "is missing: force_part adds several.",
                       "Name the part whose displacement counts.");
  }
  displacement_ = force;
}

void ForceParts::check(const v1::Sample& sample) const {
  for (const std::string& part : forces_) check_part(sample, "force_part", part);
  check_part(sample, "displacement_part", displacement_);
}

CurvePoint ForceParts::point_of(const v1::Sample& sample) const {
  CurvePoint out{part_of(sample, displacement_).displacement, 0.0};
  for (const std::string& part : forces_) out.y += part_of(sample, part).force;
  return out;
}

LoadCurve loading_of(const std::vector<CurvePoint>& points) {
  double farthest = 0.0;
  for (const auto& point : points) {
    if (std::abs(point.x) > std::abs(farthest)) farthest = point.x;
  }
  LoadCurve out;
  for (const auto& point : points) out.add(std::copysign(1.0, farthest) * point.x, point.y);
  if (out.x.size() < 2) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "What was compared has not moved: its curve has no two points. Compare again once it has, or "
                       "name a part that moves in displacement_part.");
  }
  return out;
}

void align_sign(const LoadCurve& test, LoadCurve& computed) {
  double product = 0.0;
  for (std::size_t i = 0; i < computed.x.size(); ++i) {
    if (computed.x[i] < test.x.front() || computed.x[i] > test.x.back()) continue;
    product += computed.y[i] * test.at(computed.x[i]);
  }
  if (product >= 0.0) return;
  for (double& force : computed.y) force = -force;
}

}  // namespace cellcrush::compare
