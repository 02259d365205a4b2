#include "chart/lattice_drawing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "chart/colour_map.h"

namespace cellcrush::client {

namespace {

constexpr int kShades = 32;
constexpr double kThinnestWall = 0.5;  // units; thinner lines vanish
constexpr double kPlateShare = 0.009;  // a plate's thickness as a share of the specimen's longer side
constexpr double kGripShare = 0.008;   // size of a square on a gripped particle, as a share of the box's longer side
constexpr double kMarginShare = 1.5;   // around the drawing, in thicknesses of a plate
constexpr double kNearShare = 0.2;     // how far faces of rigid walls may be that are shown, of the longer side
constexpr double kSmallestRing = 2.5;  // units, radius
constexpr Colour kPlateColour{0.35, 0.36, 0.40};
constexpr Colour kOverlapColour{0.80, 0.15, 0.55};

double impact_plate_now(const LatticeStage& stage) {
  return stage.impact_plate_mm + stage.strain * (stage.support_plate_mm - stage.impact_plate_mm);
}

void include(Box& box, double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  box.low_x = std::min(box.low_x, x);
  box.high_x = std::max(box.high_x, x);
  box.low_y = std::min(box.low_y, y);
  box.high_y = std::max(box.high_y, y);
}

// Includes the faces along x or y that are near: a striker may start far away.
void include_faces(const std::vector<LatticeStage>& stages, Box& box) {
  const Box lattice = box;
  const double near = kNearShare * std::max(box.width(), box.height());
  for (const LatticeStage& stage : stages) {
    for (const WallFace& face : stage.faces) {
      if (face.normal_y == 0.0 && face.x > lattice.low_x - near && face.x < lattice.high_x + near) {
        include(box, face.x, lattice.low_y);
      }
      if (face.normal_x == 0.0 && face.y > lattice.low_y - near && face.y < lattice.high_y + near) {
        include(box, lattice.low_x, face.y);
      }
    }
  }
}

// Identical in every drawing of a crush, even where the box follows the impact plate.
double plate_thickness(const LatticeStage& stage, const Box& box) {
  const double length = stage.support_plate_mm - stage.impact_plate_mm;
  return kPlateShare * std::max(length, stage.along_y ? box.width() : box.height());
}

// Maps the plane to a rectangle of the picture, with the box centred.
class Projection {
 public:
  Projection(const Rectangle& place, const Box& box)
      : scale_(drawing_scale(place, box)),
        x0_(place.x + 0.5 * (place.width - scale_ * box.width()) - scale_ * box.low_x),
        y0_(place.y + 0.5 * (place.height + scale_ * box.height()) + scale_ * box.low_y) {}

  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] double x(double value) const { return x0_ + scale_ * value; }
  [[nodiscard]] double y(double value) const { return y0_ - scale_ * value; }

