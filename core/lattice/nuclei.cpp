#include "lattice/nuclei.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "lattice/draw.h"

namespace cellcrush {
namespace {

constexpr std::int64_t kMostUnits = std::int64_t{1} << 28U;  // of a period: squares of distances fit into 64 bits
constexpr int kMovesOfNucleus = 50;

/// Finds nuclei near a place, over buckets of about one nucleus each.
class NucleusGrid {
 public:
  NucleusGrid(const Nuclei& nuclei, int columns, int rows)
      : nuclei_(nuclei), columns_(columns), rows_(rows), buckets_(static_cast<std::size_t>(columns) * rows) {
    for (std::size_t i = 0; i < nuclei.places.size(); ++i) bucket_of(nuclei.places[i]).push_back(static_cast<int>(i));
  }

  /// Whether no nucleus but `self` is closer to a place. Buckets are as wide as the greatest such distance, and 0.86 of
  /// it high.
  [[nodiscard]] bool has_room(int self, const GridPlace& place, std::int64_t least_squared) const {
    const int column = column_of(place);
    const int row = row_of(place);
    for (int up = -2; up <= 2; ++up) {
      for (int right = -1; right <= 1; ++right) {
        for (const int other : bucket((column + right + columns_) % columns_, (row + up + 2 * rows_) % rows_)) {
          if (other != self && squared_distance(place, nuclei_.places[other]) < least_squared) return false;
        }
      }
    }
    return true;
  }

  void move(int nucleus, const GridPlace& from, const GridPlace& to) {
    std::vector<int>& old = bucket_of(from);
    std::vector<int>& next = bucket_of(to);
    if (&old == &next) return;
    old.erase(std::ranges::find(old, nucleus));
    next.push_back(nucleus);
  }

 private:
  [[nodiscard]] int column_of(const GridPlace& place) const {
    return static_cast<int>(place.x * columns_ / nuclei_.period.x);
  }
  [[nodiscard]] int row_of(const GridPlace& place) const {
    return static_cast<int>(place.y * rows_ / nuclei_.period.y);
  }
  [[nodiscard]] const std::vector<int>& bucket(int column, int row) const {
    return buckets_[static_cast<std::size_t>(row) * columns_ + column];
  }
  std::vector<int>& bucket_of(const GridPlace& place) {
    return buckets_[static_cast<std::size_t>(row_of(place)) * columns_ + column_of(place)];
  }
  [[nodiscard]] std::int64_t squared_distance(const GridPlace& one, const GridPlace& other) const {
    const auto nearest = [](std::int64_t distance, std::int64_t period) {
      const std::int64_t inside = std::abs(distance);
      return std::min(inside, period - inside);
    };
    const std::int64_t x = nearest(one.x - other.x, nuclei_.period.x);
    const std::int64_t y = nearest(one.y - other.y, nuclei_.period.y);
    return x * x + y * y;
  }

  const Nuclei& nuclei_;
  int columns_;
  int rows_;
  std::vector<std::vector<int>> buckets_;
};

/// No edge of the rectangle then lies on a wall.
Nuclei regular_nuclei(int columns, int rows) {
  Nuclei nuclei;
  nuclei.pitch = kMostUnits / std::max(columns, rows) / 4 * 4;
  const std::int64_t row_pitch = std::llround(0.5 * std::numbers::sqrt3 * static_cast<double>(nuclei.pitch) / 2.0) * 2;
  nuclei.period = {columns * nuclei.pitch, rows * row_pitch};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::int64_t shift = row % 2 == 0 ? nuclei.pitch / 4 : 3 * (nuclei.pitch / 4);
      nuclei.places.push_back({column * nuclei.pitch + shift, row * row_pitch + row_pitch / 2});
    }
  }
  return nuclei;
}

}  // namespace

Nuclei place_nuclei(const VoronoiWalls& lattice) {
  Nuclei nuclei = regular_nuclei(*lattice.columns, *lattice.rows);
  const double irregularity = *lattice.irregularity;
  const auto pitch = static_cast<double>(nuclei.pitch);
  const auto reach = static_cast<std::uint64_t>(irregularity * pitch);
  if (reach == 0) return nuclei;
  constexpr std::int64_t kRounding = 2;
  const std::int64_t least =
      std::max<std::int64_t>(1, static_cast<std::int64_t>((1.0 - irregularity) * pitch) - kRounding);
  NucleusGrid grid(nuclei, *lattice.columns, *lattice.rows);
  Draw draw(lattice.seed);
  const auto offset = [&] {
    return static_cast<std::int64_t>(draw.below(2 * reach + 1)) - static_cast<std::int64_t>(reach);
  };
  for (int round = 0; round < kMovesOfNucleus; ++round) {
    for (std::size_t i = 0; i < nuclei.places.size(); ++i) {
      const GridPlace from = nuclei.places[i];
      const std::int64_t right = offset();
      const GridPlace to = nuclei.wrapped({from.x + right, from.y + offset()});
      if (!grid.has_room(static_cast<int>(i), to, least * least)) continue;
      grid.move(static_cast<int>(i), from, to);
      nuclei.places[i] = to;
    }
  }
  return nuclei;
}

}  // namespace cellcrush
