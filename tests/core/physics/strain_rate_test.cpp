// Yield stresses that depend on the rate of the plastic strain (E6e): bars at constant rates, a cantilever struck by a
// mass, and the plateau of slow crushes. Blind to: rates in waves, and lattices at high speed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/dynamic_frames.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::strain_rates {
namespace {

constexpr double kModulus = 200000.0;  // E, MPa
constexpr double kYieldStress = 250.0;
constexpr double kLength = 10.0;  // mm

void put_cowper_symonds(MaterialSpec& material) {
  material.cowper_symonds_rate_per_s = 40.4;
  material.cowper_symonds_exponent = 5.0;
}

/// A perfectly plastic bar of constant area that is stretched to 2 % at a rate, held for as long, or stretched on at
/// another rate. Returns its stress after every step.
std::vector<double> stresses(const std::function<void(MaterialSpec&)>& put, double rate, double second_rate) {
  constexpr double kStrain = 0.02;
  constexpr int kSteps = 4000;
  const double time = kStrain / rate;
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 1.0, 1)};
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  frame.motions = {{1, FrameLattice::Component::x,
                    {{0.0, 0.0}, {time, kStrain * kLength}, {2.0 * time, (kStrain + second_rate * time) * kLength}}}};
  frame.end_time_s = 2.0 * time;
  SceneSpec spec = scenes::plastic_frame(std::move(frame), kModulus, kYieldStress);
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  put(spec.material);
  spec.numerics.time_step_s = std::min(time / kSteps, 1e-6);
  Simulation simulation(scenes::build(spec));
  std::vector<double> stresses;
  scenes::follow(simulation, [&](const State& state) { stresses.push_back(-state.internal_force[1].x()); });
  return stresses;
}

/// Stress at the end of the first stretch and of the second.
std::pair<double, double> ends_of(const std::vector<double>& stresses) {
  return {stresses[stresses.size() / 2 - 1], stresses.back()};
}

TEST(StrainRate, ABarThatFlowsSteadilyHasTheFactorOfItsRate) {
  const auto put_johnson_cook = [](MaterialSpec& material) {
    material.johnson_cook_coefficient = 0.014;
    material.johnson_cook_reference_rate_per_s = 2.0;
  };
  const auto put_table = [](MaterialSpec& material) {
    material.rate_table = {{1.0, 100.0, 1e4}, {1.0, 1.1, 1.3}};
  };
  const auto put_slow_table = [](MaterialSpec& material) { material.rate_table = {{0.01, 0.5}, {1.0, 1.2}}; };
  for (const double rate : {1.0, 30.0, 1000.0, 20000.0}) {
    SCOPED_TRACE(rate);
    const double second = 3.0 * rate;
    const auto expect = [&](const auto& put, const auto& factor) {
      const auto [slow, fast] = ends_of(stresses(put, rate, second));
      const double error =
          std::max(std::abs(slow / kYieldStress - factor(rate)), std::abs(fast / kYieldStress - factor(second)));
      scenes::record_bound("factor error", error, 1e-6);
    };
    expect(put_cowper_symonds, [](double at) { return 1.0 + std::pow(at / 40.4, 0.2); });
    expect(put_johnson_cook, [](double at) { return 1.0 + 0.014 * std::max(std::log(at / 2.0), 0.0); });
    expect(put_slow_table, [](double /*at*/) { return 1.2; });
    expect(put_table, [](double at) {
      const double decades = std::log10(std::clamp(at, 1.0, 1e4));
      return decades < 2.0 ? 1.0 + 0.05 * decades : 1.1 + 0.1 * (decades - 2.0);
    });
  }
}

/// E (e' - p') = sigma' with p' = D (sigma / sigma_y - 1)^q while the bar is held.
TEST(StrainRate, TheOverstressOfAHeldBarRelaxes) {
  const double rate = 100.0;
  const std::vector<double> all = stresses(put_cowper_symonds, rate, 0.0);
  const std::size_t held = all.size() / 2;
  double stress = all[held];
  const double step = 0.02 / rate / static_cast<double>(held);
  double worst = 0.0;
  for (std::size_t i = held + 1; i < all.size(); ++i) {
    EXPECT_LE(all[i], all[i - 1]) << i;
    constexpr int kParts = 20;
    for (int part = 0; part < kParts; ++part) {
      stress -= kModulus * step / kParts * 40.4 * std::pow(std::max(stress / kYieldStress - 1.0, 0.0), 5.0);
    }
    worst = std::max(worst, std::abs(all[i] - stress) / kYieldStress);
  }
  EXPECT_GT(all.back(), kYieldStress);
  scenes::record_bound("error of the relaxing stress over the yield stress", worst, 0.02);
}

