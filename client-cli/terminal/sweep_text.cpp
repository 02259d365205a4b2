#include "terminal/sweep_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "columns/swept_fields.h"
#include "results/field_value.h"
#include "terminal/case_text.h"
#include "terminal/job_text.h"
#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {
namespace {

using Align = Table::Align;

std::string counts_text(const v1::Sweep& sweep) {
  const std::map<std::string, int> ordered(sweep.state_counts().begin(), sweep.state_counts().end());
  std::vector<std::string> parts;
  for (const auto& [state, count] : ordered) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, state));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string values_text(const v1::SweepAxis& axis) {
  const auto range = [](const v1::SweepAxis::Range& values, const char* spacing) {
    return fmt::format("{} values from {} to {}, {}", values.count(), values.first(), values.last(), spacing);
  };
  switch (axis.values_case()) {
    case v1::SweepAxis::kList: return fmt::format("{}", fmt::join(axis.list().values(), ", "));
    case v1::SweepAxis::kLinear: return range(axis.linear(), "evenly spaced");
    case v1::SweepAxis::kLogarithmic: return range(axis.logarithmic(), "logarithmically spaced");
    case v1::SweepAxis::kSeedCount: return fmt::format("1 to {}", axis.seed_count());
    default: return {};
  }
}

// "50", "50 to 200": where the values of an axis lie.
std::string span_text(const v1::SweepAxis& axis) {
  const auto span = [](double low, double high) {
    return low == high ? short_text(low) : fmt::format("{} to {}", short_text(low), short_text(high));
  };
  switch (axis.values_case()) {
    case v1::SweepAxis::kList: {
      const auto [low, high] = std::minmax_element(axis.list().values().begin(), axis.list().values().end());
      return axis.list().values_size() > 0 ? span(*low, *high) : std::string();
    }
    case v1::SweepAxis::kLinear: return span(axis.linear().first(), axis.linear().last());
    case v1::SweepAxis::kLogarithmic: return span(axis.logarithmic().first(), axis.logarithmic().last());
    case v1::SweepAxis::kSeedCount: return span(1, axis.seed_count());
    default: return {};
  }
}

