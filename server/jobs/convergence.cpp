#include "jobs/convergence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "cellcrush/convergence.h"
#include "columns/swept_fields.h"
#include "error.h"
#include "jobs/seed_means.h"

namespace cellcrush::jobs {
namespace {

constexpr const char* kMeshField = "elements_per_wall";

/// A quantity of a summary, by the name of its field.
struct Measure {
  const char* field;
  bool is_plateau;
};

constexpr std::array kMeasures = {Measure{"plateau_stress_impact_mpa", true},
                                  Measure{"plateau_stress_support_mpa", true}, Measure{"densification_strain", false},
                                  Measure{"absorbed_energy_mj", false}};

/// Index of the elements per wall in the values of a row.
std::size_t mesh_index_of(const v1::Sweep& sweep) {
  const std::vector<std::string> fields = swept_fields(sweep);
  const auto mesh = std::ranges::find(fields, kMeshField);
  const bool has_others =
      std::ranges::any_of(fields, [](const std::string& field) { return field != kMeshField && field != kSeedField; });
  if (mesh == fields.end() || has_others) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       sweep.name() + " is no sweep over meshes. Create one over " + kMeshField + ", and over " +
                           kSeedField + " for the scatter, and over nothing else.");
  }
  return static_cast<std::size_t>(mesh - fields.begin());
}

std::vector<MeshEstimate> estimates_of(const Measure& measure, const std::vector<v1::SweepTable::Row>& rows,
                                       std::size_t mesh_index) {
  std::map<int, MeshResult> results;
  for (const auto& row : rows) {
    if (row.result().state() != v1::Job::SUCCEEDED) continue;
    const int elements = static_cast<int>(row.values(static_cast<int>(mesh_index)));
    results[elements].elements_per_wall = elements;
    if (const auto value = find_result(row.result().summary(), measure.field))
      results[elements].values.push_back(*value);
  }
  std::vector<MeshResult> list;
  list.reserve(results.size());
  for (auto& [elements, result] : results) list.push_back(std::move(result));
  return estimate_mesh_errors(std::move(list));
}

void write(const std::vector<MeshEstimate>& estimates, const char* field, v1::Convergence& out) {
  if (estimates.empty()) return;
  auto& quantity = *out.add_quantities();
  quantity.set_field(field);
  for (const MeshEstimate& estimate : estimates) {
    auto& mesh = *quantity.add_meshes();
    mesh.set_elements_per_wall(estimate.elements_per_wall);
    mesh.set_job_count(estimate.of_seeds.count);
    mesh.set_mean(estimate.of_seeds.mean);
    if (estimate.of_seeds.count > 1) {
      mesh.set_scatter_relative(std::abs(estimate.of_seeds.deviation / estimate.of_seeds.mean));
    }
    mesh.set_error_relative(estimate.error);
    if (std::isfinite(estimate.uncertainty)) mesh.set_uncertainty_relative(estimate.uncertainty);
  }
}

/// The coarsest mesh whose plateaus are all within the error.
std::optional<int> coarsest_within(double wanted, const std::vector<std::vector<MeshEstimate>>& plateaus) {
  for (const MeshEstimate& mesh : plateaus.front()) {
    const bool meets = std::ranges::all_of(plateaus, [&](const std::vector<MeshEstimate>& plateau) {
      const auto same = std::ranges::find(plateau, mesh.elements_per_wall, &MeshEstimate::elements_per_wall);
      return same != plateau.end() && same->bound() <= wanted;
    });
    if (meets) return mesh.elements_per_wall;
  }
  return std::nullopt;
}

}  // namespace

v1::Convergence convergence_of(const v1::Sweep& sweep, const std::vector<v1::SweepTable::Row>& rows,
                               double wanted_error) {
  const std::size_t mesh_index = mesh_index_of(sweep);
  v1::Convergence out;
  out.set_wanted_error_relative(wanted_error);
  out.set_job_count_left_out(static_cast<int>(
      std::ranges::count_if(rows, [](const auto& row) { return row.result().state() != v1::Job::SUCCEEDED; })));
  std::vector<std::vector<MeshEstimate>> plateaus;
  for (const Measure& measure : kMeasures) {
    auto estimates = estimates_of(measure, rows, mesh_index);
    write(estimates, measure.field, out);
    if (measure.is_plateau) plateaus.push_back(std::move(estimates));
  }
  if (const auto mesh = coarsest_within(wanted_error, plateaus)) out.set_elements_per_wall(*mesh);
  return out;
}

}  // namespace cellcrush::jobs
