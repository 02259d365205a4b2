#include "cellcrush/run_memory.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "cellcrush/scene_arrays.h"
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

/// Bytes of a run of any size: code that only a large crush runs, the heap's reserve. Measured: 0.2 to 0.7 MB.
constexpr double kOfRun = 400'000.0;

constexpr int kMostCells = 8;  ///< of a specimen, along either axis

double growth_of(const Scene& scene, bool in_bands) {
  if (!scene.contact.present) {
    return 0.0;
  }
  const double by_faces = in_bands ? kGrowth.by_faces_in_bands : kGrowth.by_faces;
  const double of_friction = scene.contact.friction > 0.0 ? kGrowth.of_friction : 0.0;
  return (scene.faces.are_enough() ? by_faces : kGrowth.by_buckets) + of_friction;
}

SceneSpec specimen_of(SceneSpec spec) {
  std::visit(
      [](auto& lattice) {
        if constexpr (requires { lattice.columns; }) {
          lattice.columns = std::min(*lattice.columns, kMostCells);
          lattice.rows = std::min(*lattice.rows, kMostCells);
        }
      },
      spec.lattice);
  spec.imperfection = {};
  spec.inclusions = {};
  spec.numerics.time_step_s = 0.0;
  return spec;
}

double bytes_of_arrays(const Scene& scene) {
  double bytes = 0.0;
  const auto add = [&bytes](const auto& array) { bytes += static_cast<double>(array.size() * sizeof(array[0])); };
  visit_arrays(scene, add);
  visit_arrays(make_initial_state(scene), add);
  return bytes;
}

double bytes_of_run(const SceneSpec& spec, double elements, bool in_bands) {
  const SceneResult specimen = build_scene(specimen_of(spec));
  // A lattice may be sound only as it is: with its imperfection.
  const auto scene = specimen.scene ? specimen.scene : build_scene(spec).scene;
  const bool is_frame = std::holds_alternative<FrameLattice>(spec.lattice);
  const double end_strain = is_frame ? 1.0 : spec.loading.end_strain;  // nobody says how near a frame's beams come
  const double of_element = bytes_of_arrays(*scene) / static_cast<double>(scene->element_count()) + kOfSamples +
                            end_strain * growth_of(*scene, in_bands);
  return of_element * elements + kOfRun;
}

}  // namespace

std::int64_t memory_of_run(const SceneSpec& spec, const Scene& scene) {
  SceneSpec as_built = spec;
  if (!scene.faces.are_enough()) {
    as_built.contact.search = ContactSpec::Search::buckets;
  }
  return std::llround(bytes_of_run(as_built, static_cast<double>(scene.element_count()), scene.bands.size() > 1));
}

std::int64_t most_memory_of_run(const SceneSpec& spec, std::int64_t elements) {
  SceneSpec by_buckets = spec;
  by_buckets.contact.search = ContactSpec::Search::buckets;
  const auto count = static_cast<double>(elements);
  return std::llround(std::max(bytes_of_run(spec, count, false), bytes_of_run(by_buckets, count, false)));
}

}  // namespace cellcrush
