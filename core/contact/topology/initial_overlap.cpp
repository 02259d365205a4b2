#include "contact/topology/initial_overlap.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "contact/start_overlaps.h"
#include "contact/topology/wall_paths.h"
#include "contact/touch/force_laws.h"
#include "geometry/bucket_grid.h"

namespace cellcrush {
namespace {

/// Most pairs that are kept at a time.
constexpr std::size_t kBatch = 1 << 20;

struct Pair {
  int ball;
  int segment;
};

/// A segment that a ball overlaps.
struct Overlap {
  StartOverlap pair;  ///< of the wall, `nearest` is the segment
  double distance;    ///< mm

  [[nodiscard]] auto order() const { return std::tuple(pair.ball, pair.first_segment, distance, pair.nearest); }
};

/// Distance over reach up to which a ball is on the mid-line of a segment.
constexpr double kOnMidLine = 1e-6;

/// Points along elements, by which elements are found.
struct Marks {
  std::vector<Vector2> place;
  std::vector<int> element;
};

double twice_area(const Vector2& a, const Vector2& b, const Vector2& c) { return cross(b - a, c - a); }

/// Whether the bounding boxes of the segments from a to b and from c to d overlap. Elements of one straight wall lie on
/// one line, and round-off decides on which side of it their ends are. Their boxes show that they do not cross.
bool boxes_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d) {
  return (a.cwiseMin(b).array() <= c.cwiseMax(d).array()).all() &&
         (c.cwiseMin(d).array() <= a.cwiseMax(b).array()).all();
}

class OverlapFinder {
 public:
  OverlapFinder(const Scene& scene, std::size_t most_crossings) : scene_(scene), most_(most_crossings), paths_(scene) {
    const double count = static_cast<double>(scene.element_count());
    visits_left_ = kMostOverlapVisits * (count + static_cast<double>(scene.particle_count()));
    for (const Element& element : scene.elements) {
      mean_length_ += span_of(element).norm() / count;
    }
    for (std::size_t e = 0; e < scene.chain.size(); ++e) {
      const auto element = static_cast<int>(e);
      const auto [range, is_new] = chains_.try_emplace(scene.chain[e], element, element);
      range->second.second = element;
    }
  }

  /// Path lengths along the walls are computed only once it is known that few pairs need them.
  void find_touching() {
    double near_pairs = 0.0;
    visit_near_pairs([&](const Pair&) { near_pairs += 1.0; });
    if (near_pairs > kMostNearSegments * static_cast<double>(scene_.particle_count())) {
      visits_left_ = -1.0;
    }
    std::vector<Pair> pairs;
    if (near_pairs > 0.0) {
      visit_near_pairs([&](const Pair& pair) {
        pairs.push_back(pair);
        if (pairs.size() == kBatch) {
          keep_touching(pairs);
        }
      });
    }
    keep_touching(pairs);
  }

  /// Where two elements cross, each has a mark within half of a mean length.
  void find_crossing() {
    const Marks marks = place_marks();
    const BucketGrid grid(marks.place, mean_length_);
    for (std::size_t e = 0; e < scene_.element_count() && may_go_on(); ++e) {
      visit_round(grid, scene_.elements[e], 0.5 * mean_length_, [&](int mark) {
        if (marks.element[mark] > static_cast<int>(e)) {
          keep_crossing(static_cast<int>(e), marks.element[mark]);
        }
      });
    }
  }

  InitialOverlaps take() { return {std::move(crossings_), by_ball_and_wall(), visits_left_ < 0.0}; }

 private:
  [[nodiscard]] bool may_go_on() const { return visits_left_ >= 0.0 && crossings_.size() < most_; }

  [[nodiscard]] Vector2 span_of(const Element& element) const {
    return scene_.position[element.end] - scene_.position[element.start];
  }

  [[nodiscard]] double distance_to(const Element& element, int ball) const {
    const Vector2 span = span_of(element);
    const double length = span.norm();
    return project(scene_.position[ball], scene_.position[element.start], span / length, length).offset.norm();
  }

