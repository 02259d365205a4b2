#include "contact/search/face_pairs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>

#include "contact/search/candidate_lists.h"
#include "contact/start_overlaps.h"
#include "contact/thickening.h"
#include "contact/topology/face_loops.h"
#include "geometry/bucket_grid.h"

namespace cellcrush {
namespace {

/// The balls and segments of one face.
class FaceFinder {
 public:
  FaceFinder(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces, int face,
             double skin)
      : scene_(scene),
        state_(state),
        band_(band),
        number_(faces.number[face]),
        is_outer_(face == faces.count() - 1),
        is_whole_(!is_outer_ || faces.is_outer_whole),
        skin_(skin),
        count_(faces.corner_count(face)),
        segment_count_(faces.offset[face + 1] - faces.offset[face]),
        particle_(&faces.particle[faces.offset[face]]),
        element_(&faces.element[faces.offset[face]]) {
    place_.resize(filled_tiles(count_));
    for (int corner = 0; corner < count_; ++corner) {
      place_[corner] = state.position[particle_[corner]];
      largest_radius_ = std::max(largest_radius_, radius_now(scene, state, particle_[corner]));
    }
    for (int k = 0; k < segment_count_; ++k) {
      thickest_ = std::max(thickest_, half_thickness_now(scene, state, element_[k]));
      longest_ = std::max(longest_, state.length[element_[k]]);
    }
  }

  FacePairs find(bool over_grid) {
    if (over_grid) {
      visit_near();
    } else {
      visit_all();
    }
    pairs_.crossed = pairs_.crossed || (is_whole_ && is_turned());
    return std::move(pairs_);
  }

 private:
  /// Every pair, one segment after the other.
  void visit_all() {
    std::array<int, kManyCorners> corners;
    std::iota(corners.begin(), corners.end(), 0);
    double least = std::numeric_limits<double>::max();
    for (int k = 0; k < segment_count_; ++k) {
      least = std::min(least, keep_near(element_[k], std::span(corners).first(count_), place_));
    }
    pairs_.least_gap = std::max(skin_, std::sqrt(least) - largest_radius_ - thickest_);
  }

  /// Those in the buckets round a segment, as many at once as there is room for.
  void visit_near() {
    const BucketGrid grid({place_.data(), static_cast<std::size_t>(count_)}, 0.5 * longest_ + largest_radius_ + skin_);
    std::array<int, kManyCorners> corners;
    std::array<Vector2, kManyCorners> places;
    for (int k = 0; k < segment_count_; ++k) {
      const int e = element_[k];
      const Element& element = scene_.elements[e];
      const Vector2& start = state_.position[element.start];
      const Vector2& end = state_.position[element.end];
      const Vector2 margin = Vector2::Constant(range_of(e));
      std::size_t count = 0;
      grid.visit_box(start.cwiseMin(end) - margin, start.cwiseMax(end) + margin, [&](int i) {
        corners[count] = i;
        places[count] = place_[i];
        if (++count == corners.size()) {
          keep_near(e, corners, places);
          count = 0;
        }
      });
      if (count > 0) {
        keep_near(e, std::span(corners).first(count), places);
      }
    }
    pairs_.least_gap = skin_;
  }

  [[nodiscard]] bool is_turned() const {
    const double area = area_within({particle_, static_cast<std::size_t>(count_)}, state_.position);
    return is_outer_ ? area > 0.0 : area < 0.0;
  }

  /// Beyond it no corner is listed with a segment, mm.
  [[nodiscard]] double range_of(int segment) const {
    return largest_radius_ + half_thickness_now(scene_, state_, segment) + skin_;
  }

  /// Lists those of some corners that are near enough to a segment, but its ends. Returns the least squared distance of
  /// the others, mm^2. `places` has room for whole tiles. REQUIRES: at least one corner.
  double keep_near(int segment, std::span<const int> corners, std::span<Vector2> places) {
    const std::size_t count = corners.size();
    const std::size_t filled = filled_tiles(count);
    std::fill(places.begin() + count, places.begin() + filled, places[count - 1]);
    const Element& element = scene_.elements[segment];
    const FaceSegment line = {state_.position[element.start], state_.axis[segment], state_.length[segment]};
    const double range = range_of(segment);
    NearCorners found;
    find_near_corners(places.first(filled), count, line, range * range, found);
    for (std::uint64_t near = found.near; near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      const int particle = particle_[corners[i]];
      const bool is_end = particle == element.start || particle == element.end;
      if (!is_end && !keep(corners[i], segment, found.squared_distance[i])) {
        found.least_of_others = std::min(found.least_of_others, found.squared_distance[i]);
      }
    }
    return found.least_of_others;
  }

  /// Lists a pair that is near enough; says whether it was.
  bool keep(int corner, int segment, double squared_distance) {
    const int ball = particle_[corner];
    const double reach = greatest_reach(scene_, state_, ball, segment);
    if (squared_distance >= (reach + skin_) * (reach + skin_)) {
      return false;
    }
    const int before = corner > 0 ? corner - 1 : count_ - 1;
    const Element& element = scene_.elements[segment];
    pairs_.crossed = pairs_.crossed || cross_each_other(state_, scene_.elements[element_[before]], element) ||
                     cross_each_other(state_, scene_.elements[element_[corner]], element);
    if ((!is_outer_ || band_.owns(ball)) && !is_listed_elsewhere(ball, segment)) {
      pairs_.candidates.push_back({ball, segment, reach_now(scene_, state_, ball, segment)});
    }
    return true;
  }

  /// Whether a face with a lower number has both the ball and the segment.
  [[nodiscard]] bool is_listed_elsewhere(int ball, int segment) const {
    const std::vector<int>& side = scene_.faces.side;
    const std::span<const int> around(&scene_.incidence[scene_.incidence_offset[ball]],
                                      scene_.incidence_offset[ball + 1] - scene_.incidence_offset[ball]);
    const auto lists_it = [&](int face) {
      return face < number_ && std::any_of(around.begin(), around.end(), [&](int element) {
               return side[2 * element] == face || side[2 * element + 1] == face;
             });
    };
    const auto by_element = [](const ThickEnd& end, int element) { return end.element < element; };
    const std::vector<ThickEnd>& ends = scene_.faces.thick_ends;
    auto end = std::lower_bound(ends.begin(), ends.end(), segment, by_element);
    bool listed = lists_it(side[2 * segment]) || lists_it(side[2 * segment + 1]);
    for (; !listed && end != ends.end() && end->element == segment; ++end) {
      listed = lists_it(end->face);
    }
    return listed;
  }

  const Scene& scene_;
  const State& state_;
  const LatticeBand& band_;
  int number_;
  bool is_outer_;
  bool is_whole_;
  double skin_;
  int count_;          // of corners
  int segment_count_;  // from a corner to the next one, then thick ends
  const int* particle_;
  const int* element_;
  std::vector<Vector2> place_;
  double largest_radius_ = 0.0;
  double thickest_ = 0.0;  // half of it
  double longest_ = 0.0;
  FacePairs pairs_;
};

}  // namespace

FacePairs find_face_pairs(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces,
                          int face, double skin) {
  return FaceFinder(scene, state, band, faces, face, skin).find(has_many_corners(faces, face));
}

}  // namespace cellcrush
