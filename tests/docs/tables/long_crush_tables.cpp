// tests/validation/RESULTS.md: Examples 1, 2 and 3 of the paper.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <tuple>

#include "chart/smoothing.h"
#include "docs/tables/crush_rows.h"
#include "docs/tables/record_tables.h"
#include "validation/course.h"
#include "validation/records.h"

namespace cellcrush::docs {
namespace {

const std::string kValidation = kTests + "/validation/";
const std::string kRecords = kValidation + "records/";

/// Those of a preset side by side, by speed.
std::vector<CrushGroup> example_2() {
  std::vector<CrushGroup> groups = read_groups(kValidation + "example_2.txt", kValidation + "example_2.csv");
  std::ranges::stable_sort(groups, {}, [](const CrushGroup& group) { return std::tuple(group.preset, group.speed); });
  return groups;
}

/// The first mesh of each preset at each speed, which all speeds have.
std::vector<CrushGroup> first_meshes(const std::vector<CrushGroup>& groups) {
  std::vector<CrushGroup> found;
  for (const CrushGroup& group : groups) {
    if (found.empty() || found.back().scene != group.scene) found.push_back(group);
  }
  return found;
}

/// "3.59 (+11 %)": the mean of a theory, and of its deviation from the impact plateau of each crush.
std::string theory_text(const CrushGroup& group, const std::string& column) {
  std::vector<double> deviations;
  for (const bench::CsvRow& row : group.rows) {
    const double deviation = bench::number_in(row, column) / bench::number_in(row, "plateau_stress_impact") - 1.0;
    if (std::isfinite(deviation)) deviations.push_back(deviation);
  }
  if (deviations.empty()) return "";
  return fixed(group.of(column).mean, 2) + " (" + signed_percent(statistics_of(deviations).mean, 1) + ")";
}

std::string example_2_table() {
  PageTable table({"Scene", "#V, m/s", "#Elements", "#Seeds", "#Impact, MPa", "#Support, MPa", "#Eq. 51, MPa",
                   "#Eq. 52, MPa", "#Strain behind the front", "#Ledger", "#Penetration", "#At first touch", "Modes"});
  for (const CrushGroup& group : example_2()) {
    const SeedStatistics impact = group.of("plateau_stress_impact");
    std::map<std::string, int> modes;
    for (const bench::CsvRow& row : group.rows) ++modes[row.at("crush_mode")];
    std::string mode_words;
    for (const auto& [mode, count] : modes) mode_words += (mode_words.empty() ? "" : ", ") + mode;
    table.add_row({group.preset, fixed(group.speed, 0), std::to_string(group.elements_per_wall),
                   std::to_string(impact.count), mean_text(impact, 3), mean_text(group.of("plateau_stress_support"), 3),
                   theory_text(group, "theory_shock"), theory_text(group, "front_shock"),
                   mean_text(group.of("front_strain_behind"), 3), percent(group.greatest("energy_error_relative"), 2),
                   percent(group.greatest("deepest_penetration"), 0), percent(group.greatest("deepest_birth"), 1),
                   mode_words});
  }
  return table.text();
}

std::string order_table() {
  std::map<double, std::map<std::string, SeedStatistics>> by_speed;
  for (const CrushGroup& group : first_meshes(example_2())) {
    by_speed[group.speed][group.preset] = group.of("plateau_stress_impact");
  }
  PageTable table({"#V, m/s", "#II over I", "#III over I", "#III over II"});
  for (const auto& [speed, presets] : by_speed) {
    const auto ratio = [&, &of = presets](const std::string& one, const std::string& other) -> std::string {
      if (!of.contains(one) || !of.contains(other) || of.at(one).count < 2 || of.at(other).count < 2) return "";
      return percent_of(of.at(one).mean / of.at(other).mean - 1.0,
                        interval_of_difference(of.at(one), of.at(other)) / of.at(other).mean, 1);
    };
    table.add_row({fixed(speed, 0), ratio("type-ii-as-counted", "type-i"), ratio("type-iii-as-counted", "type-i"),
                   ratio("type-iii-as-counted", "type-ii-as-counted")});
  }
  return table.text();
}

std::string fit_table() {
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> curves;
  for (const CrushGroup& group : first_meshes(example_2())) {
    auto& [speeds, stresses] = curves[group.preset];
    speeds.push_back(group.speed);
    stresses.push_back(group.of("plateau_stress_impact").mean);
  }
  PageTable table({"Scene", "Quadratic fit, MPa, V in m/s", "#Largest deviation, MPa"});
  for (const auto& [preset, curve] : curves) {
    const auto& [speeds, stresses] = curve;
    const auto fit = client::find_quadratic_fit(speeds, stresses);
    if (!fit || speeds.size() < 4) continue;
    double worst = 0.0;
    for (std::size_t i = 0; i < speeds.size(); ++i) worst = std::max(worst, std::abs(fit->at(speeds[i]) - stresses[i]));
    char text[96];
    std::snprintf(text, sizeof(text), "%.3f %+.5f V %+.3e V²", fit->constant, fit->linear, fit->quadratic);
    table.add_row({preset, text, fixed(worst, 3)});
  }
  return table.text();
}

std::string mode_table() {
  PageTable table({"Specimen", "#V, m/s", "#Seeds", "Modes"});
  for (const CrushGroup& group : read_groups(kValidation + "modes.txt", kValidation + "modes.csv")) {
    std::map<std::string, int> modes;
    for (const bench::CsvRow& row : group.rows) ++modes[row.at("crush_mode")];
    std::vector<std::pair<int, std::string>> by_count;
    for (const auto& [mode, count] : modes) by_count.emplace_back(count, mode);
    std::ranges::sort(by_count, std::greater());
    std::string words;
    for (const auto& [count, mode] : by_count) {
      words += (words.empty() ? "" : ", ") + std::to_string(count) + " " + mode;
    }
    table.add_row({group.scene.starts_with("type-i") ? "`type-i`" : "24 x 17 cells", fixed(group.speed, 0),
                   std::to_string(group.rows.size()), words});
  }
  return table.text();
}

/// "3.5 end_strain=0.6 seed=1" without the word of the seed.
std::string without_seed(const std::string& options) { return options.substr(0, options.find(" seed=")); }

/// Presets of other papers: means over the seeds, and the work of the impact plate.
std::string published_table() {
  std::vector<std::pair<std::string, std::vector<bench::CsvRow>>> groups;  // by preset and changes
  for (const bench::CsvRow& row : bench::read_csv(kRecords + "published.csv")) {
    const std::string name = "`" + row.at("preset") + "` " + without_seed(row.at("options"));
    if (groups.empty() || groups.back().first != name) groups.push_back({name, {}});
    groups.back().second.push_back(row);
  }
  PageTable table(
      {"Preset and changes", "#Seeds", "#Impact, MPa", "#Support, MPa", "#Gibson-Ashby, MPa", "#Work, J", "Modes"});
  for (const auto& [name, rows] : groups) {
    const auto of = [&rows = rows](const char* column) {
      std::vector<double> values;
      for (const bench::CsvRow& row : rows) {
        if (const double value = bench::number_in(row, column); std::isfinite(value)) values.push_back(value);
      }
      return statistics_of(values);
    };
    std::string modes;
    for (const bench::CsvRow& row : rows) modes += (modes.empty() ? "" : ", ") + row.at("crush_mode");
    const double collapse = of("theory_gibson_ashby").mean;
    table.add_row({name, std::to_string(rows.size()), mean_text(of("plateau_stress_impact"), 3),
                   mean_text(of("plateau_stress_support"), 3), collapse > 0.0 ? fixed(collapse, 3) : "",
                   fixed(1e-3 * of("absorbed_energy").mean, 2), modes});
  }
  return table.text();
}

std::vector<bench::CsvRow> slow_half() { return bench::read_csv(kRecords + "slow_half.csv"); }

std::string name_of(const bench::CsvRow& row) { return std::filesystem::path(row.at("curve")).stem(); }

std::string slow_table() {
  PageTable table({"Crush", "#To strain", "#Impact, MPa", "#Support, MPa", "#Eq. 51, MPa", "#Ledger", "#Penetration",
                   "#Contact work", "#Crossings", "Mode"});
  for (const bench::CsvRow& row : slow_half()) {
    if (!row.at("curve").starts_with("type-")) continue;
    const auto number = [&row](const char* column) { return bench::number_in(row, column); };
    table.add_row({name_of(row), fixed(number("end_strain"), 2), fixed(number("plateau_stress_impact"), 3),
                   fixed(number("plateau_stress_support"), 3), fixed(number("theory_shock"), 3),
                   percent(number("energy_error_relative"), 2), percent(number("deepest_penetration"), 1),
                   percent(number("contact_work_share"), 2), row.at("crossings"), row.at("crush_mode")});
  }
  return table.text();
}

std::string example_1_table() {
  PageTable table({"Crush", "#Limit stress, kPa", "#at strain", "#Plateau, impact, kPa", "#Onset of densification",
                   "#Difference of the plates", "#Kinetic over plastic"});
  for (const bench::CsvRow& row : slow_half()) {
    if (!row.at("curve").starts_with("example-1")) continue;
    const auto number = [&row](const char* column) { return bench::number_in(row, column); };
    table.add_row({name_of(row), fixed(1e3 * number("limit_stress"), 1), percent(number("limit_strain"), 1),
                   fixed(1e3 * number("plateau_stress_impact"), 1), fixed(number("densification_strain"), 3),
                   percent(number("plate_force_difference"), 1), fixed(number("kinetic_over_plastic_flowing"), 4)});
  }
  return table.text();
}

std::string inclusion_table() {
  using validation::Course;
  PageTable table({"Crush", "#Onset of densification, mm", "#Twice the mean from, mm", "#Mean up to there, kPa",
                   "#Peaks over 15 %", "#over 50 %", "#over 100 %", "#Ledger", "#Penetration", "Mode"});
  for (const bench::CsvRow& row : slow_half()) {
    if (!row.at("curve").starts_with("inclusions")) continue;
    const Course course = validation::find_course(validation::read_curve(kRecords + row.at("curve")));
    const auto above = [&](double share) {
      return std::to_string(std::ranges::count_if(
          course.peaks, [&](const auto& peak) { return peak.prominence >= share * course.plateau; }));
    };
    table.add_row({name_of(row), (course.densified ? "" : "over ") + fixed(course.densification_travel, 1),
                   (course.risen ? "" : "over ") + fixed(course.rise_travel, 1), fixed(1e3 * course.plateau, 2),
                   above(validation::kSalient), above(0.5), above(1.0),
                   percent(bench::number_in(row, "energy_error_relative"), 2),
                   percent(bench::number_in(row, "deepest_penetration"), 1), row.at("crush_mode")});
  }
  return table.text();
}

}  // namespace

PageTables long_crush_tables() {
  return {{"example 1", example_1_table()},
          {"example 2", example_2_table()},
          {"order of the types", order_table()},
          {"quadratic fits", fit_table()},
          {"crush modes", mode_table()},
          {"slow crushes", slow_table()},
          {"other papers", published_table()},
          {"example 3", inclusion_table()},
          {"origin of example 2", origin_of(kValidation + "example_2.csv")},
          {"origin of slow crushes", origin_of(kRecords + "slow_half.csv")}};
}

}  // namespace cellcrush::docs
