#pragma once

#include <google/protobuf/repeated_field.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cellcrush/v1/problem.pb.h"

namespace cellcrush::jobs {

/// Merges problems, or notes, that several points of a sweep share.
class PointProblems {
 public:
  /// What to merge: equal problems, or also those that differ only in their numbers.
  enum class Merge : std::uint8_t { equal, but_for_numbers };

  PointProblems(std::size_t points, Merge merge) : points_(points), merge_(merge) {}

  /// Adds a problem of the point at `position`; `point` describes the point.
  void add(const v1::Problem& problem, std::size_t position, const std::string& point);

  /// The merged problems, in the order of their first points and with the numbers of these. The message names the first
  /// point and counts the others, unless every point of the sweep has the same problem.
  [[nodiscard]] google::protobuf::RepeatedPtrField<v1::Problem> merged() const;

 private:
  struct Entry {
    v1::Problem problem;
    std::size_t first = 0;
    std::string point;
    std::size_t count = 0;
    bool is_equal = true;  ///< at all its points
  };

  [[nodiscard]] std::string key_of(const v1::Problem& problem) const;

  std::size_t points_;
  Merge merge_;
  std::map<std::string, std::size_t> seen_;
  std::vector<Entry> entries_;
};

}  // namespace cellcrush::jobs
