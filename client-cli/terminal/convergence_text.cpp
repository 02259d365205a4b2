#include "terminal/convergence_text.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;
using Quantity = v1::Convergence::Quantity;
using Estimate = v1::Convergence::MeshEstimate;

struct Words {
  std::string_view field;
  std::string_view title;
  double scale;  ///< from the field's unit to the one shown
};

constexpr std::array kWords = {
    Words{"plateau_stress_impact_mpa", "plateau at the impact plate, MPa", 1.0},
    Words{"plateau_stress_support_mpa", "plateau at the support plate, MPa", 1.0},
    Words{"densification_strain", "densification strain", 1.0},
    Words{"absorbed_energy_mj", "absorbed energy, J", 1e-3},
};

Words words_of(const Quantity& quantity) {
  for (const Words& words : kWords) {
    if (words.field == quantity.field()) return words;
  }
  return {quantity.field(), quantity.field(), 1.0};
}

std::string error_text(const Estimate& estimate) {
  if (!estimate.has_uncertainty_relative()) return percent_text(estimate.error_relative()) + " ± ?";
  return percent_text(estimate.error_relative()) + " ± " + percent_text(estimate.uncertainty_relative());
}

void add_rows(Table& table, const Quantity& quantity) {
  const Words words = words_of(quantity);
  table.add_title(printable(words.title));
  for (const Estimate& estimate : quantity.meshes()) {
    table.add({fmt::format("{}", estimate.elements_per_wall()), fmt::format("{}", estimate.job_count()),
               number_text(words.scale * estimate.mean()),
               estimate.has_scatter_relative() ? percent_text(estimate.scatter_relative()) : "", error_text(estimate)});
  }
}

bool has_intervals(const v1::Convergence& convergence) {
  int plateaus = 0;
  for (const Quantity& quantity : convergence.quantities()) {
    if (!quantity.field().starts_with("plateau_stress")) continue;
    ++plateaus;
    for (const Estimate& estimate : quantity.meshes()) {
      if (!estimate.has_uncertainty_relative()) return false;
    }
  }
  return plateaus == 2;
}

std::string verdict_text(const v1::Convergence& convergence) {
  const std::string wanted = percent_text(convergence.wanted_error_relative());
  if (convergence.has_elements_per_wall()) {
    return fmt::format("With {} elements per wall, error and interval of both plateau stresses are within {}.",
                       convergence.elements_per_wall(), wanted);
  }
  if (!has_intervals(convergence)) {
    return fmt::format(
        "Whether a mesh meets {} cannot be told: this takes two seeds or more with every mesh, and runs to 40 % "
        "strain.",
        wanted);
  }
  return fmt::format(
      "With no mesh are error and interval of both plateau stresses within {}. If the error is the larger part, add a "
      "finer mesh; if the interval is, use more seeds.",
      wanted);
}

}  // namespace

std::string run_count_text(int count) { return fmt::format("{} run{}", count, count == 1 ? "" : "s"); }

std::string convergence_text(const v1::Convergence& convergence, int width) {
  if (convergence.quantities_size() == 0) {
    return wrapped("No estimate yet: at least one run must have succeeded with each of two meshes.", width);
  }
  Table table({Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"elements per wall", "runs", "mean", "scatter", "error"});
  for (const Quantity& quantity : convergence.quantities()) add_rows(table, quantity);
  std::string text =
      table.text(2, width) + '\n' +
      wrapped(
          "error: difference of the mean from that of the finest mesh, ± half the width of its 95 % confidence "
          "interval. For the finest mesh it is the difference from the next coarser one. scatter: "
          "standard deviation between seeds, relative to the mean.",
          width, "", "  ") +
      wrapped(verdict_text(convergence), width, "", "  ");
  if (convergence.job_count_left_out() > 0) {
    text += wrapped(
        fmt::format("Left out, because they have not succeeded: {}.", run_count_text(convergence.job_count_left_out())),
        width, "", "  ");
  }
  return text;
}

}  // namespace cellcrush::client
