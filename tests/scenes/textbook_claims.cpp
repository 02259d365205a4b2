#include "scenes/textbook_claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/textbook.h"

namespace cellcrush::scenes {
namespace {

/// Plastic work of each cycle of equal length in time.
std::vector<double> plastic_work_by_cycle(const std::vector<Sample>& samples, int cycles) {
  const double period = samples.back().time / cycles;
  std::vector<double> total(cycles, 0.0);
  for (const Sample& sample : samples) {
    const int cycle = std::min(cycles - 1, static_cast<int>(sample.time / period * (1.0 - 1e-12)));
    total[cycle] = sample.energies.plastic;
  }
  for (int i = cycles - 1; i > 0; --i) {
    total[i] -= total[i - 1];
  }
  return total;
}

}  // namespace

std::pair<double, double> expect_moment_curvature_law(const std::vector<Sample>& samples, double peak) {
  const double yield_moment = PlasticFrame::kYieldMoment;
  const double yield_curvature = yield_moment / PlasticFrame::kStiffness;
  const double end = samples.back().time;
  const auto moment_at = [&](double time) { return peak * yield_moment * 2.0 * std::min(time, end - time) / end; };
  double worst = 0.0;
  for (const Sample& sample : samples) {
    const double ratio = sample.watched.front().rotation / PlasticFrame::kLength / yield_curvature;
    if (sample.time < 0.5 * end && ratio > 0.5) {
      const double exact = ratio <= 1.0 ? ratio : 0.99 * (1.5 - 0.5 / (ratio * ratio)) + 0.01 * ratio;
      worst = std::max(worst, std::abs(moment_at(sample.time) / yield_moment / exact - 1.0));
    }
  }
  EXPECT_LT(worst, 0.05);  // ten Lobatto points
  const Sample& top = samples[samples.size() * 6 / 10];
  const Sample& bottom = samples[samples.size() * 9 / 10];
  const double slope = (moment_at(top.time) - moment_at(bottom.time)) * PlasticFrame::kLength /
                       (top.watched.front().rotation - bottom.watched.front().rotation);
  EXPECT_NEAR(slope / PlasticFrame::kStiffness, 1.0, 0.01);
  EXPECT_GT(samples.back().watched.front().rotation / PlasticFrame::kLength / yield_curvature, 0.5);
  return {worst, slope / PlasticFrame::kStiffness - 1.0};
}

double expect_closed_cycles(const std::vector<Sample>& samples, int cycles) {
  const std::vector<double> work = plastic_work_by_cycle(samples, cycles);
  double worst = 0.0;
  for (int i = 2; i < cycles; ++i) {
    worst = std::max(worst, std::abs(work[i] / work[1] - 1.0));
    EXPECT_NEAR(work[i] / work[1], 1.0, 0.01) << "cycle " << i + 1;
  }
  EXPECT_GT(work[1], 0.0);
  return worst;
}

double expect_shakedown(const std::vector<Sample>& samples, int cycles) {
  const std::vector<double> work = plastic_work_by_cycle(samples, cycles);
  for (int i = cycles / 2; i < cycles; ++i) {
    EXPECT_LT(work[i], 0.9 * work[i - 1]) << "cycle " << i + 1;
  }
  const double share = work.back() / *std::max_element(work.begin(), work.end());
  EXPECT_LT(share, 0.2);
  return share;
}

double expect_limit_load(const std::vector<Sample>& samples, double WatchedNode::*component, double factor) {
  const double limit = factor * PlasticFrame::kFullMoment / PlasticFrame::kLength;
  const std::vector<ForceAt> curve = force_curve(samples, component);
  const auto mean_force = [&](std::size_t from, std::size_t to) {
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      sum += std::abs(curve[i].force);
    }
    return sum / static_cast<double>(to - from);
  };
  const double before = mean_force(curve.size() * 6 / 10, curve.size() * 8 / 10);
  const double last = mean_force(curve.size() * 8 / 10, curve.size());
  EXPECT_NEAR(last / limit, 1.0, 0.01);
  EXPECT_NEAR(last / before, 1.0, 0.02);  // it stays there
  return last / limit;
}

std::pair<double, double> expect_lee_limit(const std::vector<Sample>& samples) {
  const std::vector<ForceAt> curve = force_curve(samples, &WatchedNode::uy);
  const auto peak = std::max_element(curve.begin(), curve.end(),
                                     [](const ForceAt& a, const ForceAt& b) { return -a.force < -b.force; });
  EXPECT_NEAR(-peak->force, 1.8557, 0.01 * 1.8557);
  EXPECT_NEAR(-peak->displacement, 48.74, 1.0);
  return {-peak->force, -peak->displacement};
}

double expect_end_angle(const std::vector<Sample>& samples, double degrees) {
  const double error = samples.back().watched.front().rotation * 180.0 / std::numbers::pi / degrees - 1.0;
  EXPECT_LT(std::abs(error), 0.015) << degrees;
  return error;
}

}  // namespace cellcrush::scenes
