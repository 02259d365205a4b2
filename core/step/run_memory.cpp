#include "step/run_memory.h"

#include <algorithm>
#include <cmath>

#include "cellcrush/scene_arrays.h"
#include "cellcrush/state.h"
#include "cellcrush/tuning.h"
#include "measure/sampler.h"
#include "step/workspace.h"

namespace cellcrush {
namespace {

bool grows(Per per) { return per >= Per::candidate; }

double held_of_growing(const ArrayCounts& counts) {
  if (counts[Per::band] > 1) {
    return 1.0;
  }
  return (counts.has & kFaces) != 0 ? kHeldByFaces : kHeldByBuckets;
}

/// Sums the bytes of arrays by their shapes, whatever they hold.
class ByteSum {
 public:
  explicit ByteSum(const ArrayCounts& counts) : counts_(counts), held_of_growing_(held_of_growing(counts)) {}

  template <class Array>
  void operator()(const char*, const Array&, const Shape& shape) {
    const double bytes = static_cast<double>(counts_.entries_of(shape) * sizeof(typename Array::value_type));
    sum_ += grows(shape.per) ? held_of_growing_ * bytes : bytes;
  }

  [[nodiscard]] double sum() const { return sum_; }

 private:
  const ArrayCounts& counts_;
  double held_of_growing_;
  double sum_ = 0.0;
};

void add_growth(double strain, ArrayCounts& counts) {
  if ((counts.has & kContact) == 0) {
    return;
  }
  const bool by_faces = (counts.has & kFaces) != 0;
  const double crushed = strain * static_cast<double>(counts[Per::element]);
  const std::size_t bands = counts[Per::band];
  const auto candidates =
      static_cast<std::size_t>(crushed * (by_faces ? kGrowth.candidates_by_faces : kGrowth.candidates_by_buckets));
  const auto touches = static_cast<std::size_t>(crushed * kGrowth.touches);
  counts[Per::candidate] = candidates;
  counts[Per::candidate_batch] = candidates / kCandidateBatch;
  counts[Per::touch] = touches;
  counts[Per::candidate_of_band] = candidates / bands;
  counts[Per::touch_of_band] = touches / bands;
}

}  // namespace

double end_strain_of(const Plates& plates, const Schedule& schedule, double length) {
  const double time = static_cast<double>(schedule.step_count) * schedule.time_step;
  return plates.present ? plates.speed * std::max(0.0, time - 0.5 * plates.ramp_time) / length : 1.0;
}

std::int64_t memory_of_run(ArrayCounts counts, double end_strain) {
  add_growth(std::min(end_strain, 1.0), counts);
  ByteSum bytes(counts);
  Scene scene;
  scene.faces.bands.resize(1);
  visit_arrays(scene, bytes);
  visit_arrays(State(), bytes);
  Workspace workspace;
  workspace.shared.contact.parts.resize(1);
  workspace.records.resize(counts[Per::band] > 1 ? kMostStepsInWavefront : 1);
  visit_arrays(workspace, bytes);
  visit_arrays(Faces(), bytes);
  visit_arrays(Columns(), bytes);
  for (int i = 0; i < 2; ++i) {  // kept, and being made
    visit_arrays(CollapseField(), bytes);
    visit_arrays(FieldFrame(), bytes);
  }
  return std::llround(bytes.sum() + kOfRun);
}

std::int64_t memory_of_run(const Scene& scene) {
  return memory_of_run(counts_of(scene), end_strain_of(scene.plates, scene.schedule, scene.length));
}

}  // namespace cellcrush
