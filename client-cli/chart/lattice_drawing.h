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

/// The box that holds every stage with its plates, at the start and now. REQUIRES: stages is not empty.
Box find_box(const std::vector<MeshFrame>& stages);

/// For each stage the part of that box from its impact plate on: without the way that the plate has travelled. An
/// explicit frame has the whole box. REQUIRES: stages is not empty.
std::vector<Box> find_boxes(const std::vector<MeshFrame>& stages);

/// Whether the lattice stands between two plates; an explicit frame does not.
bool has_plates(const v1::Mesh& mesh);

/// Units of the picture a millimetre takes when `box` is drawn into `place`.
double drawing_scale(const Rectangle& place, const Box& box);

/// Draws a lattice and its plates into `place`, at one scale for x and y: walls with their thickness, coloured by
/// plastic fraction.
void draw_lattice(cairo_t* context, const Rectangle& place, const Box& box, const MeshFrame& stage);

}  // namespace cellcrush::client