 private:
  double scale_;
  double x0_;
  double y0_;
};

// A plate or a side wall with its face at `face` along y or x, extending to the side `outwards` (-1 or 1) across the
// box.
void draw_plate(cairo_t* context, const Projection& projection, const Box& box, double thickness, bool along_y,
                double face, double outwards) {
  const double low = std::min(face, face + outwards * thickness);
  const double size = projection.scale() * thickness;
  if (along_y) {
    cairo_rectangle(context, projection.x(box.low_x), projection.y(low + thickness), projection.scale() * box.width(),
                    size);
  } else {
    cairo_rectangle(context, projection.x(low), projection.y(box.high_y), size, projection.scale() * box.height());
  }
  set_colour(context, kPlateColour);
  cairo_fill(context);
}

// Bands behind the faces of rigid walls, across the box.
void draw_faces(cairo_t* context, const Rectangle& place, const Projection& projection, const Box& box,
                const std::vector<WallFace>& faces) {
  const double thickness = kPlateShare * std::max(box.width(), box.height());
  cairo_save(context);
  cairo_rectangle(context, place.x, place.y, place.width, place.height);
  cairo_clip(context);
  set_colour(context, kPlateColour);
  for (const WallFace& face : faces) {
    const double along_x = -face.normal_y;
    const double along_y = face.normal_x;
    const double half = 0.5 * (std::abs(along_x) * box.width() + std::abs(along_y) * box.height());
    const double middle =
        (0.5 * (box.low_x + box.high_x) - face.x) * along_x + (0.5 * (box.low_y + box.high_y) - face.y) * along_y;
    const auto go_to = [&](double along, double behind) {
      cairo_line_to(context, projection.x(face.x + along * along_x - behind * face.normal_x),
                    projection.y(face.y + along * along_y - behind * face.normal_y));
    };
    cairo_new_path(context);
    go_to(middle - half, 0.0);
    go_to(middle + half, 0.0);
    go_to(middle + half, thickness);
    go_to(middle - half, thickness);
    cairo_fill(context);
  }
  cairo_restore(context);
}

// A square on each particle that a grip holds.
void draw_grips(cairo_t* context, const Projection& projection, const Box& box, const LatticeStage& stage) {
  const double size = projection.scale() * kGripShare * std::max(box.width(), box.height());
  for (const int particle : stage.gripped) {
    const auto i = 2 * static_cast<std::size_t>(particle);
    cairo_rectangle(context, projection.x(stage.position_mm[i]) - 0.5 * size,
                    projection.y(stage.position_mm[i + 1]) - 0.5 * size, size, size);
  }
  set_colour(context, kPlateColour);
  cairo_fill(context);
}

// Position of the impact plate's face before loading.
void draw_start(cairo_t* context, const Projection& projection, const Box& box, const LatticeStage& stage) {
  const double start = stage.impact_plate_mm;
  if (stage.along_y) {
    cairo_move_to(context, projection.x(box.low_x), projection.y(start));
    cairo_line_to(context, projection.x(box.high_x), projection.y(start));
  } else {
    cairo_move_to(context, projection.x(start), projection.y(box.low_y));
    cairo_line_to(context, projection.x(start), projection.y(box.high_y));
  }
  const double dashes[] = {4.0, 4.0};
  set_colour(context, {0.7, 0.7, 0.73});
  cairo_set_line_width(context, 1.0);
  cairo_set_dash(context, dashes, 2, 0.0);
  cairo_stroke(context);
  cairo_set_dash(context, nullptr, 0, 0.0);
}

// Walls of one shade and thickness share a path, which keeps a picture of ten thousand walls small.
void draw_walls(cairo_t* context, const Projection& projection, const LatticeStage& stage) {
  constexpr int kRigid = kShades + 1;
  const int first_rigid = static_cast<int>(stage.thickness_mm.size()) - stage.rigid_elements;
  std::map<std::pair<int, float>, std::vector<int>> groups;
  for (int element = 0; element < static_cast<int>(stage.thickness_mm.size()); ++element) {
    const auto at = static_cast<std::size_t>(element);
    const float share = std::clamp(stage.plastic_fraction[at], 0.0F, 1.0F);
    const bool rigid = element >= first_rigid;
    groups[{rigid ? kRigid : static_cast<int>(std::lround(share * kShades)), stage.thickness_mm[at]}].push_back(
        element);
  }
  const auto point = [&](int element, int end) {
    const auto node = 2 * static_cast<std::size_t>(stage.element_nodes[static_cast<std::size_t>(2 * element + end)]);
    return std::pair(projection.x(stage.position_mm[node]), projection.y(stage.position_mm[node + 1]));
  };
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  for (const auto& [key, elements] : groups) {
    set_colour(context, key.first == kRigid ? kPlateColour : map_colour(static_cast<double>(key.first) / kShades));
    cairo_set_line_width(context, std::max(projection.scale() * static_cast<double>(key.second), kThinnestWall));
    for (const int element : elements) {
      const auto [x0, y0] = point(element, 0);
      const auto [x1, y1] = point(element, 1);
      if (!std::isfinite(x0 + y0 + x1 + y1)) continue;
      cairo_move_to(context, x0, y0);
      cairo_line_to(context, x1, y1);
    }
    cairo_stroke(context);
  }
  cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
}

// Rings round the particles where walls overlapped before loading.
void draw_overlaps(cairo_t* context, const Projection& projection, const LatticeStage& stage) {
  if (stage.overlap_particle.empty()) return;
  const double thickest = projection.scale() * static_cast<double>(std::ranges::max(stage.thickness_mm));
  const double radius = std::max(thickest, kSmallestRing);
  for (const int particle : stage.overlap_particle) {
    const auto at = 2 * static_cast<std::size_t>(particle);
    const double x = projection.x(stage.position_mm[at]);
    const double y = projection.y(stage.position_mm[at + 1]);
    if (!std::isfinite(x + y)) continue;
    cairo_new_sub_path(context);
    cairo_arc(context, x, y, radius, 0.0, 2.0 * std::numbers::pi);
  }
  set_colour(context, kOverlapColour);
  cairo_set_line_width(context, 1.0);
  cairo_stroke(context);
}

}  // namespace

