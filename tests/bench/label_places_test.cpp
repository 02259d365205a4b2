#include "bench/label_places.h"

#include <gtest/gtest.h>

#include <vector>

namespace cellcrush::bench {
namespace {

using client::Rectangle;

const Rectangle kArea{0.0, 0.0, 400.0, 300.0};

Drawn marks_of(const std::vector<MarkLabel>& labels) {
  Drawn drawn;
  drawn.marks.reserve(labels.size());
  for (const MarkLabel& label : labels) drawn.marks.push_back({label.x - 5.0, label.y - 5.0, 10.0, 10.0});
  return drawn;
}

TEST(LabelPlaces, OfACrowdCoverNeitherEachOtherNorAMark) {
  std::vector<MarkLabel> labels;
  for (const double y : {150.0, 155.0, 160.0}) {
    for (const double x : {200.0, 204.0, 208.0, 212.0}) labels.push_back({x, y, 60.0, 13.0});
  }
  const Drawn drawn = marks_of(labels);
  const auto places = place_labels(labels, drawn, kArea);
  std::vector<Rectangle> taken = drawn.marks;
  for (const auto& place : places) {
    ASSERT_TRUE(place.has_value());
    for (const Rectangle& other : taken) EXPECT_FALSE(overlap(*place, other));
    taken.push_back(*place);
  }
}

TEST(LabelPlaces, LieInsideTheArea) {
  const std::vector<MarkLabel> labels = {{398.0, 2.0, 60.0, 13.0}, {2.0, 298.0, 60.0, 13.0}};
  for (const auto& place : place_labels(labels, marks_of(labels), kArea)) {
    ASSERT_TRUE(place.has_value());
    EXPECT_GE(place->x, 0.0);
    EXPECT_GE(place->y, 0.0);
    EXPECT_LE(place->x + place->width, kArea.width);
    EXPECT_LE(place->y + place->height, kArea.height);
  }
}

TEST(LabelPlaces, OfASingleMarkIsToItsRightAndLeavesALineFree) {
  const std::vector<MarkLabel> labels = {{200.0, 150.0, 30.0, 13.0}};
  Drawn drawn = marks_of(labels);
  EXPECT_GT(place_labels(labels, drawn, kArea).front()->x, 200.0);
  for (double x = 200.0; x < 300.0; x += 4.0) drawn.lines.push_back({x, 149.0, 2.0, 2.0});
  const Rectangle place = *place_labels(labels, drawn, kArea).front();
  for (const Rectangle& line : drawn.lines) EXPECT_FALSE(overlap(place, line));
}

TEST(LabelPlaces, WithoutRoomThereIsNone) {
  const std::vector<MarkLabel> labels = {{200.0, 150.0, 30.0, 13.0}};
  EXPECT_FALSE(place_labels(labels, {{kArea}, {}}, kArea).front().has_value());
}

}  // namespace
}  // namespace cellcrush::bench
