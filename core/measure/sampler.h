#pragma once

#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "measure/crush_mode.h"
#include "measure/lateral_strain.h"
#include "measure/layers.h"
#include "measure/local_strain.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Takes samples of a run. Stresses and reactions are means over the interval between two samples, from the impulses of
/// plates, rigid walls and supports: a penalty contact oscillates, so the force at one time says little. Collapse and
/// front follow from the current positions and velocities. Only a lattice between plates has cells, columns and a
/// front; one between two rigid walls has strain and stress (CrushingWalls).
class Sampler {
 public:
  explicit Sampler(const Scene& scene);

  /// A run of which walls may have broken (E6g).
  struct Run {
    const Scene& scene;  ///< the mesh now
    const State& state;
    const Scene& unbroken;  ///< the mesh before any break, that of the constructor
    const State& joined;    ///< without the new ends; the same if nothing has broken
  };

  /// The workers share what looks at every element.
  Sample take(const Run& run, Workers& workers);

  /// Overwrites a frame with positions, the fraction of the section area of each element that has yielded, and the
  /// largest fibre strain and local strain of each wall. REQUIRES: the frame is empty or of the same run.
  void make_frame(const Run& run, int index, FieldFrame& frame) const;

  /// Calls visitor(field) for all data that a sample passes on to the next one.
  template <class Visitor>
  void visit_memory(Visitor&& visitor) {
    visitor(last_time_);
    visitor(last_impact_impulse_);
    visitor(last_support_impulse_);
    visitor(last_reaction_impulse_);
    visitor(last_wall_totals_);
    visitor(last_wall_speed_);
    visitor(last_grip_impulse_);
    visitor(has_warned_of_depth_);
    visitor(has_warned_of_search_);
    visitor(has_warned_of_necks_);
    visitor(has_warned_of_density_);
    visitor(has_warned_of_closing_);
    visitor(break_count_);
    visitor(next_check_);
    visitor(next_layer_strain_);
    visitor(densest_layer_);
    visitor(absorbed_);
  }

 private:
  void measure_watched(const Scene& scene, const State& state, Sample& sample);
  void measure_rigid_walls(const Scene& scene, const State& state, Sample& sample);
  void measure_grips(const Scene& scene, const State& state, Sample& sample);
  void measure_closing(const Scene& scene, const State& state, Sample& sample);
  void measure_stress(const Scene& scene, const State& state, Sample& sample);
  void measure_efficiency(const Scene& scene, Sample& sample);
  void measure_lattice(const Run& run, Sample& sample);
  void measure_collapse(const Run& run, Sample& sample);
  void list_breaks(const State& state, Sample& sample);
  void find_warnings(const Scene& scene, const State& state, Sample& sample);

  /// Energy that a volume of the lattice has absorbed by a sample.
  struct Absorbed {
    double strain = 0.0;  ///< nominal
    double energy = 0.0;  ///< N mm / mm^3, of its curve
  };

  Cells cells_;
  LocalStrain local_strain_;
  SidePairs side_pairs_;
  Columns columns_;
  LayerSize layer_size_;
  double last_time_ = 0.0;
  double last_impact_impulse_ = 0.0;
  double last_support_impulse_ = 0.0;
  std::vector<ReactionImpulse> last_reaction_impulse_;  ///< of the watched particles
  std::vector<RigidWallTotals> last_wall_totals_;       ///< of the rigid walls
  std::vector<double> last_wall_speed_;                 ///< mm/s
  std::vector<Vector2> last_grip_impulse_;              ///< of the grips
  bool has_warned_of_depth_ = false;
  bool has_warned_of_search_ = false;
  bool has_warned_of_necks_ = false;
  bool has_warned_of_density_ = false;
  bool has_warned_of_closing_ = false;
  std::int64_t break_count_ = 0;    ///< listed so far
  double next_layer_strain_ = 0.0;  ///< strain from which the densest layer is found again
  DensestLayer densest_layer_;
  std::vector<Absorbed> absorbed_ = std::vector<Absorbed>(1);  ///< the first at or before the window of the efficiency
  bool can_close_by_walls_ = false;  ///< rigid walls crush, with gaps in what is between them before loading
  double next_check_;                ///< fraction of collapsed cells at which the crush mode is next evaluated
};

}  // namespace cellcrush
