#include "cellcrush/run_memory.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// Bytes that candidates and touches take for each element and unit of strain, with the scratch of a step and what the
/// heap keeps of lists that have grown. Measured at 80 % strain in Type I, the squares and the triangles at 300 m/s, 30
/// to 74 cells long, by both section rules.
struct Growth {
  double by_faces = 475.0;
  double by_faces_in_bands = 160.0;  ///< lists are short, and reuse what others leave
  double by_buckets = 490.0;
  double of_friction = 30.0;
};
constexpr Growth kGrowth;

/// Bytes of cells, columns and frames, for each element.
constexpr double kOfSamples = 55.0;

/// Bytes of a frame, for each element, and the share of what grows over a crush that a checkpoint has.
constexpr double kOfFrame = 12.0;
constexpr double kShareInCheckpoint = 0.3;

/// Bytes of a run of any size: code that only a large crush runs, the heap's reserve. Measured: 0.2 to 0.7 MB.
constexpr double kOfRun = 400'000.0;

constexpr int kMostCells = 8;  ///< of a specimen, along either axis

double growth_by_search(const Scene& scene) {
  if (!scene.faces.are_enough()) {
    return kGrowth.by_buckets;
  }
  return scene.bands.size() > 1 ? kGrowth.by_faces_in_bands : kGrowth.by_faces;
}

/// At the strain rate of the whole lattice, on which the precision of fibres depends.
SceneSpec specimen_of(SceneSpec spec) {
  if (auto* lattice = std::get_if<RegularLattice>(&spec.lattice)) {
    const bool is_along_x = spec.loading.direction == LoadingSpec::Direction::x;
    const int cells = is_along_x ? *lattice->columns : *lattice->rows;
    *spec.loading.speed_m_per_s *= std::min(1.0, static_cast<double>(kMostCells) / cells);
    lattice->columns = std::min(*lattice->columns, kMostCells);
    lattice->rows = std::min(*lattice->rows, kMostCells);
  }
  spec.imperfection = {};
  spec.inclusions = {};
  spec.numerics.time_step_s = 0.0;
  return spec;
}

/// Bytes for each element.
struct Share {
  double scene = 0.0;
  double state = 0.0;
  double touches = 0.0;  ///< at the end of the run
};

Share share_of_element(const SceneSpec& spec, const std::shared_ptr<const Scene>& scene, double growth) {
  const auto elements = static_cast<double>(scene->element_count());
  Share out;
  const auto bytes = [&](const auto& array) { return static_cast<double>(array.size() * sizeof(array[0])) / elements; };
  visit_arrays(*scene, [&](const auto& array) { out.scene += bytes(array); });
  visit_arrays(make_initial_state(*scene), [&](const auto& array) { out.state += bytes(array); });
  // Without plates, nobody says how near the walls come.
  const double end_strain =
      scene->plates.present ? spec.loading.end_strain.value_or(LoadingSpec::kDefaultEndStrain) : 1.0;
  const double of_friction = scene->contact.friction > 0.0 ? kGrowth.of_friction : 0.0;
  if (scene->contact.present) out.touches = end_strain * (growth + of_friction);
  return out;
}

Share share_of_element(const SceneSpec& spec, double growth) {
  const SceneResult specimen = build_scene(specimen_of(spec));
  // A lattice may be sound only as it is: with its imperfection.
  return share_of_element(spec, specimen.scene ? specimen.scene : build_scene(spec).scene, growth);
}

double bytes_of_element(const Share& share) { return share.scene + share.state + kOfSamples + share.touches; }

double bytes_of_run(const SceneSpec& spec, double elements, double growth) {
  return bytes_of_element(share_of_element(spec, growth)) * elements + kOfRun;
}

/// As the scene was built after all.
SceneSpec spec_as_built(SceneSpec spec, const Scene& scene) {
  if (!scene.single_fibres) {
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  }
  if (!scene.faces.are_enough()) {
    spec.contact.search = ContactSpec::Search::buckets;
  }
  return spec;
}

}  // namespace

std::int64_t memory_of_run(const SceneSpec& spec, const Scene& scene) {
  const auto elements = static_cast<double>(scene.element_count());
  return std::llround(bytes_of_run(spec_as_built(spec, scene), elements, growth_by_search(scene)));
}

std::int64_t checkpoint_of_run(const SceneSpec& spec, const Scene& scene) {
  const Share share = share_of_element(spec_as_built(spec, scene), kShareInCheckpoint * growth_by_search(scene));
  return std::llround((share.state + share.touches + kOfFrame) * static_cast<double>(scene.element_count()));
}

std::int64_t most_memory_of_run(const SceneSpec& spec, std::int64_t elements) {
  // The arrays are those of the search by faces, which has more of them; the lists are those of the buckets.
  return std::llround(bytes_of_run(spec, static_cast<double>(elements), kGrowth.by_buckets));
}

std::int64_t MemoryForecast::most_of_run(const SceneSpec& spec, std::int64_t elements) {
  SceneSpec specimen = specimen_of(spec);
  if (bytes_of_element_ == 0.0 || specimen != specimen_) {
    const auto scene = build_scene(specimen).scene;
    if (!scene) {
      return most_memory_of_run(spec, elements);
    }
    bytes_of_element_ = bytes_of_element(share_of_element(specimen, scene, kGrowth.by_buckets));
    specimen_ = std::move(specimen);
  }
  return std::llround(bytes_of_element_ * static_cast<double>(elements) + kOfRun);
}

}  // namespace cellcrush
