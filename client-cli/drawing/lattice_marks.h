#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include <string>
#include <utility>
#include <vector>

#include "cellcrush/v1/cases_service.pb.h"
#include "drawing/drawing.h"

namespace cellcrush::drawing {

/// Joints, and walls between two of them.
struct Net {
  std::vector<DrawnPlace> joints;
  std::vector<std::pair<int, int>> walls;
};

/// Joints with one wall.
std::vector<DrawnPlace> find_loose_ends(const Net& net);

/// A joint of each part of the net but the one with most walls.
std::vector<DrawnPlace> find_islands(const Net& net);

/// Adds the places of a kind, in words, unless there are none.
void add_marks(v1::LatticeMarks::Kind kind, const std::vector<DrawnPlace>& places,
               google::protobuf::RepeatedPtrField<v1::LatticeMarks>& marks);

/// "3 loose ends, at (1, 2), (3, 4), (5, 6) mm".
std::string marks_text(const v1::LatticeMarks& marks);

}  // namespace cellcrush::drawing
