#pragma once

#include <optional>
#include <vector>

#include "chart/canvas.h"

namespace cellcrush::bench {

/// A text that belongs to a mark.
struct MarkLabel {
  double x = 0.0;  ///< middle of the mark
  double y = 0.0;
  double width = 0.0;
  double height = 0.0;
};

/// What a chart shows before its labels.
struct Drawn {
  std::vector<client::Rectangle> marks;  ///< no label covers one
  std::vector<client::Rectangle> lines;  ///< a label avoids these where another place is free
};

/// Whether two rectangles share more than an edge.
bool overlap(const client::Rectangle& one, const client::Rectangle& other);

/// A place for each label near its mark, inside `area`, that covers no mark and no other label. The first labels choose
/// first; one that finds no free place has none.
std::vector<std::optional<client::Rectangle>> place_labels(const std::vector<MarkLabel>& labels, const Drawn& drawn,
                                                           const client::Rectangle& area);

}  // namespace cellcrush::bench