  /// Calls visit(pair) for balls that are nearer to a segment than radius plus half thickness.
  template <class Visit>
  void visit_near_pairs(Visit&& visit) {
    const BucketGrid grid(scene_.position, mean_length_ + scene_.largest_radius);
    for (std::size_t e = 0; e < scene_.element_count() && may_go_on(); ++e) {
      const Element& element = scene_.elements[e];
      const double margin = 0.5 * element.thickness;
      visit_round(grid, element, margin + scene_.largest_radius, [&](int ball) {
        const bool own = ball == element.start || ball == element.end || !has_elements(scene_, ball);
        if (!own && distance_to(element, ball) < margin + scene_.radius[ball]) {
          visit(Pair{ball, static_cast<int>(e)});
        }
      });
    }
  }

  template <class Visit>
  void visit_round(const BucketGrid& grid, const Element& element, double margin, Visit&& visit) {
    const Vector2& start = scene_.position[element.start];
    const Vector2& end = scene_.position[element.end];
    const Vector2 reach = Vector2::Constant(margin);
    grid.visit_box(start.cwiseMin(end) - reach, start.cwiseMax(end) + reach, [&](int found) {
      visits_left_ -= 1.0;
      if (visits_left_ >= 0.0) {
        visit(found);
      }
    });
  }

