#include "contact/topology/initial_overlap.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
  OverlapFinder(const Scene& scene, std::size_t most) : scene_(scene), most_(most), paths_(scene) {
    const double count = static_cast<double>(scene.element_count());
    visits_left_ = kMostOverlapVisits * (count + static_cast<double>(scene.particle_count()));
    for (const Element& element : scene.elements) {
      mean_length_ += span_of(element).norm() / count;
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

  InitialOverlaps take() { return {std::move(found_), visits_left_ < 0.0}; }

 private:
  [[nodiscard]] bool may_go_on() const { return visits_left_ >= 0.0 && found_.size() < most_; }

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
        const bool own = ball == element.start || ball == element.end;
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
      if (distance_to(scene_.elements[pair.segment], pair.ball) < paths_.reach_of(pair.ball, pair.segment)) {
        add(scene_.incidence[scene_.incidence_offset[pair.ball]], pair.segment, scene_.position[pair.ball]);
      }
    }
    pairs.clear();
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
    const auto same = [&](const InitialOverlap& other) { return other.first == first && other.second == second; };
    if (found_.size() < most_ && std::none_of(found_.begin(), found_.end(), same)) {
      found_.push_back({first, second, place});
    }
  }

  const Scene& scene_;
  std::size_t most_;
  WallPaths paths_;
  double mean_length_ = 0.0;
  double visits_left_ = 0.0;
  std::vector<InitialOverlap> found_;
};

}  // namespace

InitialOverlaps find_initial_overlaps(const Scene& scene, std::size_t most) {
  OverlapFinder finder(scene, most);
  finder.find_touching();
  finder.find_crossing();
  return finder.take();
}

}  // namespace cellcrush
