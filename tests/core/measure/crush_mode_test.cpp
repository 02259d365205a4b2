#include "measure/crush_mode.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>

namespace cellcrush {
namespace {

/// A specimen of cells a unit apart, rows shifted by half a cell in turn as hexagons are.
CollapseField specimen(int columns, int rows, const std::function<bool(double, double)>& collapsed) {
  CollapseField field;
  field.length = columns;
  field.width = rows * std::sqrt(0.75);
  field.pitch = 1.0;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns - row % 2; ++column) {
      field.along.push_back(column + 0.5 + 0.5 * (row % 2));
      field.across.push_back((row + 0.5) * std::sqrt(0.75));
      field.collapsed.push_back(collapsed(field.along.back(), field.across.back()));
    }
  }
  return field;
}

/// Turns a share of the flags over, the same ones each time.
CollapseField with_noise(CollapseField field, double share) {
  std::mt19937_64 generator(20261121);
  for (auto&& flag : field.collapsed) {
    if (static_cast<double>(generator() >> 11) * 0x1p-53 < share) {
      flag.flip();
    }
  }
  return field;
}

/// The same lattice seen from the support end.
CollapseField turned_round(CollapseField field) {
  for (double& along : field.along) {
    along = field.length - along;
  }
  return field;
}

struct Size {
  int columns;
  int rows;
};

/// Fields of one kind at a size, as a function of the place within the specimen.
using Kind = std::function<bool(double s, double t, double length, double width)>;

void expect_mode(CrushMode mode, const Kind& kind, const std::string& what) {
  for (const Size& size : {Size{74, 21}, Size{24, 17}, Size{20, 40}, Size{30, 31}}) {
    const double width = size.rows * std::sqrt(0.75);
    const CollapseField field =
        specimen(size.columns, size.rows, [&](double s, double t) { return kind(s, t, size.columns, width); });
    const std::string where = what + " of " + std::to_string(size.columns) + " x " + std::to_string(size.rows);
    for (const CollapseField& seen : {field, turned_round(field), with_noise(field, 0.02)}) {
      EXPECT_EQ(find_crush_mode(seen), mode) << where;
    }
  }
}

TEST(CrushMode, BandsAcrossAreI) {
  expect_mode(
      CrushMode::i, [](double s, double, double length, double) { return s < 0.15 * length; }, "front");
  expect_mode(
      CrushMode::i, [](double s, double, double length, double) { return std::abs(s - 0.5 * length) < 2.0; }, "band");
  expect_mode(
      CrushMode::i, [](double s, double, double length, double) { return s < 2.5 || s > length - 2.5; },
      "bands at both ends");
}

TEST(CrushMode, ObliqueBandsThatMeetAreV) {
  expect_mode(
      CrushMode::v,
      [](double s, double t, double, double width) { return std::abs(s - 0.7 * std::abs(t - 0.5 * width)) < 1.5; },
      "V with its point at the impact end");
  expect_mode(
      CrushMode::v,
      [](double s, double t, double, double width) {
        return std::abs(s - 0.5 * width + 0.7 * std::abs(t - 0.5 * width)) < 1.5;
      },
      "V that opens to the impact end");
  expect_mode(
      CrushMode::v,
      [](double s, double t, double length, double) { return std::abs(std::abs(s - 0.5 * length) - 0.5 * t) < 1.5; },
      "V with its point on a side");
}

TEST(CrushMode, AVAtEitherEndIsStillV) {
  expect_mode(
      CrushMode::v,
      [](double s, double t, double length, double width) {
        const double arm = 0.6 * std::abs(t - 0.5 * width);
        return std::abs(s - arm) < 1.2 || std::abs(length - s - arm) < 1.2;
      },
      "two V");
}

TEST(CrushMode, ObliqueBandsThatCrossAreX) {
  expect_mode(
      CrushMode::x,
      [](double s, double t, double length, double width) {
        return std::abs(std::abs(s - 0.5 * length) - 0.6 * std::abs(t - 0.5 * width)) < 1.2;
      },
      "X in the middle");
}

TEST(CrushMode, ABowedBandIsC) {
  for (const double hand : {1.0, -1.0}) {
    expect_mode(
        CrushMode::c,
        [hand](double s, double t, double length, double width) {
          const double r = (t - 0.5 * width) / (0.5 * width);
          return std::abs(s - 0.5 * length - hand * (0.45 * width * r * r - 0.2 * width)) < 1.0;
        },
        "bow");
  }
}

TEST(CrushMode, CellsThatCollapseAnywhereAreMixed) {
  for (const double share : {0.1, 0.2, 0.25}) {
    const CollapseField field = with_noise(specimen(74, 21, [](double, double) { return false; }), share);
    EXPECT_EQ(find_crush_mode(field), CrushMode::mixed) << share;
  }
}

TEST(CrushMode, ASingleObliqueBandIsMixed) {
  const CollapseField field = specimen(30, 31, [](double s, double t) { return std::abs(s - 2.0 - t) < 1.5; });
  EXPECT_EQ(find_crush_mode(field), CrushMode::mixed);
}

TEST(CrushMode, AWholeLatticeHasNone) {
  EXPECT_EQ(find_crush_mode(specimen(20, 10, [](double, double) { return false; })), CrushMode::none);
  // Rows of 20 and 19 cells, of which 5 and 4 have collapsed.
  EXPECT_EQ(collapsed_fraction_of(specimen(20, 10, [](double s, double) { return s < 5.0; })), 9.0 / 39.0);
}

}  // namespace
}  // namespace cellcrush
