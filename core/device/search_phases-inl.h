#pragma once

// The phases of the contact search, of steps that search; see motion_phases-inl.h.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "contact/thickening.h"
#include "device/atomics-inl.h"
#include "device/crush-inl.h"
#include "simd/points-inl.h"

namespace cellcrush::HWY_NAMESPACE {

inline constexpr int kEndOfSegments = -1;

/// Positions beyond it are not searched, mm: the numbers of squares are whole.
inline constexpr double kFarthest = 1e7;

/// A square of the grid.
struct Square {
  int x;
  int y;

  friend HWY_INLINE bool operator==(const Square& a, const Square& b) { return a.x == b.x && a.y == b.y; }
};

HWY_INLINE Square square_at(const Crush& crush, double x, double y) {
  return {static_cast<int>(std::floor(x / crush.square_size)), static_cast<int>(std::floor(y / crush.square_size))};
}

HWY_INLINE Square square_of(const Crush& crush, int segment) {
  const Element& ends = crush.scene.elements[segment];
  const Vector2& start = crush.state.position[ends.start];
  const Vector2& end = crush.state.position[ends.end];
  return square_at(crush, 0.5 * (start.x() + end.x()), 0.5 * (start.y() + end.y()));
}

/// The list of a square.
HWY_INLINE std::size_t list_of(const Crush& crush, const Square& square) {
  const std::uint32_t mixed =
      static_cast<std::uint32_t>(square.x) * 73856093U ^ static_cast<std::uint32_t>(square.y) * 19349663U;
  return mixed & (crush.first_segment.size() - 1);
}

struct ClearGrid {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.first_segment.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t list, std::size_t /*step*/) {
    if (crush.totals[0].searches != 0) crush.first_segment[list] = kEndOfSegments;
  }
};

/// Puts a segment into the list of its square.
struct FileSegments {
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.next_segment.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t segment, std::size_t /*step*/) {
    if (crush.totals[0].searches == 0) return;
    const int number = static_cast<int>(segment);
    const double reach = crush.scene.greatest_radius + 0.5 * crush.state.length[segment] +
                         half_thickness_now(crush.scene, crush.state, number) + crush.scene.contact.face_skin;
    const Vector2& start = crush.state.position[crush.scene.elements[segment].start];
    const bool is_far = !(std::fabs(start.x()) < kFarthest && std::fabs(start.y()) < kFarthest);
    if (is_far || !(reach <= crush.square_size)) {
      crush.totals[0].overflow = 1;  // also where a position is not finite
      return;
    }
    crush.next_segment[segment] = exchange_at(crush.first_segment[list_of(crush, square_of(crush, number))], number);
  }
};

/// Lists the segments that a ball may touch before the next search.
class FindCandidates {
 public:
  static HWY_INLINE std::size_t items(const Crush& crush) { return crush.candidate_count.size(); }

  static HWY_INLINE void compute(Crush& crush, std::size_t item, std::size_t /*step*/) {
    if (crush.totals[0].searches == 0) return;
    const int ball = static_cast<int>(item);
    crush.candidate_count[ball] = 0;
    if (crush.scene.incidence_offset[ball] == crush.scene.incidence_offset[ball + 1]) return;
    const Vector2& place = crush.state.position[ball];
    if (!(std::fabs(place.x()) < kFarthest && std::fabs(place.y()) < kFarthest)) {
      crush.totals[0].overflow = 1;
      return;
    }
    const Square own = square_at(crush, place.x(), place.y());
    for (int x = own.x - 1; x <= own.x + 1; ++x) {
      for (int y = own.y - 1; y <= own.y + 1; ++y) look_into(crush, ball, {x, y});
    }
  }

 private:
  static HWY_INLINE void look_into(Crush& crush, int ball, const Square& square) {
    for (int segment = crush.first_segment[list_of(crush, square)]; segment != kEndOfSegments;
         segment = crush.next_segment[segment]) {
      if (square_of(crush, segment) == square && is_near(crush, ball, segment) && may_touch(crush, ball, segment)) {
        list(crush, ball, segment);
      }
    }
  }

  static HWY_INLINE bool is_near(const Crush& crush, int ball, int segment) {
    const Element& ends = crush.scene.elements[segment];
    if (ball == ends.start || ball == ends.end) return false;
    const Points<One> start = Points<One>::load(&crush.state.position[ends.start]);
    const Points<One> span = Points<One>::load(&crush.state.position[ends.end]) - start;
    const Points<One> away = Points<One>::load(&crush.state.position[ball]) - start;
    const Lane<One> share = min(max(dot(away, span) / dot(span, span), Lane<One>(0)), Lane<One>(1));
    const Points<One> off = away - share * span;
    const Lane<One> range = radius_now(crush.scene, crush.state, ball) +
                            half_thickness_now(crush.scene, crush.state, segment) + crush.scene.contact.face_skin;
    return all(dot(off, off) < range * range);
  }

  /// Whether they share a face, if that matters.
  static HWY_INLINE bool may_touch(const Crush& crush, int ball, int segment) {
    if (crush.ball_faces_offset.empty()) return true;
    for (int k = crush.segment_faces_offset[segment]; k < crush.segment_faces_offset[segment + 1]; ++k) {
      for (int j = crush.ball_faces_offset[ball]; j < crush.ball_faces_offset[ball + 1]; ++j) {
        if (crush.segment_faces[k] == crush.ball_faces[j]) return true;
      }
    }
    return false;
  }

  static HWY_INLINE void list(Crush& crush, int ball, int segment) {
    const int place = crush.candidate_count[ball];
    if (place == kMostCandidates) {
      crush.totals[0].overflow = 1;
      return;
    }
    crush.candidate[ball * kMostCandidates + place] = segment;
    crush.candidate_count[ball] = place + 1;
    for (int k = crush.scene.incidence_offset[ball]; k < crush.scene.incidence_offset[ball + 1]; ++k) {
      if (cross_each_other(crush, crush.scene.incidence[k], segment)) crush.totals[0].crossed = 1;
    }
  }

  /// Whether the centre lines of two elements without a common node cross.
  static HWY_INLINE bool cross_each_other(const Crush& crush, int one, int other) {
    const Element& first = crush.scene.elements[one];
    const Element& second = crush.scene.elements[other];
    return !share_a_node(first, second) && are_apart(crush, first, second) && are_apart(crush, second, first);
  }

  /// Whether the ends of an element are on both sides of a line.
  static HWY_INLINE bool are_apart(const Crush& crush, const Element& line, const Element& ends) {
    const Points<One> start = Points<One>::load(&crush.state.position[line.start]);
    const Points<One> span = Points<One>::load(&crush.state.position[line.end]) - start;
    const auto side_of = [&](int particle) {
      return cross(span, Points<One>::load(&crush.state.position[particle]) - start);
    };
    return all(side_of(ends.start) * side_of(ends.end) < Lane<One>(0));
  }
};

}  // namespace cellcrush::HWY_NAMESPACE
