#include "law/flow_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellcrush {
namespace {

/// Slopes between points that are spaced by some numbers become bends at the first of each two.
void bend_between(const std::vector<double>& at, const std::vector<double>& values, BentLine& line) {
  double before = 0.0;
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const double slope = (values[i + 1] - values[i]) / (at[i + 1] - at[i]);
    line.edges.push_back(at[i]);
    line.bends.push_back(slope - before);
    before = slope;
  }
}

double last_slope(const HardeningTable& table) {
  const std::size_t last = table.stresses_mpa.size() - 1;
  return (table.stresses_mpa[last] - table.stresses_mpa[last - 1]) /
         (table.plastic_strains[last] - table.plastic_strains[last - 1]);
}

/// Of the power law that has the last slope at the last point.
double last_exponent(const HardeningTable& table) {
  return last_slope(table) * table.plastic_strains.back() / table.stresses_mpa.back();
}

CurvePoint point_of(const BentLine& line, double at) {
  CurvePoint point;
  for (std::size_t i = 0; i < line.edges.size(); ++i) {
    const double past = std::min(at, line.end) - line.edges[i];
    point.increase += line.bends[i] * std::max(past, 0.0);
    point.slope += past >= 0.0 && at < line.end ? line.bends[i] : 0.0;
  }
  if (line.exponent > 0.0 && at >= line.end) {
    const double stress = line.last * std::pow(at / line.end, line.exponent);
    point.increase += stress - line.last;
    point.slope += stress * line.exponent / at;
  }
  return point;
}

}  // namespace

void hold_walls(LawParameters& law) {
  for (const LawParameter& parameter : kLawParameters) {
    law.*parameter.value *= std::pow(kHeldFlow, parameter.flow_power);
  }
  law.ludwik_stress_mpa *= std::pow(kHeldFlow, law.ludwik_exponent);
  for (double& strain : law.hardening_table.plastic_strains) strain /= kHeldFlow;
  for (double& stress : law.hardening_table.stresses_mpa) stress *= kHeldFlow;
  for (double& rate : law.rate_table.rates_per_s) rate /= kHeldFlow;
}

BentLine bent_line_of(const HardeningTable& table) {
  BentLine line;
  if (table.plastic_strains.size() < 2) return line;
  bend_between(table.plastic_strains, table.stresses_mpa, line);
  if (table.beyond != HardeningTable::Beyond::last_slope) line.end = table.plastic_strains.back();
  if (table.beyond == HardeningTable::Beyond::power_law) {
    line.last = table.stresses_mpa.back();
    line.exponent = last_exponent(table);
  }
  return line;
}

BentLine bent_line_of_rate(const LawParameters& law) {
  BentLine line;
  if (law.johnson_cook_coefficient > 0.0) {
    line.edges.push_back(std::log(law.johnson_cook_reference_rate_per_s));
    line.bends.push_back(law.johnson_cook_coefficient);
  }
  if (law.rate_table.rates_per_s.size() >= 2) {
    std::vector<double> logarithms;
    for (const double rate : law.rate_table.rates_per_s) logarithms.push_back(std::log(rate));
    bend_between(logarithms, law.rate_table.factors, line);
    line.end = logarithms.back();
  }
  return line;
}

CurvePoint curve_point(const LawParameters& law, double plastic_strain) {
  CurvePoint point = point_of(bent_line_of(law.hardening_table), plastic_strain);
  const double left = std::exp(-law.voce_exponent * plastic_strain);
  point.increase += law.hardening_modulus_mpa * plastic_strain + law.voce_stress_mpa * (1.0 - left);
  point.slope += law.hardening_modulus_mpa + law.voce_stress_mpa * law.voce_exponent * left;
  if (law.ludwik_stress_mpa > 0.0) {
    point.increase += law.ludwik_stress_mpa * std::pow(plastic_strain, law.ludwik_exponent);
    point.slope +=
        law.ludwik_stress_mpa * law.ludwik_exponent * std::pow(plastic_strain, law.ludwik_exponent - 1.0);
  }
  return point;
}

double even_strain_of_curve(double yield_stress, const LawParameters& material) {
  constexpr double kGreatest = 10.0;
  constexpr int kSteps = 4000;
  double strain = 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double next = kGreatest * i / kSteps;
    const CurvePoint point = curve_point(material, next);
    if (point.slope < yield_stress + point.increase) break;
    strain = next;
  }
  return strain;
}

}  // namespace cellcrush
