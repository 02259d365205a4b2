#include "drawing/compact_network.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace cellcrush::drawing {
namespace {

using Network = v1::Lattice::Network;

constexpr int kMostSteps = 1'000'000'000;
constexpr int kStepsOfRounded = 1'000'000;
constexpr double kMostCounted = 9e15;  // a double counts that far

/// Counts lengths in steps.
class Counter {
 public:
  Counter(int steps_per_mm, Rounding rounding) : steps_(steps_per_mm), rounding_(rounding) {}

  /// Nothing if the length is not a number of steps.
  [[nodiscard]] std::optional<std::int64_t> count(double mm) const {
    const double steps = std::round(mm * steps_);
    if (!(std::abs(steps) < kMostCounted)) return std::nullopt;
    if (rounding_ == Rounding::none && steps / steps_ != mm) return std::nullopt;
    return static_cast<std::int64_t>(steps);
  }

 private:
  double steps_;
  Rounding rounding_;
};

std::optional<std::int32_t> narrow(std::int64_t value) {
  if (value < std::numeric_limits<std::int32_t>::min() || value > std::numeric_limits<std::int32_t>::max())
    return std::nullopt;
  return static_cast<std::int32_t>(value);
}

/// The compact form with so many steps in a mm.
std::optional<Network::Compact> compact(const Network& in, int steps_per_mm, Rounding rounding) {
  const Counter counter(steps_per_mm, rounding);
  Network::Compact out;
  out.set_steps_per_mm(steps_per_mm);
  std::int64_t before[2] = {};
  for (int i = 0; i < in.joints_mm_size(); ++i) {
    const auto place = counter.count(in.joints_mm(i));
    const auto difference = place ? narrow(*place - before[i % 2]) : std::nullopt;
    if (!difference) return std::nullopt;
    out.add_joint_differences(*difference);
    before[i % 2] = *place;
  }
  std::int64_t joint = 0;
  for (const int end : in.walls()) {
    const auto difference = narrow(end - joint);
    if (!difference) return std::nullopt;
    out.add_wall_differences(*difference);
    joint = end;
  }
  for (const double thickness : in.thicknesses_mm()) {
    const auto steps = counter.count(thickness);
    if (!steps || *steps < 1 || !narrow(*steps)) return std::nullopt;
    out.add_thicknesses(static_cast<std::int32_t>(*steps));
  }
  for (const double rise : in.rises_mm()) {
    const auto steps = counter.count(rise);
    if (!steps || !narrow(*steps)) return std::nullopt;
    out.add_rises(static_cast<std::int32_t>(*steps));
  }
  return out;
}

std::optional<Network::Compact> compact(const Network& in, Rounding rounding) {
  for (std::int64_t steps = 1; steps <= kMostSteps; steps *= 10) {
    if (auto out = compact(in, static_cast<int>(steps), Rounding::none)) return out;
  }
  for (int steps = rounding == Rounding::none ? 0 : kStepsOfRounded; steps > 0; steps /= 10) {
    if (auto out = compact(in, steps, rounding)) return out;
  }
  return std::nullopt;
}

}  // namespace

bool make_compact(Network& network, Rounding rounding) {
  if (network.has_compact()) return false;
  auto out = compact(network, rounding);
  if (!out) return false;
  network.clear_joints_mm();
  network.clear_walls();
  network.clear_thicknesses_mm();
  network.clear_rises_mm();
  *network.mutable_compact() = *std::move(out);
  return true;
}

}  // namespace cellcrush::drawing