double drawing_scale(const Rectangle& place, const Box& box) {
  return std::min(place.width / box.width(), place.height / box.height());
}

Box find_box(const std::vector<LatticeStage>& stages) {
  const auto& first = stages.front().position_mm;
  Box box{first[0], first[0], first[1], first[1]};
  for (const LatticeStage& stage : stages) {
    const auto& position = stage.position_mm;
    for (std::size_t i = 0; i + 1 < position.size(); i += 2) include(box, position[i], position[i + 1]);
    if (!stage.has_plates()) continue;
    for (const double face : {stage.impact_plate_mm, stage.support_plate_mm}) {
      stage.along_y ? include(box, box.low_x, face) : include(box, face, box.low_y);
    }
  }
  include_faces(stages, box);
  const double thickness = stages.front().has_plates() ? plate_thickness(stages.front(), box)
                                                       : kPlateShare * std::max(box.width(), box.height());
  const double margin = std::max(thickness, 1e-6) * kMarginShare;
  return {box.low_x - margin, box.high_x + margin, box.low_y - margin, box.high_y + margin};
}

std::vector<Box> find_boxes(const std::vector<LatticeStage>& stages) {
  const Box all = find_box(stages);
  std::vector<Box> boxes(stages.size(), all);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const LatticeStage& stage = stages[i];
    if (!stage.has_plates()) continue;
    // Up to the impact plate, or to whatever extends beyond it.
    double low = impact_plate_now(stage);
    const auto& position = stage.position_mm;
    for (std::size_t k = stage.along_y ? 1 : 0; k < position.size(); k += 2) {
      if (std::isfinite(position[k])) low = std::min(low, static_cast<double>(position[k]));
    }
    low -= kMarginShare * plate_thickness(stage, all);
    stage.along_y ? boxes[i].low_y = std::max(low, all.low_y) : boxes[i].low_x = std::max(low, all.low_x);
  }
  return boxes;
}

void draw_lattice(cairo_t* context, const Rectangle& place, const Box& box, const LatticeStage& stage) {
  const Projection projection(place, box);
  if (stage.has_plates()) {
    const bool start_is_inside = stage.impact_plate_mm > (stage.along_y ? box.low_y : box.low_x);
    if (stage.strain > 0.0 && start_is_inside) draw_start(context, projection, box, stage);
    const double thickness = plate_thickness(stage, box);
    draw_plate(context, projection, box, thickness, stage.along_y, impact_plate_now(stage), -1.0);
    draw_plate(context, projection, box, thickness, stage.along_y, stage.support_plate_mm, 1.0);
  }
  if (stage.has_sides()) {
    const double thickness = kPlateShare * std::max(box.width(), box.height());
    draw_plate(context, projection, box, thickness, !stage.along_y, stage.side_low_mm, -1.0);
    draw_plate(context, projection, box, thickness, !stage.along_y, stage.side_high_mm, 1.0);
  }
  draw_faces(context, place, projection, box, stage.faces);
  draw_walls(context, projection, stage);
  draw_overlaps(context, projection, stage);
  draw_grips(context, projection, box, stage);
}

}  // namespace cellcrush::client
