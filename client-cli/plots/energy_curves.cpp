#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "chart/colour_map.h"
#include "plots/job_curves.h"
#include "results/energy_terms.h"

namespace cellcrush::client {

namespace {

constexpr double kJoulePerMillijoule = 1e-3;

// Of the terms in turn; once all are used they come again, dashed. Plastic work, the first, is red.
LineStyle style_of(std::size_t term) {
  constexpr std::array<std::size_t, 6> kColours = {1, 0, 2, 3, 4, 5};
  static_assert(kColours.size() == kSeriesColours.size());
  const bool again = term >= kColours.size();
  return {kSeriesColours[kColours[term % kColours.size()]], 1.8, again ? std::vector{6.0, 3.0} : std::vector<double>{}};
}

}  // namespace

Chart build_energy_chart(const JobHistory& history) {
  Chart chart;
  double low = 0.0;
  double high = 0.0;
  double strain = 0.0;
  const auto add = [&](const std::string& name, const LineStyle& style, bool even_if_zero, const auto& energy) {
    Curve curve{{}, {}, style, name};
    bool any = even_if_zero;
    for (const v1::Sample& sample : history.samples) {
      const double value = kJoulePerMillijoule * energy(sample);
      if (!std::isfinite(sample.strain() + value)) continue;
      curve.x.push_back(sample.strain());
      curve.y.push_back(value);
      any = any || value != 0.0;
      low = std::min(low, value);
      high = std::max(high, value);
      strain = std::max(strain, sample.strain());
    }
    if (any) chart.curves.push_back(std::move(curve));
  };
  add("work of the plates", {kInk, 2.0, {}}, false, [](const v1::Sample& sample) { return sample.work_external_mj(); });
  std::size_t number = 0;
  for (const EnergyTerm& term : energy_terms_of(*v1::Sample::descriptor()))
    add(term.label, style_of(number++), false, [&](const v1::Sample& sample) { return term.value(sample); });
  add("residual", {kMutedInk, 1.4, {2.0, 3.0}}, true,
      [](const v1::Sample& sample) { return sample.energy_residual_mj(); });
  chart.x = {0.0, std::max(strain, 0.01), "nominal strain"};
  const double room = high > low ? 0.06 * (high - low) : 1.0;
  chart.y = {low < 0.0 ? low - room : 0.0, high + room, "energy (J)"};
  chart.note = "totals since the start; the work equals the sum of the other curves";
  return chart;
}

}  // namespace cellcrush::client
