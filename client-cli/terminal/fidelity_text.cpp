#include "terminal/fidelity_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "terminal/number_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;

std::string error_text(const v1::MeasuredError& error) {
  return unbreakable(percent_text(error.error_relative())) + ' ' +
         unbreakable("± " + percent_text(error.uncertainty_relative()));
}

// The forecast that names the scenes in which errors were measured; null if the case's own fields determine everything.
const v1::FidelityForecast* find_measured(const v1::CheckCaseResponse& check) {
  for (const v1::FidelityForecast& forecast : check.fidelities()) {
    if (forecast.errors_size() > 0) return &forecast;
  }
  return nullptr;
}

std::string given_text(const v1::FidelityForecast& forecast) {
  return printable(fmt::format("{}", fmt::join(forecast.given_fields(), ", ")));
}

std::vector<std::string> row_of(const v1::FidelityForecast& forecast) {
  std::vector<std::string> row = {v1::Numerics::Fidelity_Name(forecast.fidelity()),
                                  fmt::format("{}", forecast.elements_per_wall()),
                                  duration_text(forecast.predicted_seconds())};
  for (const v1::MeasuredError& error : forecast.errors()) row.push_back(error_text(error));
  if (forecast.errors_size() == 0) row.emplace_back("not known");
  return row;
}

// Whether the case's own fields leave nothing for a fidelity to set.
bool are_all_the_same(const v1::CheckCaseResponse& check) {
  return std::all_of(check.fidelities().begin(), check.fidelities().end(), [&](const v1::FidelityForecast& forecast) {
    return forecast.elements_per_wall() == check.fidelities(0).elements_per_wall();
  });
}

// Why no error is known, and how to find it out.
std::string unknown_text(const v1::CheckCaseResponse& check) {
  const std::string given = given_text(check.fidelities(0));
  return "The mesh error is not known" +
         (given.empty() ? "." : ", because the case differs from every measured preset in " + given + '.') +
         " `cellcrush converge` estimates it.";
}

std::string scatter_text(const v1::FidelityForecast& measured) {
  std::string text;
  for (const v1::MeasuredError& error : measured.errors()) {
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", percent_text(error.scatter_relative()),
                        printable(error.measure()));
  }
  return text;
}

}  // namespace

std::string fidelity_text(const v1::CheckCaseResponse& check, int width) {
  if (check.fidelities_size() == 0) return {};
  const v1::FidelityForecast* measured = find_measured(check);
  if (are_all_the_same(check) && measured == nullptr) {
    return '\n' + wrapped(
                      "cost and accuracy: numerics.fidelity changes nothing, because the case sets "
                      "elements_per_wall. " +
                          unknown_text(check),
                      width);
  }
  std::vector<std::string> heading = {"fidelity", "elements per wall", "predicted time"};
  std::vector<Align> columns = {Align::left, Align::right, Align::right};
  if (measured != nullptr) {
    for (const v1::MeasuredError& error : measured->errors()) heading.push_back(printable(error.measure()));
  } else {
    heading.push_back("error");
  }
  columns.resize(heading.size(), Align::left);
  Table table(columns);
  table.add(heading);
  for (const v1::FidelityForecast& forecast : check.fidelities()) table.add(row_of(forecast));
  std::string text = "\ncost and accuracy by numerics.fidelity\n" + table.text(2, width);
  if (measured != nullptr) {
    text += wrapped(fmt::format("An error is the difference of the mean over seeds from that of the finest mesh; that "
                                "of the finest mesh is "
                                "its difference from the next coarser one. Single {} runs scatter by {} between seeds.",
                                v1::Numerics::Fidelity_Name(measured->fidelity()), scatter_text(*measured)),
                    width, "  ", "  ");
  } else {
    text += wrapped(unknown_text(check), width, "  ", "  ");
  }
  return text;
}

}  // namespace cellcrush::client
