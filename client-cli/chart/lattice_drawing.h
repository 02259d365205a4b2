#pragma once

#include <vector>

#include "chart/canvas.h"

namespace cellcrush::client {

/// The face of a rigid wall: a point of it, mm, and the unit normal out of the wall.
struct WallFace {
  double x = 0.0;
  double y = 0.0;
  double normal_x = 0.0;
  double normal_y = 0.0;
};

/// A lattice at one instant, between two plates or, as an explicit frame, without any.
struct LatticeStage {
  std::vector<float> position_mm{};       ///< x and y of each particle
  std::vector<int> element_nodes{};       ///< two particles per wall
  std::vector<float> thickness_mm{};      ///< of each wall
  std::vector<float> plastic_fraction{};  ///< of each wall
  int rigid_elements = 0;                 ///< the last ones, of stiff cells or rigid links
  std::vector<int> overlap_particle{};    ///< whose walls overlapped others before loading
  double impact_plate_mm = 0.0;           ///< face of the plate at the start
  double support_plate_mm = 0.0;
  bool along_y = false;      ///< the direction of loading
  double side_low_mm = 0.0;  ///< faces of the side walls; equal without any
  double side_high_mm = 0.0;
  std::vector<int> gripped{};     ///< particles that grips hold
  std::vector<WallFace> faces{};  ///< of rigid walls
  double strain = 0.0;
  double time_s = 0.0;

  [[nodiscard]] bool has_plates() const { return support_plate_mm > impact_plate_mm; }
  [[nodiscard]] bool has_sides() const { return side_high_mm > side_low_mm; }
};

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
Box find_box(const std::vector<LatticeStage>& stages);

/// For each stage, the part of that box from its impact plate onwards, without the distance the plate has travelled.
/// The whole box for an explicit frame. REQUIRES: stages is not empty.
std::vector<Box> find_boxes(const std::vector<LatticeStage>& stages);

/// Picture units per millimetre when `box` is drawn into `place`.
double drawing_scale(const Rectangle& place, const Box& box);

/// Draws a lattice with its plates, side walls, rigid walls and grips into `place`, with the same scale for x and y:
/// walls with their thickness, coloured by plastic fraction; rigid ones on top, in the colour of the plates; rings
/// where walls overlapped before loading.
void draw_lattice(cairo_t* context, const Rectangle& place, const Box& box, const LatticeStage& stage);

}  // namespace cellcrush::client
