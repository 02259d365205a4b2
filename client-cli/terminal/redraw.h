#pragma once

#include <string>
#include <vector>

namespace cellcrush::client {

/// Lines redrawn in place on a terminal, each redraw in one write. Nothing else may be printed in between.
class Redraw {
 public:
  void show(const std::vector<std::string>& lines);

 private:
  int lines_ = 0;  ///< lines of the last redraw above the cursor
};

}  // namespace cellcrush::client
