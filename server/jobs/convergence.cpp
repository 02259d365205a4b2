#include "jobs/convergence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "cellcrush/convergence.h"
#include "columns/result_columns.h"
#include "columns/swept_fields.h"
#include "error.h"
#include "translate/case_words.h"

namespace cellcrush::jobs {
namespace {

constexpr const char* kMeshField = "elements_per_wall";

/// A quantity of a summary, by the path of its field.
struct Measure {
  const char* field;
  bool decides;  ///< on the mesh that meets the wanted error
};

constexpr std::array kOfPlates = {Measure{"plateau_stress_impact_mpa", true},
                                  Measure{"plateau_stress_support_mpa", true}, Measure{"densification_strain", false},
                                  Measure{"absorbed_energy_mj", false}};
constexpr std::array kOfAFrame = {Measure{"ledger.work_external_mj", true}, Measure{"ledger.plastic_mj", true},
                                  Measure{"fibre_strain.largest", false}};

/// What was swept over: the case and the places of the values in a row.
struct Study {
  bool plates;
  bool frame;
  std::size_t mesh_index;
  std::optional<std::size_t> seed_index;

  [[nodiscard]] std::span<const Measure> measures() const {
    return plates ? std::span<const Measure>(kOfPlates) : std::span<const Measure>(kOfAFrame);
  }
};

/// Throws for a sweep over other fields.
Study study_of(const v1::Sweep& sweep) {
  const std::vector<std::string> fields = swept_fields(sweep);
  const auto mesh = std::ranges::find(fields, kMeshField);
  const bool has_others =
      std::ranges::any_of(fields, [](const std::string& field) { return field != kMeshField && field != kSeedField; });
  if (mesh == fields.end() || has_others) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       sweep.name() + " is no sweep over meshes. Create one over " + kMeshField + ", and over " +
                           kSeedField + " for the scatter, and over nothing else.");
  }
  Study study{translate::has_plates(sweep.case_()), sweep.case_().lattice().has_frame(),
              static_cast<std::size_t>(mesh - fields.begin()), std::nullopt};
  const auto seed = std::ranges::find(fields, kSeedField);
  if (seed != fields.end()) study.seed_index = static_cast<std::size_t>(seed - fields.begin());
  return study;
}

int elements_of(const v1::SweepTable::Row& row, const Study& study) {
  return static_cast<int>(row.values(static_cast<int>(study.mesh_index)));
}

/// Nothing if fewer than two meshes have the quantity, or if it is 0.
std::optional<MeshConvergence> convergence_of(const Measure& measure, const std::vector<v1::SweepTable::Row>& rows,
                                              const Study& study) {
  std::map<int, MeshResult> results;
  for (const auto& row : rows) {
    if (row.result().state() != v1::Job::SUCCEEDED) continue;
    const int elements = elements_of(row, study);
    results[elements].elements_per_wall = elements;
    if (const auto value = find_result(row.result().summary(), measure.field))
      results[elements].values.push_back(*value);
  }
  std::vector<MeshResult> list;
  list.reserve(results.size());
  for (auto& [elements, result] : results) list.push_back(std::move(result));
  auto found = estimate_convergence(std::move(list));
  return found && found->limit.value != 0.0 ? found : std::nullopt;
}

/// Whether the interval of a limit is known. Every run of a frame is the same.
bool has_interval(const MeshConvergence& found, const Study& study) {
  return study.frame || found.limit.scatter_part.has_value();
}

void write(const MeshConvergence& found, const Measure& measure, const Study& study, v1::Convergence& out) {
  auto& quantity = *out.add_quantities();
  quantity.set_field(measure.field);
  quantity.set_decides(measure.decides);
  quantity.set_limit(found.limit.value);
  if (has_interval(found, study)) quantity.set_interval(found.limit.half_width());
  if (found.limit.order) quantity.set_order(*found.limit.order);
  for (const MeshMean& mean : found.meshes) {
    auto& mesh = *quantity.add_meshes();
    mesh.set_elements_per_wall(mean.elements_per_wall);
    mesh.set_job_count(mean.of_seeds.count);
    mesh.set_mean(mean.of_seeds.mean);
    if (mean.of_seeds.count > 1) {
      mesh.set_scatter_relative(std::abs(mean.of_seeds.deviation / mean.of_seeds.mean));
    }
    mesh.set_error_relative(mean.error);
    if (has_interval(found, study)) mesh.set_uncertainty_relative(found.uncertainty());
  }
}

/// The coarsest mesh with which every deciding quantity is within the error.
std::optional<int> coarsest_within(double wanted, const v1::Convergence& found, const Study& study) {
  std::map<int, int> meets;  // number of deciding quantities, by mesh
  int deciding = 0;
  for (const auto& quantity : found.quantities()) {
    if (!quantity.decides()) continue;
    ++deciding;
    for (const auto& mesh : quantity.meshes()) {
      const bool is_within =
          mesh.has_uncertainty_relative() && mesh.error_relative() + mesh.uncertainty_relative() <= wanted;
      meets[mesh.elements_per_wall()] += is_within ? 1 : 0;
    }
  }
  const auto required = std::ranges::count_if(study.measures(), &Measure::decides);
  if (deciding == 0 || (study.plates && deciding < required)) return std::nullopt;
  for (const auto& [elements, count] : meets) {
    if (count == deciding) return elements;
  }
  return std::nullopt;
}

void add_warnings(const v1::SweepTable::Row& row, const Study& study, v1::Convergence& out) {
  if (row.result().state() != v1::Job::SUCCEEDED) return;
  for (const v1::Warning& warning : row.result().summary().warnings()) {
    auto& all = *out.mutable_warnings();
    auto same = std::ranges::find(all, warning.kind(), [](const auto& known) { return known.warning().kind(); });
    if (same == all.end()) {
      *all.Add()->mutable_warning() = warning;
      same = std::prev(all.end());
    }
    auto& run = *same->add_runs();
    run.set_job(row.job());
    run.set_elements_per_wall(elements_of(row, study));
    if (study.seed_index) run.set_seed(static_cast<std::uint64_t>(row.values(static_cast<int>(*study.seed_index))));
  }
}

}  // namespace

v1::Convergence convergence_of(const v1::Sweep& sweep, const std::vector<v1::SweepTable::Row>& rows,
                               double wanted_error) {
  const Study study = study_of(sweep);
  v1::Convergence out;
  out.set_mesh_words(translate::mesh_words(sweep.case_()));
  out.set_wanted_error_relative(wanted_error);
  out.set_job_count_left_out(static_cast<int>(
      std::ranges::count_if(rows, [](const auto& row) { return row.result().state() != v1::Job::SUCCEEDED; })));
  for (const Measure& measure : study.measures()) {
    if (const auto found = convergence_of(measure, rows, study)) write(*found, measure, study, out);
  }
  if (const auto mesh = coarsest_within(wanted_error, out, study)) out.set_elements_per_wall(*mesh);
  for (const auto& row : rows) add_warnings(row, study, out);
  return out;
}

}  // namespace cellcrush::jobs
