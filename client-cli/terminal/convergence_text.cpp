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

std::string remedy_text(const v1::Convergence& convergence) {
  const std::string wanted = percent_text(convergence.wanted_error_relative());
  if (convergence.has_elements_per_wall()) {
    return fmt::format("{} elements per wall keep both plateau stresses within {}.", convergence.elements_per_wall(),
                       wanted);
  }
  return fmt::format(
      "No mesh keeps both plateau stresses within {}. If the error is the larger part, add a finer mesh; if the ± is, "
      "use more seeds.",
      wanted);
}

}  // namespace

std::string convergence_text(const v1::Convergence& convergence, int width) {
  if (convergence.quantities_size() == 0) {
    return wrapped("No estimate yet: jobs with two meshes must have succeeded.", width);
  }
  Table table({Align::right, Align::right, Align::right, Align::right, Align::right});
  table.add({"elements per wall", "runs", "mean", "scatter", "error"});
  for (const Quantity& quantity : convergence.quantities()) add_rows(table, quantity);
  std::string text = table.text(2, width) + '\n' +
                     wrapped(
                         "error: difference of the mean from that of the finest mesh, ± half of its 95 % interval. For "
                         "the finest mesh it is the difference from the next coarser one. scatter: standard deviation "
                         "of one run.",
                         width, "", "  ") +
                     wrapped(remedy_text(convergence), width, "", "  ");
  if (convergence.job_count_left_out() > 0) {
    text += wrapped(fmt::format("{} runs have not succeeded and are left out.", convergence.job_count_left_out()),
                    width, "", "  ");
  }
  return text;
}

}  // namespace cellcrush::client
