// Included once for each target.
#if defined(CELLCRUSH_BEAM_WALL_CHUNK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#undef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#else
#define CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#endif

#include <hwy/highway.h>

#include <span>

#include "beam/wall_lanes-inl.h"
#include "cellcrush/lane_vector.h"
#include "cellcrush/state.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Materials of the lanes from what a test of them gives.
template <class D>
HWY_INLINE LaneMaterial<D> complete(D d, hn::Vec<D> modulus, hn::Vec<D> yield, hn::Vec<D> hardening,
                                    hn::Vec<D> isotropic) {
  return {modulus,
          yield,
          hn::Div(hn::Set(d, 1.0), hn::Add(modulus, hardening)),
          hn::Mul(isotropic, hardening),
          hn::Mul(hn::Sub(hn::Set(d, 1.0), isotropic), hardening),
          hardening};
}

/// One material in all lanes.
template <class D>
HWY_INLINE LaneMaterial<D> uniform_material(D d, const Material& material) {
  return complete(d, hn::Set(d, material.youngs_modulus), hn::Set(d, material.yield_stress),
                  hn::Set(d, material.hardening_modulus), hn::Set(d, material.isotropic_fraction));
}

/// Materials of the walls from `wall` on.
template <class D>
HWY_INLINE LaneMaterial<D> material_of(D d, const Scene& scene, int wall) {
  double values[4][kMostWallsInBlock];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const Material& material = scene.materials[scene.walls.material[wall + lane]];
    values[0][lane] = material.youngs_modulus;
    values[1][lane] = material.yield_stress;
    values[2][lane] = material.hardening_modulus;
    values[3][lane] = material.isotropic_fraction;
  }
  return complete(d, hn::LoadU(d, values[0]), hn::LoadU(d, values[1]), hn::LoadU(d, values[2]),
                  hn::LoadU(d, values[3]));
}

/// Position and turn of the particles at one end of the lanes' elements.
template <class D>
struct LaneNode {
  Points<D> position;
  hn::Vec<D> turn;
};

/// What an element does to its ends; the force on the start is the reverse of that on the end.
template <class D>
struct LaneForces {
  Points<D> force_on_end;
  hn::Vec<D> moment_on_start;
  hn::Vec<D> moment_on_end;
};

/// What passes between the three loops over a chunk's elements, in the elements' order.
class ChunkValues {
 public:
  explicit ChunkValues(std::size_t elements) : elements_(elements), values_(6 * elements) {}

  double* membrane() { return values_.data(); }  ///< increment of the strain at the axis
  double* bend_start() { return membrane() + elements_; }
  double* bend_end() { return bend_start() + elements_; }  ///< rotations of the ends times h / l
  double* axial() { return bend_end() + elements_; }       ///< see ElementSums
  double* moment_start() { return axial() + elements_; }
  double* moment_end() { return moment_start() + elements_; }

 private:
  std::size_t elements_;
  LaneVector<double> values_;
};

/// A step of some neighbouring blocks' walls. Three short loops, over geometry, fibres and forces, are a quarter faster than
/// one: the processor works at several elements at a time, where each by itself is a long chain of operations.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class D>
class WallChunk {
  using V = hn::Vec<D>;

 public:
  WallChunk(const Scene& scene, State& state, double step, const RuleFactors<kSections, kDepthPoints>& rule,
            std::span<const WallBlock> blocks, ChunkValues& values)
      : scene_(scene),
        state_(state),
        step_(step),
        rule_(rule),
        blocks_(blocks),
        values_(values),
        first_(blocks.front().first_element),
        uniform_(uniform_material(d_, scene.materials.front())) {}

  /// Adds the plastic work to that of the lanes.
  HWY_INLINE void advance(double* HWY_RESTRICT plastic_work) {
    visit_lanes([&](const WallBlock& block, int lane) HWY_ATTR { reverse_motions(block, lane); });
    visit_lanes([&](const WallBlock& block, int lane) HWY_ATTR { return_fibres(block, lane, plastic_work + lane); });
    visit_lanes([&](const WallBlock& block, int lane) HWY_ATTR { put_forces(block, lane); });
  }

 private:
  /// Calls visit(block, lane) for every lot of walls that fills the lanes.
  template <class Visit>
  HWY_INLINE void visit_lanes(Visit&& visit) const {
    for (const WallBlock& block : blocks_) {
      for (int lane = 0; lane < block.walls; lane += static_cast<int>(hn::MaxLanes(d_))) {
        visit(block, lane);
      }
    }
  }

