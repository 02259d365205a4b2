#pragma once

#include <cstdint>

namespace cellcrush {

/// SplitMix64 (Steele, Lea and Flood, 2014), because the distributions of the standard library differ between
/// implementations. The same seed gives the same numbers on every machine.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [-1, 1).
  double next() { return static_cast<double>(bits() >> 11U) * 0x1p-52 - 1.0; }

  /// Uniform in 0 to count - 1. REQUIRES: count below 2^32.
  std::uint64_t below(std::uint64_t count) { return ((bits() >> 32U) * count) >> 32U; }

 private:
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t mixed = state_;
    mixed = (mixed ^ (mixed >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27U)) * 0x94d049bb133111ebULL;
    return mixed ^ (mixed >> 31U);
  }

  std::uint64_t state_;
};

}  // namespace cellcrush
