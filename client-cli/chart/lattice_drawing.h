#pragma once

#include <string>
#include <vector>

#include "chart/canvas.h"
#include "connection/frames.h"

namespace cellcrush::client {

/// A range of the plane in mm, y upwards.
struct Box {
  double low_x = 0.0;
  double high_x = 0.0;
  double low_y = 0.0;
  double high_y = 0.0;

  [[nodiscard]] double width() const { return high_x - low_x; }
  [[nodiscard]] double height() const { return high_y - low_y; }
};

/// The box that contains every stage with its plates, at the start and now. REQUIRES: stages is not empty.
Box find_box(const std::vector<MeshFrame>& stages);

/// For each stage, the part of that box from its impact plate onwards, without the distance the plate has travelled.
/// The whole box for an explicit frame. REQUIRES: stages is not empty.
std::vector<Box> find_boxes(const std::vector<MeshFrame>& stages);

/// Whether the lattice stands between two plates; an explicit frame does not.
bool has_plates(const v1::Mesh& mesh);

/// Picture units per millimetre when `box` is drawn into `place`.
double drawing_scale(const Rectangle& place, const Box& box);

/// Draws a lattice and its plates into `place`, with the same scale for x and y: walls with their thickness, coloured
/// by plastic fraction.
void draw_lattice(cairo_t* context, const Rectangle& place, const Box& box, const MeshFrame& stage);

}  // namespace cellcrush::client