// "speed 25 to 100 m/s, wall thickness 0.3 to 0.4 mm".
std::string varied_text(const v1::Sweep& sweep) {
  if (sweep.axes().empty()) return sweep.points_size() > 0 ? "a list of points" : "";
  const std::vector<std::string> fields = swept_fields(sweep);
  std::vector<std::string> texts;
  for (const v1::SweepAxis& axis : sweep.axes()) {
    const FieldWords words = words_among(axis.field(), fields);
    texts.push_back(words.name + ' ' + span_text(axis) + (words.unit.empty() ? "" : ' ' + words.unit));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

using Quantity = v1::Convergence::Quantity;
using Estimate = v1::Convergence::MeshEstimate;

struct Words {
  std::string_view field;
  std::string_view title;
  std::string_view unit;  ///< of the field
};

constexpr std::array kWords = {
    Words{"plateau_stress_impact_mpa", "plateau at the impact plate", "MPa"},
    Words{"plateau_stress_support_mpa", "plateau at the support plate", "MPa"},
    Words{"densification_strain", "densification strain", ""},
    Words{"absorbed_energy_mj", "absorbed energy", "mJ"},
    Words{"ledger.work_external_mj", "work of the loads", "mJ"},
    Words{"ledger.plastic_mj", "plastic work", "mJ"},
    Words{"fibre_strain.largest", "largest fibre strain", ""},
};

Words words_of(const Quantity& quantity) {
  for (const Words& words : kWords) {
    if (words.field == quantity.field()) return words;
  }
  return {quantity.field(), quantity.field(), ""};
}

void add_rows(Table& table, const Quantity& quantity, bool scatters) {
  const Words words = words_of(quantity);
  double largest = std::abs(quantity.limit());
  for (const Estimate& estimate : quantity.meshes()) largest = std::max(largest, std::abs(estimate.mean()));
  const ShownUnit unit = unit_by_size(words.unit, largest);
  table.add_title(printable(fmt::format("{}{}{}", words.title, *unit.name == '\0' ? "" : ", ", unit.name)));
  const auto add = [&](const std::string& mesh, const std::string& runs, double mean, const std::string& scatter,
                       const std::string& error) {
    std::vector<std::string> row = {mesh, runs, number_text(unit.factor * mean)};
    if (scatters) row.push_back(scatter);
    row.push_back(error);
    table.add(row);
  };
  for (const Estimate& estimate : quantity.meshes()) {
    add(fmt::format("{}", estimate.elements_per_wall()), fmt::format("{}", estimate.job_count()), estimate.mean(),
        estimate.has_scatter_relative() ? percent_text(estimate.scatter_relative()) : "",
        percent_text(estimate.error_relative()));
  }
  const std::string half_width =
      quantity.has_interval() ? percent_text(std::abs(quantity.interval() / quantity.limit())) : "?";
  add(quantity.has_order() ? fmt::format("limit, order {:.1f}", quantity.order()) : "limit", "", quantity.limit(), "",
      "± " + half_width);
}

bool is_plateau(const Quantity& quantity) { return quantity.field().starts_with("plateau_stress"); }

/// What the verdict on a mesh takes and is missing; empty if it is there.
std::string missing_text(const v1::Convergence& convergence) {
  const auto& quantities = convergence.quantities();
  const bool crushes = std::ranges::any_of(quantities, [](const Quantity& quantity) {
    return is_plateau(quantity) || quantity.field() == "absorbed_energy_mj";
  });
  const bool has_intervals = std::ranges::all_of(quantities, &Quantity::has_interval);
  std::vector<std::string> missing;
  if (!has_intervals) missing.emplace_back("two seeds or more with every mesh");
  if (crushes && std::ranges::count_if(quantities, is_plateau) < 2) missing.emplace_back("runs to 40 % strain");
  if (!crushes && std::ranges::none_of(quantities, &Quantity::decides))
    missing.emplace_back("runs with work of the loads or plastic work");
  return fmt::format("{}", fmt::join(missing, ", and "));
}

std::string verdict_text(const v1::Convergence& convergence, bool scatters) {
  const std::string wanted = percent_text(convergence.wanted_error_relative());
  std::vector<std::string_view> titles;
  bool plateaus = false;
  for (const Quantity& quantity : convergence.quantities()) {
    if (quantity.decides()) titles.push_back(words_of(quantity).title);
    plateaus = plateaus || is_plateau(quantity);
  }
  const std::string deciding =
      plateaus ? "both plateau stresses" : fmt::format("the {}", fmt::join(titles, " and the "));
  if (convergence.has_elements_per_wall()) {
    return fmt::format("With {} {}, error and interval of {} are together within {}.", convergence.elements_per_wall(),
                       convergence.mesh_words(), deciding, wanted);
  }
  if (const std::string missing = missing_text(convergence); !missing.empty()) {
    return fmt::format("Whether a mesh meets {} cannot be told: this takes {}.", wanted, missing);
  }
  return fmt::format("No mesh has the error and interval of {} together within {}. A finer mesh reduces both{}.",
                     deciding, wanted, scatters ? "; more seeds reduce the interval where the scatter is large" : "");
}

/// "2 elements per wall, seeds 1, 2; 8 elements per wall, seed 5": the runs with a warning.
std::string runs_text(const v1::Convergence::RunWarning& warning, const std::string& mesh_words) {
  std::map<int, std::vector<std::string>> seeds;
  for (const auto& run : warning.runs()) {
    auto& of_mesh = seeds[run.elements_per_wall()];
    if (run.has_seed()) of_mesh.push_back(fmt::format("{}", run.seed()));
  }
  std::vector<std::string> texts;
  for (const auto& [elements, of_mesh] : seeds) {
    texts.push_back(fmt::format("{} {}", elements, mesh_words));
    if (of_mesh.empty()) continue;
    texts.back() += fmt::format(", seed{} {}", of_mesh.size() > 1 ? "s" : "", fmt::join(of_mesh, ", "));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string warnings_text(const v1::Convergence& convergence, int width) {
  std::string text;
  for (const auto& each : convergence.warnings()) {
    const std::string kind = v1::Warning::Kind_Name(each.warning().kind());
    text += '\n' +
            wrapped(printable(fmt::format("Warning ({}) of {} ({}). {}: {}", kind, run_count_text(each.runs_size()),
                                          runs_text(each, convergence.mesh_words()), each.runs(0).job(),
                                          each.warning().message())),
                    width, "  ", "    ") +
            wrapped(printable("Remedy: " + each.warning().remedy()), width, "    ", "    ");
  }
  return text;
}

}  // namespace

std::string sweep_line(const v1::Sweep& sweep) {
  std::string text = fmt::format("{}: {}", sweep.name(), job_count_text(sweep.jobs_size()));
  if (const std::string counts = counts_text(sweep); !counts.empty()) text += ", " + counts;
  return printable(text) + '\n';
}

std::string description_text(const v1::Sweep& sweep, int width) {
  Table table({Align::left, Align::left});
  if (!sweep.case_().title().empty()) table.add({"title", sweep.case_().title()});
  const std::string scene = scene_text(sweep.words());
  if (!scene.empty()) table.add({"case", scene});
  for (const v1::SweepAxis& axis : sweep.axes()) table.add({"over " + axis.field(), values_text(axis)});
  if (sweep.points_size() > 0) table.add({"points", std::to_string(sweep.points_size())});
  if (sweep.priority() != 0) table.add({"priority", std::to_string(sweep.priority())});
  if (sweep.time_limit_s() > 0.0) table.add({"time limit", duration_text(sweep.time_limit_s())});
  if (const std::string executor = executor_text(sweep.executor()); !executor.empty())
    table.add({"executor", executor});
  if (sweep.max_parallel() > 0) table.add({"most jobs at once", std::to_string(sweep.max_parallel())});
  if (sweep.max_failures() > 0) table.add({"most failures", std::to_string(sweep.max_failures())});
  add_note_rows(table, sweep.note());
  if (!sweep.labels().empty()) table.add({"labels", labels_text(sweep.labels())});
  if (!sweep.owner().empty()) table.add({"owner", sweep.owner()});
  if (sweep.has_create_time()) table.add({"created", time_text(sweep.create_time())});
  if (sweep.jobs_size() > 0) table.add({"jobs", fmt::format("{}", fmt::join(sweep.jobs(), ", "))});
  return sweep_line(sweep) + '\n' + table.text(2, width);
}

std::string sweep_list_text(const std::vector<v1::Sweep>& sweeps, int width) {
  if (sweeps.empty()) return "no sweeps\n";
  Table table({Align::left, Align::right, Align::left, Align::left, Align::left, Align::left, Align::left, Align::left,
               Align::left});
  table.add({"NAME", "JOBS", "STATES", "OVER", "PRIORITY", "LABELS", "NOTE", "CREATED", "TITLE"});
  for (const v1::Sweep& sweep : sweeps) {
    table.add({sweep.name(), std::to_string(sweep.jobs_size()), counts_text(sweep), varied_text(sweep),
               sweep.priority() != 0 ? std::to_string(sweep.priority()) : "", labels_text(sweep.labels()),
               short_note_text(sweep.note()), sweep.has_create_time() ? time_text(sweep.create_time()) : "",
               sweep.case_().title()});
  }
  const std::string constants = constants_text(table.remove_constant_columns(3, 1), width);
  return table.text(0, width) + constants;
}

std::string run_count_text(int count) { return fmt::format("{} run{}", count, count == 1 ? "" : "s"); }

std::string job_count_text(int count) { return fmt::format("{} job{}", count, count == 1 ? "" : "s"); }

std::string convergence_text(const v1::Convergence& convergence, int width) {
  if (convergence.quantities_size() == 0) {
    return wrapped("No estimate yet: at least one run must have succeeded with each of two meshes.", width);
  }
  bool scatters = false;
  for (const Quantity& quantity : convergence.quantities()) {
    scatters = scatters || std::ranges::any_of(quantity.meshes(), &Estimate::has_scatter_relative);
  }
  std::vector<std::string> heading = {convergence.mesh_words(), "runs", "mean"};
  if (scatters) heading.emplace_back("scatter");
  heading.emplace_back("error");
  Table table(std::vector<Align>(heading.size(), Align::right));
  table.add(heading);
  for (const Quantity& quantity : convergence.quantities()) add_rows(table, quantity, scatters);
  std::string text =
      table.text(2, width) + '\n' +
      wrapped(
          fmt::format("limit: mean of an infinitely fine mesh, ± half the width of its interval. It is extrapolated "
                      "where it has an order, and otherwise the mean of the finest mesh. error: difference of a mean "
                      "from the limit.{}",
                      scatters ? " scatter: standard deviation between seeds, relative to the mean." : ""),
          width, "", "  ") +
      wrapped(verdict_text(convergence, scatters), width, "", "  ");
  if (convergence.job_count_left_out() > 0) {
    text += wrapped(
        fmt::format("Left out, because they have not succeeded: {}.", run_count_text(convergence.job_count_left_out())),
        width, "", "  ");
  }
  return text + warnings_text(convergence, width);
}

}  // namespace cellcrush::client
