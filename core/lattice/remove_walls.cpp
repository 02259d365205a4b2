#include "lattice/remove_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "lattice/cut_walls.h"
#include "lattice/draw.h"

namespace cellcrush {
namespace {

/// The walls that are left, as neighbours of joints.
class WallGraph {
 public:
  explicit WallGraph(const Layout& layout)
      : walls_(layout.walls), walls_of_(layout.joints.size()), seen_by_(layout.joints.size(), 0) {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
      for (const int joint : {walls_[w].start, walls_[w].end}) walls_of_[joint].push_back(static_cast<int>(w));
    }
  }

  [[nodiscard]] std::size_t count_at(int joint) const { return walls_of_[joint].size(); }

  void remove(int wall) {
    for (const int joint : {walls_[wall].start, walls_[wall].end}) std::erase(walls_of_[joint], wall);
  }

  /// Whether the other walls at both ends of one would be in two parts without it. Looks round both ends by turns: in
  /// most lattices the way round a cell is short.
  bool is_bridge(int wall) {
    std::array<std::vector<int>, 2> found = {std::vector{walls_[wall].start}, std::vector{walls_[wall].end}};
    std::array<std::size_t, 2> next = {0, 0};
    look_ += 2;
    for (const int side : {0, 1}) seen_by_[found[side][0]] = look_ + side;
    for (int side = 0;; side = 1 - side) {
      if (next[side] == found[side].size()) return found[side].size() > 1;
      const int joint = found[side][next[side]++];
      for (const int other : walls_of_[joint]) {
        if (other == wall) continue;
        const int neighbour = walls_[other].start == joint ? walls_[other].end : walls_[other].start;
        if (seen_by_[neighbour] == look_ + 1 - side) return false;
        if (seen_by_[neighbour] == look_ + side) continue;
        seen_by_[neighbour] = look_ + side;
        found[side].push_back(neighbour);
      }
    }
  }

 private:
  const std::vector<LayoutWall>& walls_;
  std::vector<std::vector<int>> walls_of_;
  std::vector<std::int64_t> seen_by_;  ///< look_ of the last search from the start, one more from the end
  std::int64_t look_ = 0;
};

std::vector<int> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  Draw draw(seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[draw.below(i)]);
  return order;
}

}  // namespace

void scatter_thicknesses(const Defects& defects, Layout& layout) {
  if (defects.thickness_scatter == 0.0) return;
  Draw draw(defects.seed);
  for (LayoutWall& wall : layout.walls) wall.thickness *= 1.0 + defects.thickness_scatter * draw.next();
}

Removal remove_walls(const Defects& defects, Layout& layout) {
  Removal removal;
  const auto wanted = static_cast<int>(std::llround(defects.missing_walls * static_cast<double>(layout.walls.size())));
  if (wanted == 0) return removal;
  WallGraph graph(layout);
  std::vector<char> had_more(layout.joints.size(), 0);
  for (std::size_t joint = 0; joint < had_more.size(); ++joint)
    had_more[joint] = graph.count_at(static_cast<int>(joint)) > 1;
  std::vector<char> is_kept(layout.walls.size(), 1);
  const std::vector<int> order = shuffled(layout.walls.size(), ~defects.seed);
  // A wall that was passed over may be the last one of its part later.
  while (removal.walls < wanted) {
    for (const int wall : order) {
      if (removal.walls == wanted) break;
      if (is_kept[wall] == 0 || graph.is_bridge(wall)) continue;
      graph.remove(wall);
      is_kept[wall] = 0;
      ++removal.walls;
    }
  }
  for (std::size_t joint = 0; joint < had_more.size(); ++joint) {
    removal.free_ends += had_more[joint] != 0 && graph.count_at(static_cast<int>(joint)) == 1 ? 1 : 0;
  }
  keep_walls(is_kept, layout);
  return removal;
}

}  // namespace cellcrush
