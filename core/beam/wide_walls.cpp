#include "beam/wide_walls.h"

#include "beam/beam_element.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beam/wide_walls.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/wall_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

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

/// Materials of the walls from `wall` on.
template <class D>
HWY_INLINE LaneMaterial<D> material_of(D d, const Scene& scene, int wall) {
  if (scene.materials.size() == 1) {
    const Material& material = scene.materials.front();
    return complete(d, hn::Set(d, material.youngs_modulus), hn::Set(d, material.yield_stress),
                    hn::Set(d, material.hardening_modulus), hn::Set(d, material.isotropic_fraction));
  }
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

/// A step of the walls in some lanes of a block, from their starts to their ends.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class D>
class WallChain {
  using V = hn::Vec<D>;

 public:
  WallChain(const Scene& scene, State& state, double step, const WallBlock& block, int lane)
      : scene_(scene),
        state_(state),
        step_(step),
        block_(block),
        lane_(lane),
        wall_(block.first_wall + lane),
        thickness_(hn::LoadU(d_, &scene.walls.thickness[wall_])),
        undeformed_(hn::LoadU(d_, &scene.walls.undeformed_length[wall_])),
        material_(material_of(d_, scene, wall_)) {}

  /// Adds the plastic work to that of the lanes.
  HWY_INLINE void advance(double* HWY_RESTRICT plastic_work) {
    V work = hn::LoadU(d_, plastic_work + lane_);
    LaneNode<D> start = gather_joint(scene_.walls.start);
    const V zero = hn::Zero(d_);
    LaneForces<D> before = {{zero, zero}, zero, zero};
    const std::size_t ends = 2 * static_cast<std::size_t>(block_.first_wall) + lane_;
    for (int j = 0; j < block_.elements; ++j) {
      const int inner = block_.first_inner + j * block_.walls + lane_;
      const bool is_last = j + 1 == block_.elements;
      const LaneNode<D> end = is_last ? gather_joint(scene_.walls.end) : load_inner(inner);
      const LaneForces<D> forces = evaluate(block_.first_element + j * block_.walls, start, end, work);
      if (j == 0) {
        put_on_joints(ends, forces.force_on_end, hn::Neg(forces.moment_on_start));
      } else {
        const Points<D> net = {hn::Sub(forces.force_on_end.x, before.force_on_end.x),
                               hn::Sub(forces.force_on_end.y, before.force_on_end.y)};
        const std::size_t particle = inner - block_.walls;
        store_points(d_, net, &state_.internal_force[particle]);
        hn::StoreU(hn::Neg(hn::Add(before.moment_on_end, forces.moment_on_start)), d_,
                   &state_.internal_moment[particle]);
      }
      before = forces;
      start = end;
    }
    put_on_joints(ends + block_.walls, {hn::Neg(before.force_on_end.x), hn::Neg(before.force_on_end.y)},
                  hn::Neg(before.moment_on_end));
    hn::StoreU(work, d_, plastic_work + lane_);
  }

 private:
  HWY_INLINE LaneNode<D> gather_joint(const std::vector<int>& joints) const {
    const auto indices = load_indices(d_, &joints[wall_]);
    return {gather_points(d_, state_.position.data(), indices),
            hn::Mul(hn::Set(d_, step_), hn::GatherIndex(d_, state_.spin.data(), indices))};
  }

  HWY_INLINE LaneNode<D> load_inner(int particle) const {
    return {load_points(d_, &state_.position[particle]),
            hn::Mul(hn::Set(d_, step_), hn::LoadU(d_, &state_.spin[particle]))};
  }

  HWY_INLINE void put_on_joints(std::size_t end, const Points<D>& force, V moment) const {
    store_points(d_, force, &state_.wall_force[end]);
    hn::StoreU(moment, d_, &state_.wall_moment[end]);
  }

  HWY_INLINE Fibres fibres_of(int row) const {
    const std::size_t first = row * scene_.fibre_count() + lane_;
    return {&state_.stress[first], kHardening ? &state_.back_stress[first] : nullptr,
            kHardening ? &state_.plastic_strain[first] : nullptr, kHardening ? nullptr : &state_.flowed[row + lane_],
            static_cast<std::size_t>(block_.walls)};
  }

  HWY_INLINE SectionMemory memory_of(int row) const {
    const std::size_t first = row * scene_.section.section_count() + lane_;
    return {&state_.section_unbalance[first], &state_.section_tangent[first], static_cast<std::size_t>(block_.walls)};
  }

  /// See evaluate_element. `row` is the first element of the block's row.
  HWY_INLINE LaneForces<D> evaluate(int row, const LaneNode<D>& start, const LaneNode<D>& end, V& work) {
    const SectionRule& rule = scene_.section;
    const int e = row + lane_;
    const V previous_length = hn::LoadU(d_, &state_.length[e]);
    const LaneDeformation<D> deformation =
        reverse_motion(d_, start.position, end.position, load_points(d_, &state_.axis[e]), previous_length,
                       hn::LoadU(d_, &state_.inverse_length[e]), start.turn, end.turn);
    store_points(d_, deformation.axis, &state_.axis[e]);
    hn::StoreU(deformation.length, d_, &state_.length[e]);
    hn::StoreU(deformation.inverse_length, d_, &state_.inverse_length[e]);
    const LaneSection<D> section = section_of(d_, scene_, undeformed_, thickness_, deformation);
    LaneMaterial<D> material = material_;
    bound_stiffness(d_, deformation.length, undeformed_, thickness_, scene_.constant_area, material);
    const V membrane = hn::Mul(deformation.stretch, deformation.inverse_mean);
    const V slenderness = hn::Mul(thickness_, deformation.inverse_mean);
    const V bend_start = hn::Mul(slenderness, deformation.rotation_start);
    const V bend_end = hn::Mul(slenderness, deformation.rotation_end);
    const V unit = hn::Mul(section.area, thickness_);
    const Fibres fibres = fibres_of(row);
    LaneSums<kSections, D> sums;
    if constexpr (kForceBased) {
      const LaneMoments<D> before = {hn::Div(hn::LoadU(d_, &state_.start_moment[e]), unit),
                                     hn::Div(hn::LoadU(d_, &state_.end_moment[e]), unit)};
      V stress[kSections * kDepthPoints];
      V plastic_increment[kSections * kDepthPoints];
      KeptStep<D> next = {stress, plastic_increment};
      sums = return_balanced<kSections, kDepthPoints, kHardening>(d_, material, rule, membrane, bend_start, bend_end,
                                                                  before, fibres, next, memory_of(row));
      commit_fibres<kHardening>(material, kSections * kDepthPoints, next, fibres);
    } else {
      V curvature[kSections];
      straight_curvatures<kSections>(d_, rule, bend_start, bend_end, curvature);
      CommittedStep<kHardening, D> next(material, fibres);
      sums = return_element<kSections, kDepthPoints, kHardening>(d_, material, rule, membrane, curvature, fibres, next);
      next.finish();
    }
    work = hn::MulAdd(section.volume, sums.plastic_work, work);
    const V moment_start = hn::Mul(unit, sums.moments.start);
    const V moment_end = hn::Mul(unit, sums.moments.end);
    if constexpr (kForceBased) {
      hn::StoreU(moment_start, d_, &state_.start_moment[e]);
      hn::StoreU(moment_end, d_, &state_.end_moment[e]);
    }
    const V shear = hn::Mul(hn::Neg(hn::Add(moment_start, moment_end)), deformation.inverse_length);  // Eq. 31
    const V axial = hn::Mul(section.area, sums.axial);
    const Points<D>& axis = deformation.axis;
    return {{hn::MulSub(axial, axis.x, hn::Mul(shear, axis.y)), hn::MulAdd(axial, axis.y, hn::Mul(shear, axis.x))},
            moment_start,
            moment_end};
  }

  static constexpr D d_{};
  const Scene& scene_;
  State& state_;
  const double step_;
  const WallBlock& block_;
  const int lane_;
  const int wall_;
  const V thickness_;
  const V undeformed_;
  const LaneMaterial<D> material_;
};

/// Full blocks go through the target's vectors, others wall by wall.
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening>
void evaluate_blocks(const Scene& scene, State& state) {
  using Wide = hn::CappedTag<double, kMostWallsInBlock>;
  using One = hn::CappedTag<double, 1>;
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  double plastic_work[kMostWallsInBlock] = {};
  for (const WallBlock& block : scene.walls.blocks) {
    if (block.walls == kMostWallsInBlock) {
      for (int lane = 0; lane < kMostWallsInBlock; lane += static_cast<int>(hn::MaxLanes(Wide()))) {
        WallChain<kSections, kDepthPoints, kForceBased, kHardening, Wide>(scene, state, step, block, lane)
            .advance(plastic_work);
      }
    } else {
      for (int lane = 0; lane < block.walls; ++lane) {
        WallChain<kSections, kDepthPoints, kForceBased, kHardening, One>(scene, state, step, block, lane)
            .advance(plastic_work);
      }
    }
  }
  for (const double work : plastic_work) {
    state.ledger.plastic += work;
  }
}

template <int kSections, int kDepthPoints, bool kForceBased>
void evaluate_rule(const Scene& scene, State& state) {
  if (scene.has_hardening()) {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, true>(scene, state);
  } else {
    evaluate_blocks<kSections, kDepthPoints, kForceBased, false>(scene, state);
  }
}

bool evaluate_wide(const Scene& scene, State& state) {
  const SectionRule& rule = scene.section;
  const auto is = [&](bool force_based, std::size_t sections, std::size_t depth) HWY_ATTR {
    return rule.force_based == force_based && rule.section_count() == sections && rule.depth_count() == depth;
  };
  if (is(true, 4, 6)) {
    evaluate_rule<4, 6, true>(scene, state);
  } else if (is(false, 2, 6)) {
    evaluate_rule<2, 6, false>(scene, state);
  } else {
    return false;
  }
  return true;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_wide);

bool evaluate_walls_wide(const Scene& scene, State& state) { return HWY_DYNAMIC_DISPATCH(evaluate_wide)(scene, state); }

}  // namespace cellcrush
#endif
