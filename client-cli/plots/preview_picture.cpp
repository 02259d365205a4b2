#include "plots/preview_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "chart/lattice_drawing.h"
#include "plots/job_picture.h"
#include "plots/stage_panels.h"

namespace cellcrush::client {
namespace {

constexpr double kPreviewWidth = 1000.0;
constexpr double kPreviewEdge = 26.0;    // around all
constexpr double kPlateNameRoom = 22.0;  // for the name of a plate
constexpr double kPreviewTitleRoom = 54.0;
constexpr double kPreviewBarRoom = 30.0;
constexpr double kMarkRow = 20.0;
constexpr double kMarkRadius = 6.0;
constexpr double kIslandRadius = 10.0;  // round the loose end that is often there

/// One for each kind, readable beside each other with any colour vision (Okabe and Ito).
const Colour& mark_colour(v1::LatticeMarks::Kind kind) {
  static constexpr std::array<Colour, 10> kColours = {{{0.0, 0.0, 0.0},
                                                       {0.90, 0.62, 0.0},
                                                       {0.34, 0.71, 0.91},
                                                       {0.80, 0.47, 0.65},
                                                       {0.55, 0.34, 0.16},
                                                       {0.0, 0.45, 0.70},
                                                       {0.84, 0.10, 0.11},
                                                       {0.0, 0.62, 0.45},
                                                       {0.45, 0.30, 0.70},
                                                       {0.40, 0.40, 0.40}}};
  const auto at = static_cast<std::size_t>(kind);
  return kColours[at < kColours.size() ? at : 0];
}

void draw_mark_ring(cairo_t* context, double x, double y, const Colour& colour, double radius = kMarkRadius) {
  cairo_new_sub_path(context);
  cairo_arc(context, x, y, radius, 0.0, 2.0 * std::numbers::pi);
  set_colour(context, {1.0, 1.0, 1.0});
  cairo_set_line_width(context, 4.0);
  cairo_stroke_preserve(context);
  set_colour(context, colour);
  cairo_set_line_width(context, 2.0);
  cairo_stroke(context);
}

/// Where the lattice is drawn.
struct DrawnFrame {
  Box box;
  Rectangle place;

  [[nodiscard]] double scale() const { return drawing_scale(place, box); }
  [[nodiscard]] double x(double mm) const {
    return place.x + 0.5 * place.width + scale() * (mm - 0.5 * (box.low_x + box.high_x));
  }
  [[nodiscard]] double y(double mm) const {
    return place.y + 0.5 * place.height - scale() * (mm - 0.5 * (box.low_y + box.high_y));
  }
};

void draw_plate_names(cairo_t* context, const DrawnFrame& frame, const LatticeStage& stage) {
  if (!stage.has_plates()) return;
  const TextStyle style{.size = 11.5, .colour = kMutedInk, .anchor = Anchor::middle, .upwards = !stage.along_y};
  const double middle_x = frame.x(0.5 * (frame.box.low_x + frame.box.high_x));
  const double middle_y = frame.y(0.5 * (frame.box.low_y + frame.box.high_y));
  if (stage.along_y) {
    draw_text(context, middle_x, frame.y(frame.box.low_y) + 14.0, "impact plate", style);
    draw_text(context, middle_x, frame.y(frame.box.high_y) - 6.0, "support plate", style);
  } else {
    draw_text(context, frame.x(frame.box.low_x) - 6.0, middle_y, "impact plate", style);
    draw_text(context, frame.x(frame.box.high_x) + 14.0, middle_y, "support plate", style);
  }
}

void draw_marks(cairo_t* context, const DrawnFrame& frame, const v1::PreviewCaseResponse& preview) {
  for (const v1::LatticeMarks& marks : preview.marks()) {
    const double radius = marks.kind() == v1::LatticeMarks::ISLAND ? kIslandRadius : kMarkRadius;
    for (int i = 0; i + 1 < marks.places_mm_size(); i += 2) {
      draw_mark_ring(context, frame.x(marks.places_mm(i)), frame.y(marks.places_mm(i + 1)), mark_colour(marks.kind()),
                     radius);
    }
  }
}

/// What the marks mean, below each other.
void draw_mark_words(cairo_t* context, double left, double top, double width, const v1::PreviewCaseResponse& preview) {
  double y = top + 0.5 * kMarkRow;
  for (const v1::LatticeMarks& marks : preview.marks()) {
    draw_mark_ring(context, left + kMarkRadius, y, mark_colour(marks.kind()));
    const TextStyle style{.size = 12.5};
    draw_text(context, left + 3.0 * kMarkRadius, y + 4.0,
              fit_text(context, marks.words(), width - 3.0 * kMarkRadius, style), style);
    y += kMarkRow;
  }
}

std::string lattice_size_text(const v1::Mesh& mesh) {
  const double across = mesh.width_mm();
  const double along = mesh.length_mm();
  std::string text =
      fmt::format("{:.4g} mm wide, {:.4g} mm high", mesh.along_y() ? across : along, mesh.along_y() ? along : across);
  if (mesh.support_plate_mm() > mesh.impact_plate_mm())
    text += fmt::format(", crushed along {}", mesh.along_y() ? 'Y' : 'X');
  return text;
}

}  // namespace

std::string render_preview_picture(PictureFormat format, const std::string& title,
                                   const v1::PreviewCaseResponse& preview, const RigidWalls& rigid_walls,
                                   const PrintSize& print) {
  const v1::Mesh& mesh = preview.mesh();
  v1::FieldFrame field;
  *field.mutable_position_mm() = mesh.position_mm();
  field.mutable_plastic_fraction()->Resize(mesh.thickness_mm_size(), 0.0F);
  const LatticeStage stage = lattice_stage({field, mesh}, rigid_walls);
  const double width = print.width(kPreviewWidth);
  const bool has_title = print.width_mm == 0.0;
  const double top = kPreviewEdge + (has_title ? kPreviewTitleRoom : 0.0);
  DrawnFrame frame{.box = find_box({stage}), .place = {}};
  const double side = stage.has_plates() && !stage.along_y ? kPlateNameRoom : 0.0;
  const double above = stage.has_plates() && stage.along_y ? kPlateNameRoom : 0.0;
  const double inner = width - 2.0 * (kPreviewEdge + side);
  frame.place = {kPreviewEdge + side, top + above, inner,
                 std::min(kStagesHeight, inner * frame.box.height() / frame.box.width())};
  const double bar = frame.place.y + frame.place.height + above + kPreviewBarRoom;
  const double words = bar + 0.5 * kPreviewBarRoom;
  return render_picture(
      format, width, words + kMarkRow * preview.marks_size() + 0.5 * kPreviewEdge,
      [&](cairo_t* context) {
        if (has_title) {
          const TextStyle big{.size = 18.0, .bold = true};
          const TextStyle small{.size = 12.5, .colour = kMutedInk};
          draw_text(context, kPreviewEdge, kPreviewEdge + 14.0,
                    fit_text(context, title, width - 2.0 * kPreviewEdge, big), big);
          draw_text(context, kPreviewEdge, kPreviewEdge + 36.0,
                    fit_text(context, lattice_size_text(mesh), width - 2.0 * kPreviewEdge, small), small);
        }
        draw_lattice(context, frame.place, frame.box, stage);
        draw_plate_names(context, frame, stage);
        draw_marks(context, frame, preview);
        draw_scale_bar(context, width - kPreviewEdge - side, bar, frame.scale());
        draw_mark_words(context, kPreviewEdge, words, width - 2.0 * kPreviewEdge, preview);
      },
      print);
}

}  // namespace cellcrush::client
