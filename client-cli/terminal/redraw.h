#pragma once

#include <string>
#include <vector>

namespace cellcrush::client {

/// Lines on a terminal that are drawn over those before, each redraw in one write. Nothing else may be printed in
/// between.
class Redraw {
 public:
  void show(const std::vector<std::string>& lines);

 private:
  int lines_ = 0;  ///< lines of the last redraw, above the cursor
};

}  // namespace cellcrush::client
