#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "chart/palette.h"
#include "plots/job_curves.h"

namespace cellcrush::client {

namespace {

struct LedgerLine {
  const char* name;
  double (*value)(const v1::Sample& sample);
  LineStyle style;
};

const std::array<LedgerLine, 9>& ledger_lines() {
  static const std::array<LedgerLine, 9> kLines = {{
      {"work of the plates", [](const v1::Sample& s) { return s.work_external_mj(); }, {kInk, 2.0, {}}},
      {"plastic", [](const v1::Sample& s) { return s.energy_plastic_mj(); }, {kSeriesColours[1], 1.8, {}}},
      {"kinetic", [](const v1::Sample& s) { return s.energy_kinetic_mj(); }, {kSeriesColours[0], 1.8, {}}},
      {"elastic", [](const v1::Sample& s) { return s.energy_elastic_mj(); }, {kSeriesColours[2], 1.8, {}}},
      {"contact", [](const v1::Sample& s) { return s.energy_contact_mj(); }, {kSeriesColours[3], 1.8, {}}},
      {"contact damping",
       [](const v1::Sample& s) { return s.energy_contact_damping_mj(); },
       {kSeriesColours[4], 1.8, {}}},
      {"mass damping",
       [](const v1::Sample& s) { return s.energy_damping_mj() - s.energy_contact_damping_mj(); },
       {kSeriesColours[5], 1.8, {}}},
      {"friction", [](const v1::Sample& s) { return s.energy_friction_mj(); }, {kSeriesColours[2], 1.8, {6.0, 3.0}}},
      {"residual", [](const v1::Sample& s) { return s.energy_residual_mj(); }, {kMutedInk, 1.4, {2.0, 3.0}}},
  }};
  return kLines;
}

}  // namespace

Chart build_energy_chart(const JobHistory& history) {
  constexpr double kJoulePerMillijoule = 1e-3;
  Chart chart;
  double low = 0.0;
  double high = 0.0;
  double strain = 0.0;
  for (const LedgerLine& line : ledger_lines()) {
    Curve curve{{}, {}, line.style, line.name};
    bool any = &line == &ledger_lines().back();
    for (const v1::Sample& sample : history.samples) {
      const double value = kJoulePerMillijoule * line.value(sample);
      if (!std::isfinite(sample.strain() + value)) continue;
      curve.x.push_back(sample.strain());
      curve.y.push_back(value);
      any = any || value != 0.0;
      low = std::min(low, value);
      high = std::max(high, value);
      strain = std::max(strain, sample.strain());
    }
    if (any) chart.curves.push_back(std::move(curve));
  }
  chart.x = {0.0, std::max(strain, 0.01), "nominal strain"};
  const double room = high > low ? 0.06 * (high - low) : 1.0;
  chart.y = {low < 0.0 ? low - room : 0.0, high + room, "energy (J)"};
  chart.note = "totals since the start; the work equals the sum of the other curves";
  return chart;
}

}  // namespace cellcrush::client