  /// Keeps the near pairs that are within their reach in the run (E8, E8a).
  void keep_touching(std::vector<Pair>& pairs) {
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.ball < b.ball; });
    for (const Pair& pair : pairs) {
      const double distance = distance_to(scene_.elements[pair.segment], pair.ball);
      const double reach = paths_.reach_of(pair.ball, pair.segment);
      if (distance < kOnMidLine * reach) {
        add(scene_.incidence[scene_.incidence_offset[pair.ball]], pair.segment, scene_.position[pair.ball]);
      } else if (distance < reach) {
        overlaps_.push_back({pair_of(pair), distance});
      }
    }
    pairs.clear();
  }

  /// The elements of a wall: from the first on, `stride` apart, before the end.
  struct ElementsOfWall {
    int wall;  ///< as listed
    int first;
    int end;
    int stride;
    int chain;  ///< of which they are (Scene::chain), or -1: all
  };

  /// Those of the wall that has an element.
  [[nodiscard]] ElementsOfWall wall_with(int element) const {
    if (scene_.can_break()) {
      const int chain = scene_.chain[element];
      const auto& [first, last] = chains_.at(chain);
      return {chain, first, last + 1, 1, chain};
    }
    if (element >= scene_.rigid.first_element) {
      const int wall = static_cast<int>(scene_.walls.start.size()) + element - scene_.rigid.first_element;
      return {scene_.list_order.listed_wall(wall), element, element + 1, 1, -1};
    }
    const auto after = std::ranges::upper_bound(scene_.walls.blocks, element, {}, &WallBlock::first_element);
    const WallBlock& block = *std::prev(after);
    const int of_block = (element - block.first_element) % block.walls;
    const int first = block.first_element + of_block;
    return {scene_.list_order.listed_wall(block.first_wall + of_block), first,
            first + (block.elements - 1) * block.walls + 1, block.walls, -1};
  }

  [[nodiscard]] bool has_particle(const ElementsOfWall& wall, int particle) const {
    for (int e = wall.first; e < wall.end; e += wall.stride) {
      if (wall.chain >= 0 && scene_.chain[e] != wall.chain) continue;
      if (scene_.elements[e].start == particle || scene_.elements[e].end == particle) return true;
    }
    return false;
  }

  /// The pair of a ball and the wall of a segment. Of the ball's own wall only the segment counts: it never parts from
  /// the rest.
  [[nodiscard]] StartOverlap pair_of(const Pair& found) const {
    const ElementsOfWall wall = wall_with(found.segment);
    StartOverlap pair = {found.ball,  wall_of_ball(found.ball, wall),
                         wall.wall,   found.segment,
                         wall.first,  wall.end,
                         wall.stride, wall.chain,
                         0.0};
    if (has_particle(wall, found.ball)) {
      pair.first_segment = found.segment;
      pair.end_segment = found.segment + 1;
      pair.stride = 1;
      pair.chain = -1;
    }
    return pair;
  }

  /// The wall of a ball, of a joint one that has a joint of the other wall, or else the first.
  [[nodiscard]] int wall_of_ball(int ball, const ElementsOfWall& other) const {
    const int first = scene_.incidence_offset[ball];
    if (scene_.can_break()) return scene_.chain[scene_.incidence[first]];
    for (int k = first; k < scene_.incidence_offset[ball + 1]; ++k) {
      const ElementsOfWall own = wall_with(scene_.incidence[k]);
      const int start = scene_.elements[own.first].start;
      if (has_particle(other, start == ball ? scene_.elements[own.end - 1].end : start)) return own.wall;
    }
    return wall_with(scene_.incidence[first]).wall;
  }

  /// What was found for a ball and a wall as one pair.
  StartOverlaps by_ball_and_wall() {
    std::ranges::sort(overlaps_, {}, &Overlap::order);
    StartOverlaps all;
    if (overlaps_.empty()) return all;
    all.offset.assign(scene_.particle_count() + 1, 0);
    for (const Overlap& overlap : overlaps_) {
      const bool is_known = !all.pairs.empty() && all.pairs.back().ball == overlap.pair.ball &&
                            all.pairs.back().first_segment == overlap.pair.first_segment;
      if (is_known) continue;
      all.pairs.push_back(overlap.pair);
      all.pairs.back().reach = kKeptDistance * overlap.distance;
      ++all.offset[overlap.pair.ball + 1];
    }
    std::partial_sum(all.offset.begin(), all.offset.end(), all.offset.begin());
    return all;
  }

  Marks place_marks() {
    Marks marks;
    for (std::size_t e = 0; e < scene_.element_count(); ++e) {
      const Vector2 span = span_of(scene_.elements[e]);
      const int pieces = static_cast<int>(std::ceil(span.norm() / mean_length_));
      for (int i = 0; i < pieces; ++i) {
        marks.place.push_back(scene_.position[scene_.elements[e].start] + (i + 0.5) / pieces * span);
        marks.element.push_back(static_cast<int>(e));
      }
    }
    return marks;
  }

  void keep_crossing(int first, int second) {
    const Element& one = scene_.elements[first];
    const Element& other = scene_.elements[second];
    const Vector2& a = scene_.position[one.start];
    const Vector2& b = scene_.position[one.end];
    const Vector2& c = scene_.position[other.start];
    const Vector2& d = scene_.position[other.end];
    const double of_start = twice_area(c, d, a);
    const double of_end = twice_area(c, d, b);
    if (!share_a_node(one, other) && boxes_meet(a, b, c, d) && of_start * of_end < 0.0 &&
        twice_area(a, b, c) * twice_area(a, b, d) < 0.0) {
      add(first, second, a + of_start / (of_start - of_end) * (b - a));
    }
  }

  void add(int first, int second, const Vector2& place) {
    const auto same = [&](const InitialCrossing& other) { return other.first == first && other.second == second; };
    if (crossings_.size() < most_ && std::none_of(crossings_.begin(), crossings_.end(), same)) {
      crossings_.push_back({first, second, place});
    }
  }

  const Scene& scene_;
  std::size_t most_;
  WallPaths paths_;
  std::map<int, std::pair<int, int>> chains_;  ///< first and last element of each chain, where walls can break
  double mean_length_ = 0.0;
  double visits_left_ = 0.0;
  std::vector<InitialCrossing> crossings_;
  std::vector<Overlap> overlaps_;
};

}  // namespace

std::vector<std::pair<int, int>> StartOverlaps::walls() const {
  std::vector<std::pair<int, int>> walls;
  for (const StartOverlap& pair : pairs) walls.emplace_back(std::minmax(pair.ball_wall, pair.wall));
  std::ranges::sort(walls);
  walls.erase(std::ranges::unique(walls).begin(), walls.end());
  return walls;
}

InitialOverlaps find_initial_overlaps(const Scene& scene, std::size_t most_crossings) {
  OverlapFinder finder(scene, most_crossings);
  finder.find_touching();
  finder.find_crossing();
  return finder.take();
}

}  // namespace cellcrush