  HWY_INLINE LaneNode<D> gather_joint(const int* joints) const {
    const auto indices = load_indices(d_, joints);
    return {gather_points(d_, state_.position.data(), indices),
            hn::Mul(hn::Set(d_, step_), hn::GatherIndex(d_, state_.spin.data(), indices))};
  }

  HWY_INLINE LaneNode<D> load_inner(int particle) const {
    return {load_points(d_, &state_.position[particle]),
            hn::Mul(hn::Set(d_, step_), hn::LoadU(d_, &state_.spin[particle]))};
  }

  /// From the motion of the ends to the strains of the step; see evaluate_element.
  HWY_INLINE void reverse_motions(const WallBlock& block, int lane) const {
    const int wall = block.first_wall + lane;
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    LaneNode<D> start = gather_joint(&scene_.walls.start[wall]);
    for (int j = 0; j < block.elements; ++j) {
      const int e = block.first_element + j * block.walls + lane;
      const LaneNode<D> end = j + 1 == block.elements ? gather_joint(&scene_.walls.end[wall])
                                                      : load_inner(block.first_inner + j * block.walls + lane);
      const LaneDeformation<D> deformation = reverse_motion(
          d_, start.position, end.position, load_points(d_, &state_.axis[e]), hn::LoadU(d_, &state_.length[e]),
          hn::LoadU(d_, &state_.inverse_length[e]), start.turn, end.turn);
      store_points(d_, deformation.axis, &state_.axis[e]);
      hn::StoreU(deformation.length, d_, &state_.length[e]);
      hn::StoreU(deformation.inverse_length, d_, &state_.inverse_length[e]);
      const V slenderness = hn::Mul(thickness, deformation.inverse_mean);
      hn::StoreU(hn::Mul(deformation.stretch, deformation.inverse_mean), d_, values_.membrane() + (e - first_));
      hn::StoreU(hn::Mul(slenderness, deformation.rotation_start), d_, values_.bend_start() + (e - first_));
      hn::StoreU(hn::Mul(slenderness, deformation.rotation_end), d_, values_.bend_end() + (e - first_));
      start = end;
    }
  }

  HWY_INLINE Fibres fibres_of(int row, int lane, int stride) const {
    const std::size_t first = row * scene_.fibre_count() + lane;
    return {&state_.stress[first], kHardening ? &state_.back_stress[first] : nullptr,
            kHardening ? &state_.plastic_strain[first] : nullptr, kHardening ? nullptr : &state_.flowed[row + lane],
            static_cast<std::size_t>(stride)};
  }

  HWY_INLINE SectionMemory memory_of(int row, int lane, int stride) const {
    const std::size_t first = row * scene_.section.section_count() + lane;
    return {&state_.section_unbalance[first], &state_.section_tangent[first], static_cast<std::size_t>(stride)};
  }

  /// From the strains to the sums of the stresses.
  HWY_INLINE void return_fibres(const WallBlock& block, int lane, double* HWY_RESTRICT plastic_work) const {
    const int wall = block.first_wall + lane;
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    const V undeformed = hn::LoadU(d_, &scene_.walls.undeformed_length[wall]);
    const LaneMaterial<D> of_wall = scene_.materials.size() == 1 ? uniform_ : material_of(d_, scene_, wall);
    V work = hn::LoadU(d_, plastic_work);
    for (int j = 0; j < block.elements; ++j) {
      const int row = block.first_element + j * block.walls;
      const int e = row + lane;
      const V length = hn::LoadU(d_, &state_.length[e]);
      LaneMaterial<D> material = of_wall;
      bound_stiffness(d_, length, undeformed, thickness, scene_.constant_area, material);
      const V membrane = hn::LoadU(d_, values_.membrane() + (e - first_));
      const V bend_start = hn::LoadU(d_, values_.bend_start() + (e - first_));
      const V bend_end = hn::LoadU(d_, values_.bend_end() + (e - first_));
      const Fibres fibres = fibres_of(row, lane, block.walls);
      LaneSums<kSections, D> sums;
      if constexpr (kForceBased) {
        const V inverse_length = hn::LoadU(d_, &state_.inverse_length[e]);
        const V unit = hn::Mul(area_of(d_, scene_, undeformed, thickness, inverse_length), thickness);
        const LaneMoments<D> before = {hn::Div(hn::LoadU(d_, &state_.start_moment[e]), unit),
                                       hn::Div(hn::LoadU(d_, &state_.end_moment[e]), unit)};
        V stress[kSections * kDepthPoints];
        V plastic_increment[kSections * kDepthPoints];
        KeptStep<D> next = {stress, plastic_increment};
        sums = return_balanced<kHardening>(d_, material, rule_, membrane, bend_start, bend_end, before, fibres, next,
                                           memory_of(row, lane, block.walls));
        commit_fibres<kHardening>(material, kSections * kDepthPoints, next, fibres);
      } else {
        V curvature[kSections];
        straight_curvatures(d_, rule_, bend_start, bend_end, curvature);
        CommittedStep<kHardening, D> next(material, fibres);
        sums = return_element<kHardening>(d_, material, rule_, membrane, curvature, fibres, next);
        next.finish();
      }
      work = hn::MulAdd(volume_of(d_, scene_, undeformed, thickness, length), sums.plastic_work, work);
      hn::StoreU(sums.axial, d_, values_.axial() + (e - first_));
      hn::StoreU(sums.moments.start, d_, values_.moment_start() + (e - first_));
      hn::StoreU(sums.moments.end, d_, values_.moment_end() + (e - first_));
    }
    hn::StoreU(work, d_, plastic_work);
  }

