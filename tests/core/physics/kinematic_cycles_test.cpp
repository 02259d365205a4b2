// Cycles of bilinear material with kinematic and mixed hardening, against closed forms. Both ends of one element are
// moved, so that nothing but the fibres is under test and the bounds can be tight. Blind to: inertia, several elements
// (Textbook.Cycles has those), and cycles of axial force and moment together.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/scene.h"
#include "scenes/cycled_element.h"
#include "scenes/evidence.h"
#include "section/section_rule.h"

namespace cellcrush::kinematic_cycles {
namespace {

using scenes::CycledElement;

constexpr double kModulus = 200000.0;  // E, MPa
constexpr double kTangent = 20000.0;   // E_T
constexpr double kYieldStress = 200.0;
constexpr double kHardening = kModulus * kTangent / (kModulus - kTangent);  // H
constexpr double kLength = CycledElement::kLength;
constexpr double kThickness = CycledElement::kThickness;
constexpr int kCycles = CycledElement::kCycles;
constexpr double kQuarter = CycledElement::kQuarter;

MaterialSpec bilinear(double isotropic_fraction) {
  MaterialSpec material;
  material.youngs_modulus_mpa = kModulus;
  material.yield_stress_mpa = kYieldStress;
  material.hardening_modulus_mpa = kHardening;
  material.isotropic_fraction = isotropic_fraction;
  material.density_kg_per_m3 = 7850.0;
  return material;
}

/// Stress of a bilinear bar whose strain goes to and fro, in closed form (Lemaitre and Chaboche 1990, chapter 5). From
/// a turn at one end of the yield range alpha +- Y it is elastic over 2 Y, then has the slope E_T. On the way dp of
/// plastic strain, Y grows by beta H |dp| and alpha by (1 - beta) H dp.
class BilinearBar {
 public:
  explicit BilinearBar(double isotropic_fraction) : isotropic_(isotropic_fraction) {}

  /// Moves the strain, in one direction since the last turn.
  double stress_at(double strain) {
    const double trial = stress_ + kModulus * (strain - strain_);
    const double excess = std::abs(trial - back_) - yield_;
    if (excess <= 0.0) return trial;
    return trial - kModulus * std::copysign(excess / (kModulus + kHardening), trial - back_);
  }

  void turn_at(double strain) {
    const double end = stress_at(strain);
    const double plastic = strain - strain_ - (end - stress_) / kModulus;
    yield_ += isotropic_ * kHardening * std::abs(plastic);
    back_ += (1.0 - isotropic_) * kHardening * plastic;
    stress_ = end;
    strain_ = strain;
  }

