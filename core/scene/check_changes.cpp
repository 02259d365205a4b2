#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "lattice/grade_walls.h"
#include "lattice/voronoi.h"
#include "scene/check_spec.h"

namespace cellcrush {
namespace {

const std::string kVoronoiPath = "lattice.voronoi.";

void check_factors(const std::string& name, const std::vector<double>& steps, const std::vector<double>& polynomial,
                   FieldChecker& check) {
  const std::string of_steps = "lattice.grading." + name + "_steps";
  const std::string of_polynomial = "lattice.grading." + name + "_polynomial";
  if (!steps.empty() && !polynomial.empty()) {
    check.add(of_polynomial, "", "is given beside " + of_steps + ".", "Give one of the two.");
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    check.in_range(of_steps + "[" + std::to_string(i) + "]", steps[i], {1e-6, 1e6}, " (a factor)");
  }
  if (polynomial.empty()) return;
  constexpr int kPlaces = 1000;
  constexpr double kLeast = 0.01;  // of the greatest
  const Factors factors(steps, polynomial);
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    const double factor = factors.at(static_cast<double>(i) / kPlaces);
    least = std::isfinite(factor) ? std::min(least, factor) : 0.0;
    greatest = std::max(greatest, factor);
  }
  if (!(least >= kLeast * greatest) || greatest == 0.0) {
    check.add(of_polynomial, "", "has factors from " + to_text(least) + " to " + to_text(greatest) + ".",
              "Give a polynomial that is positive from 0 to 1, and nowhere below a hundredth of its maximum.");
  }
}

void check_outline(const Outline& outline, FieldChecker& check) {
  check.within_limits("lattice.outline.edge_wall_thickness_mm", outline.edge_wall_thickness_mm);
  const std::string field = "lattice.outline.corners_mm";
  const std::vector<double>& corners = outline.corners_mm;
  if (corners.empty()) return;
  if (corners.size() % 2 != 0 || corners.size() < 4) {
    check.add(field, std::to_string(corners.size()) + " numbers", "are not the x and y of two or more corners.",
              "Give x and y of two opposite corners of a rectangle, or of each corner of a polygon.");
    return;
  }
  if (!std::ranges::all_of(corners, [](double value) { return std::abs(value) <= 1e9; })) {
    check.add(field, "", "has a number that is not a place within 1e9 mm.", "Give finite numbers of mm.");
    return;
  }
  double area = 0.0;
  for (std::size_t i = 0; i < corners.size(); i += 2) {
    const std::size_t next = (i + 2) % corners.size();
    area += 0.5 * (corners[i] * corners[next + 1] - corners[next] * corners[i + 1]);
  }
  if (corners.size() == 4) area = (corners[2] - corners[0]) * (corners[3] - corners[1]);
  if (area == 0.0) check.add(field, "", "enclose no area.", "Give corners of a rectangle or of a polygon, in order.");
}

}  // namespace

double check_voronoi(const SceneSpec& spec, FieldChecker& check) {
  const auto& lattice = std::get<VoronoiWalls>(spec.lattice);
  const bool columns = check.within_limits(kVoronoiPath + "columns", lattice.columns);
  const bool rows = check.within_limits(kVoronoiPath + "rows", lattice.rows);
  if (rows && *lattice.rows % 2 != 0) {
    check.add(kVoronoiPath + "rows", std::to_string(*lattice.rows), "is odd: the nuclei would not repeat along y.",
              "Give an even number.");
  }
  const bool is_sound = check.within_limits(kVoronoiPath + "side_mm", lattice.side_mm);
  const double side = is_sound ? *lattice.side_mm : std::numeric_limits<double>::infinity();
  check.within_limits(kVoronoiPath + "irregularity", lattice.irregularity);
  check.within_limits(kVoronoiPath + "relaxation_steps", lattice.relaxation_steps);
  if (lattice.relative_density) {
    check.within_limits(kVoronoiPath + "relative_density", lattice.relative_density);
  }
  if (lattice.wall_thickness_mm || !lattice.relative_density) {
    check.in_range(kVoronoiPath + "wall_thickness_mm", lattice.wall_thickness_mm, {1e-6, 0.5 * side},
                   unit_of_share(0.5, side) + (lattice.relative_density ? "" : ", or a relative_density"));
  }
  if (lattice.wall_thickness_mm && lattice.relative_density) {
    check.add(kVoronoiPath + "relative_density", to_text(*lattice.relative_density),
              "is given beside wall_thickness_mm.", "Give one of the two.");
  }
  if (columns && rows) {
    const double elements = count_elements(spec);
    if (elements > kMostElements) {
      check.add(kVoronoiPath + "columns", std::to_string(*lattice.columns),
                "makes about " + to_text(elements) + " elements with the rows and elements_per_wall given.",
                "Keep 3 x columns x rows x elements_per_wall at or below " + to_text(kMostElements) + ".");
    }
  }
  return side;
}

void check_changes(const SceneSpec& spec, FieldChecker& check) {
  const LatticeChanges& changes = spec.changes;
  if (changes == LatticeChanges()) return;
  if (std::holds_alternative<FrameWalls>(spec.lattice)) {
    check.add("lattice", "", "is a frame, whose walls are not changed by defects, grading, rotation or outline.",
              "Remove these, or give the walls as lattice.network.");
    return;
  }
  if (spec.inclusions.model == Inclusions::Model::rigid && !spec.inclusions.rows.empty()) {
    check.add("lattice.inclusions.model", "RIGID", "does not go with defects, grading, rotation or outline.",
              "Set it to MESHED.");
  }
  check.within_limits("lattice.defects.missing_walls", changes.defects.missing_walls);
  check.within_limits("lattice.defects.thickness_scatter", changes.defects.thickness_scatter);
  check.within_limits("lattice.rotation_degrees", changes.rotation_degrees);
  check_factors("thickness", changes.grading.thickness_steps, changes.grading.thickness_polynomial, check);
  check_factors("size", changes.grading.size_steps, changes.grading.size_polynomial, check);
  check_outline(changes.outline, check);
}

}  // namespace cellcrush
