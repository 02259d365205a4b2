#include "measure/sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "beam/element_place.h"
#include "contact/contact_search.h"
#include "energy/ledger.h"
#include "measure/crush_mode.h"
#include "measure/fibre_strain.h"
#include "measure/layers.h"
#include "measure/warnings.h"
#include "motion/grips.h"
#include "push/crush.h"
#include "push/half_planes.h"
#include "scene/solid_area.h"

namespace cellcrush {
namespace {

/// The crush mode is evaluated each time that this fraction of the cells has newly collapsed, because it takes as long
/// as many steps.
constexpr double kCheckEvery = 0.04;

/// Strain after which the densest layer is found again: it takes as long as a step.
constexpr double kLayerEvery = 0.005;

/// Rows in which the sides of a frame without cells are looked for, over its length.
constexpr double kRowsWithoutCells = 16.0;

/// Fraction of the volume of an element whose fibres have yielded.
class FlowedShare {
 public:
  explicit FlowedShare(const SectionRule& rule) {
    for (const double along : rule.along_weight) {
      for (const double through : rule.depth_weight) {
        share_.push_back(along * through);
      }
    }
    of_byte_.resize((share_.size() + 7) / 8);
    for (std::size_t fibre = 0; fibre < share_.size(); ++fibre) {
      std::array<double, 256>& of_byte = of_byte_[fibre / 8];
      for (std::size_t byte = 0; byte < of_byte.size(); ++byte) {
        of_byte[byte] += (byte >> fibre % 8 & 1) != 0 ? share_[fibre] : 0.0;
      }
    }
  }

  template <class T>
  [[nodiscard]] double of(const FibreHistory<T>& fibres, const ElementPlace& place) const {
    double fraction = 0.0;
    if (fibres.yielded.empty()) {
      for (std::size_t fibre = 0; fibre < share_.size(); ++fibre) {
        fraction += fibres.plastic_strain[place.index(share_.size(), fibre)] > T(0.0) ? share_[fibre] : 0.0;
      }
    } else {
      auto yielded = fibres.yielded[place.element];
      for (const std::array<double, 256>& of_byte : of_byte_) {
        fraction += of_byte[yielded & 255];
        yielded >>= 8;
      }
    }
    return fraction;
  }