 private:
  double isotropic_;
  double strain_ = 0.0;
  double stress_ = 0.0;
  double back_ = 0.0;
  double yield_ = kYieldStress;
};

double value_at(const FrameLattice::TimeFunction& points, double time) { return TimeFunction{points}.value_at(time); }

/// Worst error over the yield stress of the stress of a bar of constant area between +-`amplitude` of elongation over
/// length.
double worst_stress_error(double isotropic_fraction, double amplitude) {
  const auto points = CycledElement::to_and_fro(amplitude);
  BilinearBar bar(isotropic_fraction);
  const auto turn = [&](double side) { bar.turn_at(side * amplitude); };
  double worst = 0.0;
  const SceneSpec spec = CycledElement::stretched(amplitude, bilinear(isotropic_fraction));
  CycledElement::run(spec, turn, [&](double time, double force, double) {
    const double stress = bar.stress_at(value_at(points, time));
    worst = std::max(worst, std::abs(force / kThickness - stress) / kYieldStress);
  });
  return worst;
}

TEST(KinematicCycles, ABarFollowsTheClosedFormOfItsStressForAnyShareOfIsotropicHardening) {
  for (const double share : {0.0, 0.25, 0.5, 1.0}) {
    const double error = worst_stress_error(share, 0.006);
    scenes::record_bound("stress error", error, 1e-8);
  }
}

constexpr double kYieldMoment = kYieldStress * kThickness * kThickness / 6.0;
constexpr double kYieldCurvature = 2.0 * kYieldStress / (kModulus * kThickness);

/// Moment of the rectangle that bends for the first time: the stress integrated over the depth.
double first_moment(double curvature) {
  const double ratio = curvature / kYieldCurvature;
  if (ratio <= 1.0) return kYieldMoment * ratio;
  constexpr double kShare = kTangent / kModulus;
  return kYieldMoment * ((1.0 - kShare) * (1.5 - 0.5 / (ratio * ratio)) + kShare * ratio);
}

/// Every fibre of a kinematic section obeys Masing's rule (Masing 1926), so their sum does: from a turn at +-`peak` the
/// moment changes by twice the first moment of half the change of curvature. Points through the depth that have the
/// first moment within a bound (section/section_rule.h) have every change of moment within that too.
void expect_loops(int depth_points, double bound) {
  SCOPED_TRACE(std::to_string(depth_points) + " points");
  constexpr double kPeak = 4.0 * kYieldCurvature;
  const auto points = CycledElement::to_and_fro(kPeak);
  double worst = 0.0;
  double moment_at_turn = 0.0;
  double last_moment = 0.0;
  double last_curvature = 0.0;
  double area = 0.0;  // of the last loop
  double side = 0.0;
  const auto turn = [&](double of_turn) {
    side = of_turn;
    moment_at_turn = last_moment;
    EXPECT_NEAR(moment_at_turn / first_moment(kPeak), side, bound);
  };
  CycledElement::run(CycledElement::bent(kPeak, bilinear(0.0), depth_points), turn,
                     [&](double time, double, double moment) {
                       const double curvature = value_at(points, time);
                       const double factor = side == 0.0 ? 1.0 : 2.0;
                       const double change = (curvature - side * kPeak) / factor;
                       const double exact = factor * std::copysign(first_moment(std::abs(change)), change);
                       worst = std::max(worst, std::abs((moment - moment_at_turn) / exact - 1.0));
                       if (time > (4.0 * kCycles - 5.0) * kQuarter * (1.0 + 1e-9)) {
                         area += 0.5 * (moment + last_moment) * (curvature - last_curvature);
                       }
                       last_moment = moment;
                       last_curvature = curvature;
                     });
  // The loop is what lies between its two sides, each 2 f(k / 2) over k from 0 to 2 k_p: twice the integral of both
  // less the square around them.
  const double ratio = kPeak / kYieldCurvature;
  constexpr double kShare = kTangent / kModulus;
  const double under_first =  // the integral of first_moment to the peak
      kYieldMoment * kYieldCurvature *
      (0.5 + (1.0 - kShare) * (1.5 * (ratio - 1.0) + 0.5 * (1.0 / ratio - 1.0)) + 0.5 * kShare * (ratio * ratio - 1.0));
  const double exact_area = 8.0 * under_first - 4.0 * kPeak * first_moment(kPeak);
  const std::string of_points = " of " + std::to_string(depth_points) + " points";
  scenes::record_figure("change of moment" + of_points + ": error in %", 100.0 * worst, 2, {0.0, 100.0 * bound});
  scenes::record_figure("area of the last loop" + of_points, area / exact_area, 4, {1.0, bound});
}

TEST(KinematicCycles, ASectionInPureBendingFollowsTheLoopsIntegratedOverItsDepth) {
  expect_loops(6, 0.021);
  expect_loops(10, 0.0067);
}

TEST(KinematicCycles, TheFibresOfASectionInPureBendingAreBilinearBars) {
  constexpr double kPeak = 4.0 * kYieldCurvature;
  const SectionRule rule = make_section_rule({});
  double worst = 0.0;
  for (const double share : {0.0, 0.3}) {
    const auto points = CycledElement::to_and_fro(kPeak);
    std::vector<BilinearBar> fibres(rule.depth_count(), BilinearBar(share));
    const auto turn = [&](double side) {
      for (std::size_t i = 0; i < fibres.size(); ++i) fibres[i].turn_at(side * kPeak * rule.offset[i] * kThickness);
    };
    CycledElement::run(CycledElement::bent(kPeak, bilinear(share)), turn, [&](double time, double, double moment) {
      double exact = 0.0;
      for (std::size_t i = 0; i < fibres.size(); ++i) {
        const double arm = rule.offset[i] * kThickness;
        exact += kThickness * rule.depth_weight[i] * arm * fibres[i].stress_at(value_at(points, time) * arm);
      }
      worst = std::max(worst, std::abs(moment - exact) / kYieldMoment);
    });
  }
  scenes::record_bound("moment error", worst, 1e-3);
}

}  // namespace
}  // namespace cellcrush::kinematic_cycles