/// A cantilever without inertia and elasticity but for the mass at its tip. The moment falls from the clamp to the tip;
/// where it is above the full one M0, M / M0 = 1 + 2 q / (2 q + 1) (kappa' h / 2 D)^(1/q), the integral of the stress
/// over a rectangle. The speed of the tip is the integral of kappa' (L - x).
class ViscoplasticCantilever {
  using Struck = scenes::StruckCantilever;

 public:
  ViscoplasticCantilever(double rate, double exponent) : rate_(rate), exponent_(exponent) {}

  /// Speed at a moment at the clamp over M0, mm/s.
  [[nodiscard]] double speed_at(double moment) const {
    constexpr int kParts = 400;
    const double end = 1.0 - 1.0 / moment;
    double sum = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const double x = end * (i + 0.5) / kParts;
      sum += std::pow((moment * (1.0 - x) - 1.0) * (2.0 * exponent_ + 1.0) / (2.0 * exponent_), exponent_) * (1.0 - x) *
             end / kParts;
    }
    return 2.0 * rate_ / Struck::kThickness * Struck::kLength * Struck::kLength * sum;
  }

  /// Deflection at rest, mm, of a mass in tonne struck to a speed in mm/s.
  [[nodiscard]] double deflection(double mass, double speed) const {
    double low = 1.0;
    double high = 10.0;
    for (int i = 0; i < 100; ++i) {
      const double middle = 0.5 * (low + high);
      (speed_at(middle) < speed ? low : high) = middle;
    }
    // The speed falls by M0 m / (mass L) a second.
    constexpr int kParts = 4000;
    double sum = 0.0;
    double before = speed;
    for (int i = 1; i <= kParts; ++i) {
      const double moment = low + (1.0 - low) * i / kParts;
      const double now = i == kParts ? 0.0 : speed_at(moment);
      const double middle = moment - 0.5 * (1.0 - low) / kParts;
      sum += (before - now) * 0.5 * (before + now) / middle;
      before = now;
    }
    return mass * Struck::kLength / Struck::kFullMoment * sum;
  }

 private:
  double rate_;
  double exponent_;
};

TEST(StrainRate, AStruckCantileverDeflectsAsTheViscoplasticOneDoes) {
  using Struck = scenes::StruckCantilever;
  constexpr double kHeavier = 3.0;  // than Parkes's mass, so that the beam's own hardly counts
  const double speed = Struck::kSpeed / std::sqrt(kHeavier);
  const double mass = kHeavier * Struck::kTipMass + Struck::kMassPerLength * Struck::kLength / 3.0;
  for (const auto& [rate, exponent] : {std::pair{40.4, 5.0}, std::pair{6500.0, 4.0}}) {
    SCOPED_TRACE(rate);
    const double duration = kHeavier * Struck::kTipMass * speed * Struck::kLength / Struck::kFullMoment;
    SceneSpec spec = Struck::spec(20, 2.0 * duration);
    auto& frame = std::get<FrameWalls>(spec.lattice);
    frame.nodes[1].attached_mass_g *= kHeavier;
    spec.loads.initial_velocities.front().y_m_per_s = speed * 1e-3;
    spec.material.cowper_symonds_rate_per_s = rate;
    spec.material.cowper_symonds_exponent = exponent;
    const double deflection = scenes::rest_of(scenes::run_frame(spec)).deflection;
    const double theory = ViscoplasticCantilever(rate, exponent).deflection(mass, speed);
    scenes::record_figure("deflection with D of " + std::to_string(static_cast<int>(rate)), deflection / theory, 3,
                          {1.0, 0.04});
  }
}

/// Plastic work of hexagons over that of hexagons that do not depend on the rate, less 1.
double excess_of_work(double speed, int columns, int rows) {
  const auto work = [&](bool depends) {
    SceneSpec spec = scenes::spec_of({"hexagon", speed, 0.0}, columns, rows);
    spec.loading.end_strain = 0.2;
    if (depends) put_cowper_symonds(spec.material);
    Simulation simulation(scenes::build(spec));
    return scenes::run_to_end(simulation).back().energies.plastic;
  };
  return work(true) / work(false) - 1.0;
}

/// At low inertia the factor is that of the hinges' rate, which is proportional to the speed.
TEST(StrainRate, TheWorkOfSlowHexagonsRisesWithThePowerOfTheSpeed) {
  const double slow = excess_of_work(0.2, 4, 4);
  const double fast = excess_of_work(0.8, 4, 4);
  scenes::record_figure("excess at 0.2 m/s", slow, 2);
  scenes::record_figure("ratio of the excesses over that of the speeds to 1 / q", fast / slow / std::pow(4.0, 0.2), 2,
                        {1.0, 0.1});
}

}  // namespace
}  // namespace cellcrush::strain_rates
