#include "cellcrush/run_memory.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "contact/repeated_mesh.h"
#include "scene/shortening.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// Bytes that candidates and touches take for each element and unit of shortening, with the scratch of a step and what
/// the heap keeps of lists that have grown. Measured at 80 % strain in Type I, the squares and the triangles at 300
/// m/s, 30 to 74 cells long, by both section rules.
struct Growth {
  double by_faces = 475.0;
  double by_faces_in_bands = 160.0;  ///< lists are short, and reuse what others leave
  double by_buckets = 490.0;
  double of_friction = 30.0;
};
constexpr Growth kGrowth;

/// Bytes of cells, columns and frames, for each element.
constexpr double kOfSamples = 55.0;

/// Bytes of a checkpoint, for each element: of the last frame, and of touches for each unit of shortening, measured as
/// above.
constexpr double kOfFrame = 12.0;
constexpr double kTouchesInCheckpoint = 140.0;

/// Bytes of a run of any size: code that only a large crush runs, the heap's reserve. Measured: 0.2 to 0.7 MB.
constexpr double kOfRun = 400'000.0;

constexpr int kMostCells = 8;  ///< of a specimen, along either axis

double growth_by_search(const Scene& scene) {
  if (!scene.faces.are_enough()) {
    return kGrowth.by_buckets;
  }
  return scene.bands.size() > 1 ? kGrowth.by_faces_in_bands : kGrowth.by_faces;
}

/// Bytes of touches, for each element.
double bytes_of_touches(const Scene& scene, double shortening, double growth) {
  const double of_friction = scene.contact.friction > 0.0 ? kGrowth.of_friction : 0.0;
  return scene.contact.present ? shortening * (growth + of_friction) : 0.0;
}

/// Strain between plates at the end of a run.
double end_strain_of(const SceneSpec& spec) { return spec.loading.end_strain.value_or(LoadingSpec::kDefaultEndStrain); }

/// Of the lattice at the end of a run, a fraction of its extent.
double end_shortening_of(const SceneSpec& spec, const Scene& scene) {
  return scene.plates.present ? end_strain_of(spec) : shortening_of(scene);
}

/// At the strain rate of the whole lattice, on which the precision of fibres depends.
SceneSpec specimen_of(SceneSpec spec) {
  const auto limit = [&spec](auto& lattice) {
    const bool is_along_x = spec.loading.direction == LoadingSpec::Direction::x;
    const int cells = is_along_x ? *lattice.columns : *lattice.rows;
    if (auto& speed = spec.loading.speed_m_per_s) *speed *= std::min(1.0, static_cast<double>(kMostCells) / cells);
    lattice.columns = std::min(*lattice.columns, kMostCells);
    lattice.rows = std::min(*lattice.rows, kMostCells);
  };
  if (auto* lattice = std::get_if<RegularLattice>(&spec.lattice)) limit(*lattice);
  if (auto* lattice = std::get_if<VoronoiWalls>(&spec.lattice)) limit(*lattice);
  spec.changes = {};
  spec.imperfection = {};
  spec.inclusions = {};
  spec.numerics.time_step_s = 0.0;
  return spec;
}

/// Bytes of arrays for each element.
struct Share {
  double scene = 0.0;
  double state = 0.0;
};

Share share_of_element(const Scene& scene) {
  const auto elements = static_cast<double>(scene.element_count());
  Share out;
  const auto bytes = [&](const auto& array) { return static_cast<double>(array.size() * sizeof(array[0])) / elements; };
  visit_arrays(scene, [&](const auto& array) { out.scene += bytes(array); });
  State state = make_initial_state(scene);
  visit_arrays(state, [&](const auto& array) { out.state += bytes(array); });
  if (scene.can_break()) {
    out.scene *= 3.0;  // the meshes before any break, and on both sides of the newest
    out.state *= 2.0;  // samples have a copy without the new ends
  }
  if (scene.repeated != nullptr) {  // scratch of a step
    State repeated;
    begin_repeated_contacts(scene, state, repeated);
    visit_arrays(repeated, [&](const auto& array) { out.scene += bytes(array); });
  }
  return out;
}

/// A lattice may be sound only as it is: with its imperfection.
std::shared_ptr<const Scene> build_specimen(const SceneSpec& spec) {
  const SceneResult specimen = build_scene(specimen_of(spec));
  return specimen.scene ? specimen.scene : build_scene(spec).scene;
}

double bytes_of_element(const Share& share, double touches) { return share.scene + share.state + kOfSamples + touches; }

/// The most: without plates, what acts on the lattice does not act on a specimen.
double most_bytes_of_element(const SceneSpec& spec, const Scene& specimen) {
  const double shortening = specimen.plates.present ? end_strain_of(spec) : 1.0;
  return bytes_of_element(share_of_element(specimen), bytes_of_touches(specimen, shortening, kGrowth.by_buckets));
}

std::int64_t bytes_of_run(double of_element, double elements) { return std::llround(of_element * elements + kOfRun); }

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

/// What lists its walls has no specimen: it would be built a second time, beside the scene.
Share share_of_element(const SceneSpec& spec, const Scene& scene) {
  if (!std::holds_alternative<RegularLattice>(spec.lattice)) return share_of_element(scene);
  return share_of_element(*build_specimen(spec_as_built(spec, scene)));
}

}  // namespace

std::int64_t memory_of_run(const SceneSpec& spec, const Scene& scene) {
  const double shortening = end_shortening_of(spec, scene);
  const double touches = bytes_of_touches(scene, shortening, growth_by_search(scene));
  return bytes_of_run(bytes_of_element(share_of_element(spec, scene), touches),
                      static_cast<double>(scene.element_count()));
}

std::int64_t checkpoint_of_run(const SceneSpec& spec, const Scene& scene) {
  const double shortening = end_shortening_of(spec, scene);
  const double touches = scene.contact.present ? shortening * kTouchesInCheckpoint : 0.0;
  return std::llround((share_of_element(spec, scene).state + touches + kOfFrame) *
                      static_cast<double>(scene.element_count()));
}

std::int64_t most_memory_of_run(const SceneSpec& spec, std::int64_t elements) {
  // The arrays are those of the search by faces, which has more of them; the lists are those of the buckets.
  return bytes_of_run(most_bytes_of_element(spec, *build_specimen(spec)), static_cast<double>(elements));
}

std::int64_t MemoryForecast::most_of_run(const SceneSpec& spec, std::int64_t elements) {
  SceneSpec specimen = specimen_of(spec);
  if (bytes_of_element_ == 0.0 || specimen != specimen_) {
    const auto scene = build_scene(specimen).scene;
    if (!scene) {
      return most_memory_of_run(spec, elements);
    }
    bytes_of_element_ = most_bytes_of_element(spec, *scene);
    specimen_ = std::move(specimen);
  }
  return bytes_of_run(bytes_of_element_, static_cast<double>(elements));
}

}  // namespace cellcrush
