#include "scene/check_spec.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace cellcrush {
namespace {

constexpr std::size_t kLeastPoints = 2;
constexpr std::size_t kMostPoints = 64;

bool ascends(const std::vector<double>& values) {
  return std::ranges::adjacent_find(values, std::greater_equal()) == values.end();
}

bool is_finite(const std::vector<double>& values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// One list of a table over another.
struct Columns {
  std::string path;  ///< of the table
  const std::vector<double>& at;
  const char* at_name;
  const std::vector<double>& values;
  const char* value_name;
};

/// Whether a table that is given has points that define a rising curve.
bool check_points(const Columns& of, FieldChecker& check) {
  if (of.at.size() != of.values.size()) {
    check.add(of.path + of.value_name, std::to_string(of.values.size()) + " numbers",
              "do not match the " + std::to_string(of.at.size()) + " of " + of.at_name + ".",
              "Give one for each of them.");
    return false;
  }
  if (of.at.size() < kLeastPoints || of.at.size() > kMostPoints) {
    check.add(of.path + of.at_name, std::to_string(of.at.size()) + " points", "are too few or too many.",
              "Give 2 to 64 points.");
    return false;
  }
  if (!is_finite(of.at) || !ascends(of.at)) {
    check.add(of.path + of.at_name, "", "do not ascend.", "Give finite numbers, each above the one before it.");
    return false;
  }
  if (!is_finite(of.values) || !std::ranges::is_sorted(of.values)) {
    check.add(of.path + of.value_name, "", "fall.",
              "Give finite numbers, none below the one before it: a softening wall would break at one section, which "
              "depends on the mesh.");
    return false;
  }
  return true;
}

/// A parameter of a term that is on, which must have at least some value.
void needs(const std::string& path, const char* term, double value_of_term, const char* exponent, double value,
           double least, FieldChecker& check) {
  if (value_of_term > 0.0 && value < least) {
    check.add(path + exponent, to_text(value), std::string("is too small for the term that ") + term + " switches on.",
              "Give a value of at least " + to_text(least) + ", or leave " + term + " out.");
  }
}

void check_hardening_table(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  const HardeningTable& table = material.hardening_table;
  if (table.plastic_strains.empty() && table.stresses_mpa.empty()) return;
  const std::string of_table = path + "hardening_table.";
  if (material.hardening_modulus_mpa > 0.0 || material.voce_stress_mpa > 0.0 || material.ludwik_stress_mpa > 0.0) {
    check.add(path + "hardening_table", "", "is given beside other terms of hardening.",
              "Leave out hardening_modulus_mpa, voce_stress_mpa and ludwik_stress_mpa, or the table.");
  }
  if (!check_points({of_table, table.plastic_strains, "plastic_strains", table.stresses_mpa, "stresses_mpa"}, check)) {
    return;
  }
  if (table.plastic_strains.front() != 0.0) {
    check.add(of_table + "plastic_strains[0]", to_text(table.plastic_strains.front()), "is not 0.",
              "Begin the curve at the yield stress, with a plastic strain of 0.");
  }
  constexpr double kRounding = 1e-9;
  const double yield = material.yield_stress_mpa.value_or(table.stresses_mpa.front());
  if (std::abs(table.stresses_mpa.front() - yield) > kRounding * yield) {
    check.add(of_table + "stresses_mpa[0]", to_text(table.stresses_mpa.front()),
              "is not the yield stress of " + to_text(yield) + " MPa.",
              "Set " + path + "yield_stress_mpa to " + to_text(table.stresses_mpa.front()) + ", or leave it out.");
  }
}

void check_rate_table(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  const RateTable& table = material.rate_table;
  if (table.rates_per_s.empty() && table.factors.empty()) return;
  const std::string of_table = path + "rate_table.";
  if (!check_points({of_table, table.rates_per_s, "rates_per_s", table.factors, "factors"}, check)) return;
  if (!(table.rates_per_s.front() > 0.0)) {
    check.add(of_table + "rates_per_s[0]", to_text(table.rates_per_s.front()), "is not above 0.",
              "Begin with the rate at which the yield stress was measured.");
  }
  if (table.factors.front() != 1.0) {
    check.add(of_table + "factors[0]", to_text(table.factors.front()), "is not 1.",
              "Divide the stresses by that of the lowest rate, and give that as yield stress.");
  }
}

/// What the parameters of a law must be to each other, and its tables.
void check_law(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  needs(path, "voce_stress_mpa", material.voce_stress_mpa, "voce_exponent", material.voce_exponent, 1e-6, check);
  needs(path, "ludwik_stress_mpa", material.ludwik_stress_mpa, "ludwik_exponent", material.ludwik_exponent, 0.01,
        check);
  needs(path, "cowper_symonds_rate_per_s", material.cowper_symonds_rate_per_s, "cowper_symonds_exponent",
        material.cowper_symonds_exponent, 1.0, check);
  check_hardening_table(path, material, check);
  check_rate_table(path, material, check);
  const bool has_table = !material.rate_table.rates_per_s.empty();
  const int rate_laws = (material.cowper_symonds_rate_per_s > 0.0 ? 1 : 0) +
                        (material.johnson_cook_coefficient > 0.0 ? 1 : 0) + (has_table ? 1 : 0);
  if (rate_laws > 1) {
    check.add(path + (has_table ? "rate_table" : "johnson_cook_coefficient"),
              has_table ? "" : to_text(material.johnson_cook_coefficient),
              "is given beside another law of the rate.",
              "Give one of cowper_symonds_rate_per_s, johnson_cook_coefficient and rate_table.");
  }
}

}  // namespace

void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  check.within_limits(path + "youngs_modulus_mpa", material.youngs_modulus_mpa);
  check.within_limits(path + "yield_stress_mpa", material.yield_stress_mpa);
  for (const LawParameter& parameter : kLawParameters) {
    check.within_limits(path + parameter.name, material.*parameter.value);
  }
  check.within_limits(path + "poissons_ratio", material.poissons_ratio);
  check.within_limits(path + "density_kg_per_m3", material.density_kg_per_m3);
  check_law(path, material, check);
}

}  // namespace cellcrush