 private:
  std::vector<double> share_;                     ///< share of each fibre in the volume
  std::vector<std::array<double, 256>> of_byte_;  ///< sum over the fibres whose bits are set in a byte
};

/// Impulse of the supports at a node, of all joints of its pin together.
ReactionImpulse impulse_at(const Scene& scene, const State& state, int node) {
  ReactionImpulse sum = state.reaction_impulse[node];
  const auto pins = std::span(scene.pins.offset).first(scene.pins.count());  // in the order of their nodes
  const auto found = std::ranges::lower_bound(pins, node, {}, [&](int first) { return scene.pins.joint[first]; });
  if (found != pins.end() && scene.pins.joint[*found] == node) {
    for (const int joint : scene.pins.joints_of(found - pins.begin()).subspan(1)) {
      sum.x += state.reaction_impulse[joint].x;
      sum.y += state.reaction_impulse[joint].y;
    }
  }
  return sum;
}

/// Between rigid walls that face each other, or of a lattice at an only wall.
double solid_fraction_by_walls(const Scene& scene, std::span<const Vector2> position,
                               std::span<const RigidWallMotion> motions, double strain) {
  return is_crushed(scene) && !has_support(scene) ? solid_fraction_at(scene, strain)
                                                  : solid_fraction_between_walls(scene, position, motions);
}

}  // namespace

Sampler::Sampler(const Scene& scene)
    : last_reaction_impulse_(scene.watched.size()),
      last_wall_totals_(scene.rigid_walls.size()),
      last_grip_impulse_(scene.grips.size(), Vector2(0.0, 0.0)),
      next_check_(kModeFrom) {
  if (is_crushed(scene)) {
    cells_ = find_cells(scene);
    local_strain_ = LocalStrain(scene, cells_.faces);
    side_pairs_ =
        find_side_pairs(scene, cells_.faces.count() > 0 ? cells_.field.pitch : scene.length / kRowsWithoutCells);
  }
  if (!scene.plates.present) {
    const double fraction = solid_fraction_by_walls(scene, scene.position, {}, 0.0);
    can_close_by_walls_ = fraction > 0.0 && fraction < kClosed;  // a column fills them from the first
  }
  for (const RigidWall& wall : scene.rigid_walls) last_wall_speed_.push_back(wall.kind->start(scene, wall).speed);
  if (cells_.faces.count() > 0) {
    columns_ = divide_into_columns(scene, cells_.field.pitch);
    layer_size_ = size_of_layers(scene, cells_.field.pitch);
  }
}

void Sampler::measure_watched(const Scene& scene, const State& state, Sample& sample) {
  const double interval = state.time - last_time_;
  for (std::size_t k = 0; k < scene.watched.size(); ++k) {
    const int node = scene.watched[k];
    const Vector2 displacement = state.position[node] - scene.position[node];
    WatchedNode watched = {displacement.x(), displacement.y(), state.rotation[node]};
    if (!state.reaction_impulse.empty() && interval > 0.0) {
      const ReactionImpulse now = impulse_at(scene, state, node);
      const ReactionImpulse before = std::exchange(last_reaction_impulse_[k], now);
      watched.reaction_x = (now.x - before.x) / interval;
      watched.reaction_y = (now.y - before.y) / interval;
      watched.reaction_moment = (now.moment - before.moment) / interval;
    }
    sample.watched.push_back(watched);
  }
}

void Sampler::measure_rigid_walls(const Scene& scene, const State& state, Sample& sample) {
  const double interval = state.time - last_time_;
  for (std::size_t wall = 0; wall < scene.rigid_walls.size(); ++wall) {
    const RigidWallMotion& motion = state.rigid_wall_motion[wall];
    const RigidWallTotals& now = state.rigid_wall_totals[wall];
    RigidWallSample of_wall = {
        .displacement = motion.travel, .speed = motion.speed, .impulse = now.normal, .work = now.work};
    if (interval > 0.0) {
      const RigidWallTotals before = std::exchange(last_wall_totals_[wall], now);
      of_wall.acceleration = (motion.speed - std::exchange(last_wall_speed_[wall], motion.speed)) / interval;
      of_wall.normal_force = (now.normal - before.normal) / interval;
      of_wall.tangential_force = (now.tangential - before.tangential) / interval;
    }
    sample.rigid_walls.push_back(of_wall);
  }
}

void Sampler::measure_grips(const Scene& scene, const State& state, Sample& sample) {
  const double interval = state.time - last_time_;
  for (std::size_t g = 0; g < scene.grips.size(); ++g) {
    const Grip& grip = scene.grips[g];
    const Vector2 travel = displacement_of(scene, state, grip);
    GripSample of_grip = {travel.x(), travel.y(), 0.0, 0.0};
    if (interval > 0.0) {
      const Vector2 now = impulse_of(scene, state, grip);
      const Vector2 force = (now - std::exchange(last_grip_impulse_[g], now)) / interval;
      of_grip.force_x = force.x();
      of_grip.force_y = force.y();
    }
    sample.grips.push_back(of_grip);
  }
}

void Sampler::measure_stress(const Scene& scene, const State& state, Sample& sample) {
  const double area_times_interval = scene.width * scene.depth * (state.time - last_time_);
  const double impact_impulse = impact_impulse_of(scene, state);
  const double support_impulse = support_impulse_of(scene, state);
  if (area_times_interval > 0.0) {
    sample.stress_impact = (impact_impulse - last_impact_impulse_) / area_times_interval;
    sample.stress_support = (support_impulse - last_support_impulse_) / area_times_interval;
  }
  last_impact_impulse_ = impact_impulse;
  last_support_impulse_ = support_impulse;
}

/// The curve is that of the mean of both plates, or of the impact plate without a support, smoothed over the last
/// Summary::kPeakWindow of strain, or over all of it before the first window is complete.
void Sampler::measure_efficiency(const Scene& scene, Sample& sample) {
  const double stress =
      has_support(scene) ? 0.5 * (sample.stress_impact + sample.stress_support) : sample.stress_impact;
  const Absorbed& before = absorbed_.back();
  const Absorbed now = {sample.strain, before.energy + stress * (sample.strain - before.strain)};
  absorbed_.push_back(now);
  const double begin = std::max(0.0, now.strain - Summary::kPeakWindow);
  while (absorbed_.size() > 2 && absorbed_[1].strain <= begin) absorbed_.erase(absorbed_.begin());
  const double interval = absorbed_[1].strain - absorbed_[0].strain;
  if (!(interval > 0.0)) return;
  const double part = (begin - absorbed_[0].strain) / interval;
  const double in_window = now.energy - std::lerp(absorbed_[0].energy, absorbed_[1].energy, part);
  if (in_window > 0.0) sample.absorption_efficiency = now.energy / in_window * (now.strain - begin);
}

void Sampler::measure_closing(const Scene& scene, const State& state, Sample& sample) {
  bool is_closed = false;
  if (scene.plates.present) {
    sample.solid_fraction = solid_fraction_at(scene, sample.strain);
    is_closed = is_past_closing(scene, sample.strain);
  } else if (can_close_by_walls_) {
    sample.solid_fraction = solid_fraction_by_walls(scene, state.position, state.rigid_wall_motion, sample.strain);
    is_closed = sample.solid_fraction > kClosed;
  }
  if (is_closed && !has_warned_of_closing_) {
    sample.warnings.push_back(warn_of_closing(scene, state, sample.strain));
    has_warned_of_closing_ = true;
  }
}

void Sampler::measure_collapse(const Run& run, Sample& sample) {
  if (cells_.faces.count() == 0) {
    return;
  }
  std::vector<Vector2> room;
  const CollapseField field = find_collapse(cells_, places_of_cells(run.unbroken, run.joined, room));
  sample.collapsed_fraction = collapsed_fraction_of(field);
  if (sample.collapsed_fraction >= next_check_ && next_check_ <= kModeTo) {
    sample.crush_mode = find_crush_mode(field);
    next_check_ = sample.collapsed_fraction + kCheckEvery;
  }
  if (run.scene.plates.present) sample.front = find_front(columns_, run.unbroken, run.joined);
  if (sample.strain >= next_layer_strain_ && all_finite(run.state.position)) {
    densest_layer_ = find_densest_layer(run.scene, run.state, layer_size_);
    next_layer_strain_ = sample.strain + kLayerEvery;
  }
  sample.densest_layer = densest_layer_;
}

void Sampler::find_warnings(const Scene& scene, const State& state, Sample& sample) {
  if (!has_warned_of_depth_ && state.contact_totals.deepest_penetration > kDeepPenetration) {
    sample.warnings.push_back(warn_of_depth(scene, state, sample.strain));
    has_warned_of_depth_ = true;
  }
  if (!has_warned_of_search_ && has_left_faces(scene, state) && state.crossing_step < 0) {
    sample.warnings.push_back(warn_of_borders(state, sample.strain));
    has_warned_of_search_ = true;
  }
  if (!has_warned_of_density_ && sample.densest_layer.solid_fraction > kSolid) {
    sample.warnings.push_back(warn_of_density(state, sample));
    has_warned_of_density_ = true;
  }
  if (has_warned_of_necks_ || scene.can_break()) {
    return;
  }
  if (const std::optional<Warning> necks = warn_of_necks(scene, state, sample.strain)) {
    sample.warnings.push_back(*necks);
    has_warned_of_necks_ = true;
  }
}

void Sampler::list_breaks(const State& state, Sample& sample) {
  sample.break_count = static_cast<std::int64_t>(state.breaks.size());
  sample.breaks.assign(state.breaks.begin() + break_count_, state.breaks.end());
  break_count_ = sample.break_count;
}

/// What follows from the state without a look at every fibre.
void Sampler::measure_lattice(const Run& run, Sample& sample) {
  const Scene& scene = run.scene;
  const State& state = run.state;
  sample.step = state.step;
  sample.time = state.time;
  sample.travel = crush_travel_of(scene, state);
  if (is_crushed(scene)) {
    sample.strain = crush_strain_of(scene, state);
    measure_stress(scene, state, sample);
    measure_efficiency(scene, sample);
    sample.lateral_strain = state.sides.empty() ? lateral_strain_of(side_pairs_, run.unbroken, run.joined)
                                                : state.sides.front().width / scene.period.length - 1.0;
    measure_collapse(run, sample);
  }
  measure_closing(scene, state, sample);
  sample.energy_contact_stored = state.contact_totals.stored;
  sample.deepest_penetration = state.contact_totals.deepest_penetration;
  sample.contact_count = state.contact_totals.count;
  list_breaks(state, sample);
  find_warnings(scene, state, sample);
  measure_watched(scene, state, sample);
  measure_rigid_walls(scene, state, sample);
  measure_grips(scene, state, sample);
  last_time_ = state.time;
}

Sample Sampler::take(const Run& run, Workers& workers) {
  const Scene& scene = run.scene;
  const std::vector<WallBlock>& blocks = scene.walls.blocks;
  EnergyPieces energies(scene, run.state);
  std::vector<WallStrain> strains(sampled_pieces(blocks.size()));
  const auto look_at = [&](std::size_t piece) {
    if (piece < strains.size()) {
      strains[piece] = find_largest_fibre_strain(scene, run.state, sampled_piece(blocks, piece));
    } else {
      energies.evaluate(piece - strains.size());
    }
  };
  Sample sample;
  workers.parallel_overlap(strains.size() + energies.count(), look_at, [&] { measure_lattice(run, sample); });
  sample.energies = energies.total();
  WallStrain largest;
  for (const WallStrain& of_piece : strains) {
    if (of_piece.strain > largest.strain) largest = of_piece;
  }
  sample.largest_fibre_strain = largest.strain;
  sample.most_strained_wall = scene.list_order.listed_wall(largest.wall);
  return sample;
}

void Sampler::make_frame(const Run& run, int index, FieldFrame& frame) const {
  const Scene& scene = run.scene;
  const State& state = run.state;
  const auto put_place = [](const Vector2& place, std::size_t i, std::vector<float>& places) {
    places[2 * i] = static_cast<float>(place.x());
    places[2 * i + 1] = static_cast<float>(place.y());
  };
  frame.index = index;
  frame.time = state.time;
  frame.strain = crush_strain_of(scene, state);
  frame.position.resize(2 * run.unbroken.particle_count());
  for (std::size_t i = 0; i < run.unbroken.particle_count(); ++i) put_place(run.joined.position[i], i, frame.position);
  frame.broken_end.clear();
  frame.end_position.resize(2 * state.breaks.size());
  for (std::size_t k = 0; k < state.breaks.size(); ++k) {
    frame.broken_end.push_back(2 * state.breaks[k].element + state.breaks[k].at_end);
    put_place(state.position[scene.joint_count - state.breaks.size() + k], k, frame.end_position);
  }
  const FlowedShare yielded(scene.section);
  frame.plastic_fraction.resize(scene.element_count());
  visit_elements(scene, [&](const ElementPlace& place, int) {
    frame.plastic_fraction[place.element] = static_cast<float>(
        scene.single_fibres ? yielded.of(state.single_fibres, place) : yielded.of(state.fibres, place));
  });
  evaluate_fibre_strains(scene, state, frame.fibre_strain);
  std::vector<Vector2> room;
  local_strain_.evaluate(places_of_cells(run.unbroken, run.joined, room), frame.local_strain);
}

}  // namespace cellcrush