  /// From the sums of the stresses to the forces on the particles.
  HWY_INLINE void put_forces(const WallBlock& block, int lane) const {
    const int wall = block.first_wall + lane;
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    const V undeformed = hn::LoadU(d_, &scene_.walls.undeformed_length[wall]);
    const std::size_t ends = 2 * static_cast<std::size_t>(block.first_wall) + lane;
    const V zero = hn::Zero(d_);
    LaneForces<D> before = {{zero, zero}, zero, zero};
    for (int j = 0; j < block.elements; ++j) {
      const int e = block.first_element + j * block.walls + lane;
      const LaneForces<D> forces = forces_of(e, undeformed, thickness);
      if (j == 0) {
        put_on_joints(ends, forces.force_on_end, hn::Neg(forces.moment_on_start));
      } else {
        const Points<D> net = {hn::Sub(forces.force_on_end.x, before.force_on_end.x),
                               hn::Sub(forces.force_on_end.y, before.force_on_end.y)};
        const std::size_t particle = block.first_inner + (j - 1) * block.walls + lane;
        store_points(d_, net, &state_.internal_force[particle]);
        hn::StoreU(hn::Neg(hn::Add(before.moment_on_end, forces.moment_on_start)), d_,
                   &state_.internal_moment[particle]);
      }
      before = forces;
    }
    put_on_joints(ends + block.walls, {hn::Neg(before.force_on_end.x), hn::Neg(before.force_on_end.y)},
                  hn::Neg(before.moment_on_end));
  }

  HWY_INLINE LaneForces<D> forces_of(int e, V undeformed, V thickness) const {
    const V inverse_length = hn::LoadU(d_, &state_.inverse_length[e]);
    const V area = area_of(d_, scene_, undeformed, thickness, inverse_length);
    const V unit = hn::Mul(area, thickness);
    const V moment_start = hn::Mul(unit, hn::LoadU(d_, values_.moment_start() + (e - first_)));
    const V moment_end = hn::Mul(unit, hn::LoadU(d_, values_.moment_end() + (e - first_)));
    if constexpr (kForceBased) {
      hn::StoreU(moment_start, d_, &state_.start_moment[e]);
      hn::StoreU(moment_end, d_, &state_.end_moment[e]);
    }
    const V shear = hn::Mul(hn::Neg(hn::Add(moment_start, moment_end)), inverse_length);  // Eq. 31
    const V axial = hn::Mul(area, hn::LoadU(d_, values_.axial() + (e - first_)));
    const Points<D> axis = load_points(d_, &state_.axis[e]);
    return {{hn::MulSub(axial, axis.x, hn::Mul(shear, axis.y)), hn::MulAdd(axial, axis.y, hn::Mul(shear, axis.x))},
            moment_start,
            moment_end};
  }

  HWY_INLINE void put_on_joints(std::size_t end, const Points<D>& force, V moment) const {
    store_points(d_, force, &state_.wall_force[end]);
    hn::StoreU(moment, d_, &state_.wall_moment[end]);
  }

  static constexpr D d_{};
  const Scene& scene_;
  State& state_;
  const double step_;
  const RuleFactors<kSections, kDepthPoints>& rule_;
  const std::span<const WallBlock> blocks_;
  ChunkValues& values_;
  const int first_;
  const LaneMaterial<D> uniform_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
