// Curves of hardening (E6d) against the curve itself, in bars and sections whose ends are moved to and fro. Blind to:
// rates (strain_rate_test.cpp), several elements, and cycles of axial force and moment together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "cellcrush/scene.h"
#include "scenes/cycled_element.h"
#include "scenes/evidence.h"
#include "section/section_rule.h"

namespace cellcrush::hardening_curves {
namespace {

using scenes::CycledElement;

constexpr double kModulus = 70000.0;  // E, MPa
constexpr double kYieldStress = 200.0;

/// A material, and the increase of its yield stress over plastic strain in the words of its definition.
struct Curve {
  const char* name;
  std::function<void(MaterialSpec&)> put;
  std::function<double(double)> increase;
};

void put_table(MaterialSpec& material, HardeningTable::Beyond beyond) {
  material.hardening_table = {{0.0, 0.001, 0.004, 0.012}, {200.0, 220.0, 250.0, 270.0}, beyond};
}

double in_table(double p) {
  if (p < 0.001) return 20000.0 * p;
  if (p < 0.004) return 20.0 + 10000.0 * (p - 0.001);
  return 50.0 + 2500.0 * (std::min(p, 0.012) - 0.004);
}

const std::vector<Curve>& curves() {
  static const std::vector<Curve> kCurves = {
      {"Voce",
       [](MaterialSpec& material) {
         material.voce_stress_mpa = 150.0;
         material.voce_exponent = 60.0;
       },
       [](double p) { return 150.0 * (1.0 - std::exp(-60.0 * p)); }},
      {"VoceAndLinear",
       [](MaterialSpec& material) {
         material.hardening_modulus_mpa = 500.0;
         material.voce_stress_mpa = 80.0;
         material.voce_exponent = 200.0;
       },
       [](double p) { return 500.0 * p + 80.0 * (1.0 - std::exp(-200.0 * p)); }},
      {"Ludwik",
       [](MaterialSpec& material) {
         material.ludwik_stress_mpa = 400.0;
         material.ludwik_exponent = 0.34;
       },
       [](double p) { return 400.0 * std::pow(p, 0.34); }},
      {"TableThenConstant", [](MaterialSpec& material) { put_table(material, HardeningTable::Beyond::constant); },
       in_table},
      {"TableThenLastSlope", [](MaterialSpec& material) { put_table(material, HardeningTable::Beyond::last_slope); },
       [](double p) { return in_table(p) + 2500.0 * std::max(p - 0.012, 0.0); }},
      {"TableThenPower", [](MaterialSpec& material) { put_table(material, HardeningTable::Beyond::power_law); },
       [](double p) {
         const double exponent = 2500.0 * 0.012 / 270.0;
         return p < 0.012 ? in_table(p) : 270.0 * std::pow(p / 0.012, exponent) - 200.0;
       }}};
  return kCurves;
}

MaterialSpec material_of(const Curve& curve, double isotropic_fraction) {
  MaterialSpec material;
  material.youngs_modulus_mpa = kModulus;
  material.yield_stress_mpa = kYieldStress;
  material.density_kg_per_m3 = 2700.0;
  material.isotropic_fraction = isotropic_fraction;
  curve.put(material);
  return material;
}

/// A bar whose strain goes to and fro: in one direction since the last turn, s (sigma - alpha) = sigma_y + beta c(p)
/// and alpha changes by (1 - beta) s dc. Its plastic strain p is found by bisection.
class CurvedBar {
 public:
  CurvedBar(const Curve& curve, double isotropic) : curve_(curve), isotropic_(isotropic) {}

  double stress_at(double strain) { return after(strain).stress; }

  void turn_at(double strain) {
    *this = after(strain);
    strain_ = strain;
  }

 private:
  CurvedBar after(double strain) const {
    CurvedBar bar = *this;
    bar.stress = stress + kModulus * (strain - strain_);
    const double side = bar.stress < back_ ? -1.0 : 1.0;
    const auto excess = [&](double flow) {
      const double more = curve_.get().increase(plastic_ + flow) - curve_.get().increase(plastic_);
      return side * (bar.stress - back_) - kModulus * flow - more - kYieldStress -
             isotropic_ * curve_.get().increase(plastic_);
    };
    if (excess(0.0) <= 0.0) return bar;
    double low = 0.0;
    double high = side * (bar.stress - back_) / kModulus;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (excess(middle) > 0.0 ? low : high) = middle;
    }
    bar.stress -= side * kModulus * low;
    bar.back_ += (1.0 - isotropic_) * side * (curve_.get().increase(plastic_ + low) - curve_.get().increase(plastic_));
    bar.plastic_ = plastic_ + low;
    return bar;
  }

