#include "results/test_difference.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "terminal/number_text.h"

namespace cellcrush::client {
namespace {

using Numbers = v1::CompareTestResponse::Numbers;

struct ComparedRow {
  std::string quantity;
  std::optional<double> measured;
  std::optional<double> computed;
};

std::vector<ComparedRow> rows_of(const v1::CompareTestResponse& of) {
  const bool is_force = of.is_force();
  const std::string along = is_force ? " mm" : "";
  const std::string across = is_force ? "N" : "MPa";
  const auto row = [&](const std::string& quantity, bool (Numbers::*has)() const, double (Numbers::*value)() const) {
    const auto read = [&](const Numbers& numbers) {
      return (numbers.*has)() ? std::optional((numbers.*value)()) : std::nullopt;
    };
    return ComparedRow{quantity, read(of.measured()), read(of.computed())};
  };
  return {row("elastic slope, " + across + (is_force ? "/mm" : ""), &Numbers::has_slope, &Numbers::slope),
          row("first peak, " + across, &Numbers::has_peak, &Numbers::peak),
          row(is_force ? "displacement of the first peak, mm" : "strain of the first peak", &Numbers::has_peak_at,
              &Numbers::peak_at),
          row(fmt::format("mean from {:.3g} to {:.3g}{}, {}", of.window_low(), of.window_high(), along, across),
              &Numbers::has_mean, &Numbers::mean),
          {fmt::format("energy to {:.3g}{}, {}", of.energy_to(), along, is_force ? "mJ" : "mJ/mm3"),
           of.measured().energy(), of.computed().energy()}};
}

}  // namespace

std::string difference_table(const v1::CompareTestResponse& difference, const std::string& tests) {
  const bool is_force = difference.is_force();
  const char* const along = is_force ? " mm" : "";
  std::string out = fmt::format("against {}, from {} {:.3g} to {:.3g}{}\n\n{:<34}{:>10}{:>10}{:>12}\n", tests,
                                is_force ? "displacement" : "strain", difference.from(), difference.to(), along, "",
                                "measured", "computed", "difference");
  const auto text = [](const std::optional<double>& value) { return value ? number_text(*value) : "-"; };
  for (const ComparedRow& row : rows_of(difference)) {
    const bool has_both = row.measured && row.computed && *row.measured != 0.0;
    out += fmt::format("{:<34}{:>10}{:>10}{:>12}\n", row.quantity, text(row.measured), text(row.computed),
                       has_both ? fmt::format("{:+.1f} %", 100.0 * (*row.computed / *row.measured - 1.0)) : "-");
  }
  const auto add = [&](const char* quantity, const std::string& value) {
    out += fmt::format("{:<34}{:>32}\n", fmt::format("{} difference, {}", quantity, is_force ? "N" : "MPa"), value);
  };
  add("greatest", number_text(difference.greatest_difference()) + " at " +
                      number_text(difference.greatest_difference_at()) + along);
  add("rms", number_text(difference.rms_difference()));
  return out;
}

}  // namespace cellcrush::client
