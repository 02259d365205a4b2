#include "scene/pattern_builder.h"

namespace cellcrush {

PatternBuilder::PatternBuilder(GridPoint last)
    : columns_(last.first + 1), joints_(static_cast<std::size_t>(columns_) * (last.second + 1), -1) {}

void PatternBuilder::add_wall(GridPoint from, GridPoint to, int kind) {
  const int start = joint(from);
  const int end = joint(to);
  const int existing = find_wall(start, end);
  if (existing >= 0) {
    pattern_.walls[existing].kind |= kind;
    return;
  }
  const auto wall = static_cast<int>(pattern_.walls.size());
  pattern_.walls.push_back({start, end, kind});
  for (const auto& [here, there] : {std::pair(start, end), std::pair(end, start)}) {
    Neighbours& neighbours = neighbours_[here];
    neighbours.joint[neighbours.count] = there;
    neighbours.wall[neighbours.count++] = wall;
  }
}

int PatternBuilder::joint(GridPoint point) {
  int& joint = joints_[static_cast<std::size_t>(point.second) * columns_ + point.first];
  if (joint < 0) {
    joint = static_cast<int>(pattern_.joints.size());
    pattern_.joints.push_back(point);
    neighbours_.emplace_back();
  }
  return joint;
}

int PatternBuilder::find_wall(int start, int end) const {
  const Neighbours& neighbours = neighbours_[start];
  for (int i = 0; i < neighbours.count; ++i) {
    if (neighbours.joint[i] == end) {
      return neighbours.wall[i];
    }
  }
  return -1;
}

}  // namespace cellcrush