  std::reference_wrapper<const Curve> curve_;
  double isotropic_;
  double strain_ = 0.0;
  double stress = 0.0;
  double back_ = 0.0;
  double plastic_ = 0.0;
};

/// Worst error over the yield stress between +-`amplitude` of elongation over length.
double worst_error(const Curve& curve, double isotropic, double amplitude) {
  const TimeFunction points{CycledElement::to_and_fro(amplitude)};
  CurvedBar bar(curve, isotropic);
  double worst = 0.0;
  CycledElement::run(
      CycledElement::stretched(amplitude, material_of(curve, isotropic)),
      [&](double side) { bar.turn_at(side * amplitude); },
      [&](double time, double force, double) {
        const double stress = bar.stress_at(points.value_at(time));
        worst = std::max(worst, std::abs(force / CycledElement::kThickness - stress) / kYieldStress);
      });
  return worst;
}

TEST(HardeningCurves, ABarFollowsThemInCycles) {
  constexpr double kFarBeyondTheTables = 0.05;
  for (const Curve& curve : curves()) {
    for (const double isotropic : {0.0, 0.4, 1.0}) {
      for (const double amplitude : {0.006, kFarBeyondTheTables}) {
        SCOPED_TRACE(std::string(curve.name) + ", beta " + std::to_string(isotropic));
        scenes::record_bound("stress error", worst_error(curve, isotropic, amplitude), 1e-6);
      }
    }
  }
}

/// Moment of the section that bends to a curvature for the first time, by the midpoints of many layers.
double first_moment(const Curve& curve, double curvature) {
  constexpr int kLayers = 500;
  CurvedBar fresh(curve, 1.0);
  double moment = 0.0;
  for (int i = 0; i < kLayers; ++i) {
    const double y = (static_cast<double>(i) + 0.5) / kLayers - 0.5;
    moment += y * fresh.stress_at(curvature * y) / kLayers;
  }
  return moment;
}

/// Worst error of the moment of a section, from the yield curvature to twenty times it.
double worst_moment_error(const Curve& curve, int depth_points) {
  constexpr double kYieldCurvature = 2.0 * kYieldStress / kModulus;
  constexpr double kPeak = 20.0 * kYieldCurvature;
  const TimeFunction path{CycledElement::to_and_fro(kPeak)};
  double worst = 0.0;
  bool is_first = true;
  int step = 0;
  CycledElement::run(
      CycledElement::bent(kPeak, material_of(curve, 1.0), depth_points), [&](double) { is_first = false; },
      [&](double time, double, double moment) {
        const double curvature = path.value_at(time);
        if (!is_first || curvature < kYieldCurvature || ++step % 16 != 0) return;
        worst = std::max(worst, std::abs(moment / first_moment(curve, curvature) - 1.0));
      });
  return worst;
}

TEST(HardeningCurves, ASectionBendsAsTheIntegralOverItsDepth) {
  for (const Curve& curve : curves()) {
    SCOPED_TRACE(curve.name);
    scenes::record_bound("moment error of 6 points", worst_moment_error(curve, 6), 0.021);
    scenes::record_bound("moment error of 10 points", worst_moment_error(curve, 10), 0.0067);
  }
}

/// Bars of several materials side by side fill the lanes of a kernel.
TEST(HardeningCurves, BarsOfSeveralMaterialsBesideEachOtherAreEachAsAlone) {
  constexpr int kBars = 16;
  constexpr double kAmplitude = 0.02;
  FrameLattice frame;
  for (int i = 0; i < kBars; ++i) {
    const double y = 20.0 * i;
    frame.nodes.push_back({0.0, y, 0.0, 0.0});
    frame.nodes.push_back({CycledElement::kLength, y, 0.0, 0.0});
    frame.beams.push_back(scenes::beam(2 * i, 2 * i + 1, CycledElement::kThickness, 1));
    frame.beams.back().material = material_of(curves()[i % curves().size()], 1.0);
    frame.supports.push_back({2 * i, true, true, true});
    frame.supports.push_back({2 * i + 1, false, true, true});
    frame.motions.push_back({2 * i + 1,
                             FrameLattice::Component::x,
                             {{0.0, 0.0}, {CycledElement::kQuarter, kAmplitude * CycledElement::kLength}}});
  }
  frame.end_time_s = CycledElement::kQuarter;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  spec.numerics.time_step_s = CycledElement::kQuarter / 512.0;
  Simulation simulation(scenes::build(spec));
  simulation.advance(512);
  for (int i = 0; i < kBars; ++i) {
    CurvedBar bar(curves()[i % curves().size()], 1.0);
    const double force = -simulation.state().internal_force[2 * i + 1].x();
    EXPECT_NEAR(force / CycledElement::kThickness, bar.stress_at(kAmplitude), 1e-6 * kYieldStress) << i;
  }
}

TEST(HardeningCurves, ABilinearOneIsTheLawOfBilinearHardening) {
  const Curve linear = {"Linear", [](MaterialSpec& material) { material.hardening_modulus_mpa = 700.0; },
                        [](double p) { return 700.0 * p; }};
  const Curve as_table = {"Table",
                          [](MaterialSpec& material) {
                            material.hardening_table = {{0.0, 1.0}, {200.0, 900.0}, HardeningTable::Beyond::last_slope};
                          },
                          [](double p) { return 700.0 * p; }};
  std::vector<double> moments[2];
  for (int i = 0; i < 2; ++i) {
    const MaterialSpec material = material_of(i == 0 ? linear : as_table, 0.5);
    CycledElement::run(
        CycledElement::bent(0.05, material), [](double) {},
        [&](double, double, double moment) { moments[i].push_back(moment); });
  }
  ASSERT_EQ(moments[0].size(), moments[1].size());
  double worst = 0.0;
  for (std::size_t i = 0; i < moments[0].size(); ++i) {
    worst = std::max(worst, std::abs(moments[0][i] - moments[1][i]) * 4.0 / kYieldStress);
  }
  scenes::record_bound("difference of moments over the full one", worst, 1e-3);
}

}  // namespace
}  // namespace cellcrush::hardening_curves
