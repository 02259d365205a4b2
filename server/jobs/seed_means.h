#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::jobs {

/// Results of a sweep that varies the seed, averaged over it. Holds the numbers of each job, not its row.
class SeedMeans {
 public:
  explicit SeedMeans(const v1::Sweep& sweep);

  /// Whether the sweep varies the seed.
  [[nodiscard]] bool varies_seed() const { return seed_.has_value(); }

  /// Adds the next row of the table. REQUIRES: varies_seed().
  void add(const v1::SweepTable::Row& row);

  /// Number of points that differ in more than the seed, and the means of one of them.
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] v1::SweepTable::SeedMeans means(std::size_t point) const;

 private:
  struct Point {
    v1::SweepTable::SeedMeans counts;          ///< without means
    std::vector<std::vector<double>> results;  ///< of each column
    std::map<v1::Summary::CrushMode, int> modes;
  };

  std::optional<std::size_t> seed_;  ///< index of the seed in the values of a row
  std::vector<Point> points_;
  std::map<std::vector<double>, std::size_t> places_;  ///< in points_, by the other values
};

}  // namespace cellcrush::jobs
