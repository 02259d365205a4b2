// Included once for each target.
#if defined(CELLCRUSH_BEAM_WALL_CHUNK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#undef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#else
#define CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <span>

#include "beam/wall_lanes-inl.h"
#include "beam/walls_workspace.h"
#include "cellcrush/state.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Materials of the lanes; `modulus` and `hardening` are E and H.
template <class D>
HWY_INLINE LaneMaterial<D> complete(D d, hn::Vec<D> modulus, hn::Vec<D> yield, hn::Vec<D> hardening,
                                    hn::Vec<D> isotropic) {
  using T = hn::TFromD<D>;
  return {modulus,
          yield,
          hn::Div(hn::Set(d, T(1.0)), hn::Add(modulus, hardening)),
          hn::Mul(isotropic, hardening),
          hn::Mul(hn::Sub(hn::Set(d, T(1.0)), isotropic), hardening),
          hardening,
          hn::Div(hn::Set(d, T(12.0)), modulus)};
}

/// One material in all lanes.
template <class D>
HWY_INLINE LaneMaterial<D> uniform_material(D d, const Material& material) {
  const auto set = [&](double value) HWY_ATTR { return hn::Set(d, static_cast<hn::TFromD<D>>(value)); };
  return complete(d, set(material.youngs_modulus), set(material.yield_stress), set(material.hardening_modulus),
                  set(material.isotropic_fraction));
}

/// Materials of the walls from `wall` on.
template <class D>
HWY_INLINE LaneMaterial<D> material_of(D d, const Scene& scene, int wall) {
  using T = hn::TFromD<D>;
  T values[4][kMostWallsInBlock];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const Material& material = scene.materials[scene.walls.material[wall + lane]];
    values[0][lane] = static_cast<T>(material.youngs_modulus);
    values[1][lane] = static_cast<T>(material.yield_stress);
    values[2][lane] = static_cast<T>(material.hardening_modulus);
    values[3][lane] = static_cast<T>(material.isotropic_fraction);
  }
  return complete(d, hn::LoadU(d, values[0]), hn::LoadU(d, values[1]), hn::LoadU(d, values[2]),
                  hn::LoadU(d, values[3]));
}

/// The material with a share of its modulus.
template <class D>
HWY_INLINE LaneMaterial<D> with_stiffness(D d, const LaneMaterial<D>& material, hn::Vec<D> share) {
  using T = hn::TFromD<D>;
  LaneMaterial<D> softer = material;
  softer.modulus = hn::Mul(material.modulus, share);
  softer.inverse = hn::Div(hn::Set(d, T(1.0)), hn::Add(softer.modulus, material.hardening));
  softer.bending_flexibility = hn::Div(hn::Set(d, T(12.0)), softer.modulus);
  return softer;
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

/// Kinds of what passes between the three loops over a chunk's elements, in the fibres' precision. Row by row: the values of
/// a kind lie side by side, and a row's kinds one after the other. What the stresses sum up to takes the places of the strains.
enum class Passed { membrane, bend_start, bend_end, stiffness };
constexpr Passed kAxial = Passed::membrane;
constexpr Passed kMomentStart = Passed::bend_start;
constexpr Passed kMomentEnd = Passed::bend_end;
constexpr Passed kPlasticWork = Passed::stiffness;

/// More fibres than this do not stay in the third cache from step to step, and are brought from memory some rows ahead: with
/// 16 times the cells of Type I the walls take a third less. Of fewer it costs 0.15 ns an element-step.
constexpr std::size_t kCachedFibres = 1'000'000;

/// A step of some neighbouring blocks' walls. Three short loops, over geometry, fibres and forces: the processor works at
/// several elements at a time, where each by itself is a long chain of operations, and the fibres may be in single precision
/// (lanes F) where motion and forces are in double (lanes D).
template <int kSections, int kDepthPoints, bool kForceBased, bool kHardening, class D, class F>
class WallChunk {
  using V = hn::Vec<D>;
  using T = hn::TFromD<F>;
  using VF = hn::Vec<F>;

  static constexpr std::ptrdiff_t kFibres = kSections * kDepthPoints;

 public:
  /// `passed` has room for kPassedKinds values of each of the blocks' elements.
  WallChunk(const Scene& scene, State& state, FibreMemory<T>& memory, double step,
            const RuleFactors<kSections, kDepthPoints, T>& rule, std::span<const WallBlock> blocks, T* passed)
      : scene_(scene),
        memory_(memory),
        step_(step),
        rule_(rule),
        blocks_(blocks),
        position_(state.position.data()),
        spin_(state.spin.data()),
        axis_(state.axis.data()),
        length_(state.length.data()),
        inverse_length_(state.inverse_length.data()),
        wall_force_(state.wall_force.data()),
        wall_moment_(state.wall_moment.data()),
        internal_force_(state.internal_force.data()),
        internal_moment_(state.internal_moment.data()),
        stress_(memory.stress.data()),
        passed_(passed),
        first_(blocks.front().first_element),
        fetches_fibres_(memory.stress.size() > kCachedFibres),
        uniform_(uniform_material(f_, scene.materials.front())) {}

  /// The first loop: axes, lengths and strains. Returns whether some elements have a stiffness of their own.
  HWY_INLINE bool measure() {
    visit_lanes(d_, [&](const WallBlock& block, int lane) HWY_ATTR { reverse_motions(block, lane); });
    return is_squashed_;
  }

  /// The others: stresses and forces, by what the first has returned. Adds the plastic work to that of the lanes.
  HWY_INLINE void respond(bool is_squashed, double* HWY_RESTRICT plastic_work) {
    is_squashed_ = is_squashed;
    visit_lanes(f_, [&](const WallBlock& block, int lane) HWY_ATTR { return_fibres(block, lane); });
    visit_lanes(d_, [&](const WallBlock& block, int lane) HWY_ATTR { put_forces(block, lane, plastic_work + lane); });
  }

 private:
  /// Calls visit(block, lane) for every lot of walls that fills the lanes.
  template <class Lanes, class Visit>
  HWY_INLINE void visit_lanes(Lanes lanes, Visit&& visit) const {
    for (const WallBlock& block : blocks_) {
      for (int lane = 0; lane < walls_of(block); lane += static_cast<int>(hn::MaxLanes(lanes))) {
        visit(block, lane);
      }
    }
  }

  /// Walls of a block, which are the elements of a row: a constant where they fill vectors, so that what lies side by side
  /// has addresses that are known.
  HWY_INLINE static int walls_of(const WallBlock& block) {
    return hn::MaxLanes(D()) == 1 ? block.walls : kMostWallsInBlock;
  }

  HWY_INLINE static std::ptrdiff_t row_of(const WallBlock& block, int j) {
    return block.first_element + static_cast<std::ptrdiff_t>(j) * walls_of(block);
  }

  /// Values of the lanes' elements of a row.
  HWY_INLINE T* values_of(Passed kind, std::ptrdiff_t row, int lane, int walls) const {
    return passed_ + static_cast<std::ptrdiff_t>(kPassedKinds) * (row - first_) + static_cast<int>(kind) * walls + lane;
  }

  HWY_INLINE LaneNode<D> gather_joint(const int* joints) const {
    return {gather_points(d_, position_, joints), hn::Mul(hn::Set(d_, step_), gather_numbers(d_, spin_, joints))};
  }

  HWY_INLINE LaneNode<D> load_inner(std::ptrdiff_t particle) const {
    return {load_points(d_, position_ + particle), hn::Mul(hn::Set(d_, step_), hn::LoadU(d_, spin_ + particle))};
  }

  /// From the motion of the ends to the strains of the step; see evaluate_element.
  HWY_INLINE void reverse_motions(const WallBlock& block, int lane) {
    const int wall = block.first_wall + lane;
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    const V undeformed = hn::LoadU(d_, &scene_.walls.undeformed_length[wall]);
    LaneNode<D> start = gather_joint(&scene_.walls.start[wall]);
    for (int j = 0; j < block.elements; ++j) {
      const std::ptrdiff_t row = row_of(block, j);
      const std::ptrdiff_t e = row + lane;
      const LaneNode<D> end =
          j + 1 == block.elements
              ? gather_joint(&scene_.walls.end[wall])
              : load_inner(block.first_inner + static_cast<std::ptrdiff_t>(j) * walls_of(block) + lane);
      const LaneDeformation<D> deformation =
          reverse_motion(d_, start.position, end.position, load_points(d_, axis_ + e), hn::LoadU(d_, length_ + e),
                         hn::LoadU(d_, inverse_length_ + e), start.turn, end.turn);
      store_points(d_, deformation.axis, axis_ + e);
      hn::StoreU(deformation.length, d_, length_ + e);
      hn::StoreU(deformation.inverse_length, d_, inverse_length_ + e);
      const V slenderness = hn::Mul(thickness, deformation.inverse_mean);
      store_as(d_, hn::Mul(deformation.stretch, deformation.inverse_mean),
               values_of(Passed::membrane, row, lane, walls_of(block)));
      store_as(d_, hn::Mul(slenderness, deformation.rotation_start),
               values_of(Passed::bend_start, row, lane, walls_of(block)));
      store_as(d_, hn::Mul(slenderness, deformation.rotation_end),
               values_of(Passed::bend_end, row, lane, walls_of(block)));
      if (HWY_UNLIKELY(!hn::AllFalse(d_, is_short(d_, deformation.length, undeformed)))) {
        note_stiffness(values_of(Passed::stiffness, row, lane, walls_of(block)),
                       bounded_stiffness(d_, deformation.length, undeformed, thickness, scene_.constant_area));
      }
      start = end;
    }
  }

  /// Few chunks have squashed elements: the others' values are never filled.
  HWY_INLINE void note_stiffness(T* place, V stiffness) {
    if (!is_squashed_) {
      for (const WallBlock& block : blocks_) {
        for (int j = 0; j < block.elements; ++j) {
          std::fill_n(values_of(Passed::stiffness, row_of(block, j), 0, walls_of(block)), walls_of(block), T(1.0));
        }
      }
      is_squashed_ = true;
    }
    store_as(d_, stiffness, place);
  }

  HWY_INLINE Fibres<T> fibres_of(std::ptrdiff_t row, int lane, int stride) const {
    const std::ptrdiff_t first = row * kFibres + lane;
    return {stress_ + first, kHardening ? &memory_.back_stress[first] : nullptr,
            kHardening ? &memory_.plastic_strain[first] : nullptr, kHardening ? nullptr : &memory_.flowed[row + lane],
            static_cast<std::size_t>(stride)};
  }

  HWY_INLINE SectionMemory<T> sections_of(std::ptrdiff_t row, int lane, int stride) const {
    const std::ptrdiff_t first = row * kSections + lane;
    return {&memory_.section_unbalance[first], &memory_.section_flexibility[first], static_cast<std::size_t>(stride)};
  }

  /// Moments on the nodes of the lanes' elements of a row, over b h^2.
  HWY_INLINE T* moment_start(std::ptrdiff_t row, int lane, int walls) const {
    return kForceBased ? &memory_.start_moment[row + lane] : values_of(kMomentStart, row, lane, walls);
  }
  HWY_INLINE T* moment_end(std::ptrdiff_t row, int lane, int walls) const {
    return kForceBased ? &memory_.end_moment[row + lane] : values_of(kMomentEnd, row, lane, walls);
  }

  /// Has the lanes' share of the stresses some rows ahead brought near.
  HWY_INLINE void fetch_fibres(std::ptrdiff_t row, int lane, int walls) const {
    constexpr std::ptrdiff_t kRowsAhead = 8;
    constexpr std::size_t kLine = 64 / sizeof(T);
    constexpr std::size_t kCount = kFibres * hn::MaxLanes(F());
    const T* const from = stress_ + (row + kRowsAhead * walls + lane) * kFibres;
    for (std::size_t i = 0; i < kCount; i += kLine) {
      __builtin_prefetch(from + i, 1);
    }
  }

  /// From the strains to the sums of the stresses.
  HWY_INLINE void return_fibres(const WallBlock& block, int lane) const {
    const LaneMaterial<F> of_wall =
        scene_.materials.size() == 1 ? uniform_ : material_of(f_, scene_, block.first_wall + lane);
    const int walls = walls_of(block);
    for (int j = 0; j < block.elements; ++j) {
      const std::ptrdiff_t row = row_of(block, j);
      if (fetches_fibres_) {
        fetch_fibres(row, lane, walls);
      }
      const auto value = [&](Passed kind) HWY_ATTR { return values_of(kind, row, lane, walls); };
      const LaneMaterial<F> material =
          is_squashed_ ? with_stiffness(f_, of_wall, hn::LoadU(f_, value(Passed::stiffness))) : of_wall;
      const VF membrane = hn::LoadU(f_, value(Passed::membrane));
      const VF bend_start = hn::LoadU(f_, value(Passed::bend_start));
      const VF bend_end = hn::LoadU(f_, value(Passed::bend_end));
      const Fibres<T> fibres = fibres_of(row, lane, walls);
      T* const at_start = moment_start(row, lane, walls);
      T* const at_end = moment_end(row, lane, walls);
      LaneSums<kSections, F> sums;
      if constexpr (kForceBased) {
        const LaneMoments<F> before = {hn::LoadU(f_, at_start), hn::LoadU(f_, at_end)};
        sums = return_balanced<kHardening>(f_, material, rule_, membrane, bend_start, bend_end, before, fibres,
                                           sections_of(row, lane, walls));
      } else {
        VF curvature[kSections];
        straight_curvatures(f_, rule_, bend_start, bend_end, curvature);
        sums = return_element<kHardening>(f_, material, rule_, membrane, curvature, fibres, fibres);
      }
      hn::StoreU(sums.axial, f_, value(kAxial));
      hn::StoreU(sums.moments.start, f_, at_start);
      hn::StoreU(sums.moments.end, f_, at_end);
      hn::StoreU(sums.plastic_work, f_, value(kPlasticWork));
    }
  }

  /// From the sums of the stresses to the forces on the particles.
  HWY_INLINE void put_forces(const WallBlock& block, int lane, double* HWY_RESTRICT plastic_work) const {
    const int wall = block.first_wall + lane;
    const V thickness = hn::LoadU(d_, &scene_.walls.thickness[wall]);
    const V undeformed = hn::LoadU(d_, &scene_.walls.undeformed_length[wall]);
    const std::size_t ends = 2 * static_cast<std::size_t>(block.first_wall) + lane;
    const V zero = hn::Zero(d_);
    LaneForces<D> before = {{zero, zero}, zero, zero};
    V work = hn::LoadU(d_, plastic_work);
    const int walls = walls_of(block);
    for (int j = 0; j < block.elements; ++j) {
      const std::ptrdiff_t row = row_of(block, j);
      const LaneForces<D> forces = forces_of(row, lane, walls, undeformed, thickness);
      work = hn::MulAdd(volume_of(d_, scene_, undeformed, thickness, hn::LoadU(d_, length_ + row + lane)),
                        load_as(d_, values_of(kPlasticWork, row, lane, walls)), work);
      if (j == 0) {
        put_on_joints(ends, forces.force_on_end, hn::Neg(forces.moment_on_start));
      } else {
        const Points<D> net = {hn::Sub(forces.force_on_end.x, before.force_on_end.x),
                               hn::Sub(forces.force_on_end.y, before.force_on_end.y)};
        const std::ptrdiff_t particle = block.first_inner + static_cast<std::ptrdiff_t>(j - 1) * walls + lane;
        store_points(d_, net, internal_force_ + particle);
        hn::StoreU(hn::Neg(hn::Add(before.moment_on_end, forces.moment_on_start)), d_, internal_moment_ + particle);
      }
      before = forces;
    }
    put_on_joints(ends + walls, {hn::Neg(before.force_on_end.x), hn::Neg(before.force_on_end.y)},
                  hn::Neg(before.moment_on_end));
    hn::StoreU(work, d_, plastic_work);
  }

  HWY_INLINE LaneForces<D> forces_of(std::ptrdiff_t row, int lane, int walls, V undeformed, V thickness) const {
    const V inverse_length = hn::LoadU(d_, inverse_length_ + row + lane);
    const V area = area_of(d_, scene_, undeformed, thickness, inverse_length);
    const V unit = hn::Mul(area, thickness);
    const V on_start = hn::Mul(unit, load_as(d_, moment_start(row, lane, walls)));
    const V on_end = hn::Mul(unit, load_as(d_, moment_end(row, lane, walls)));
    const V shear = hn::Mul(hn::Neg(hn::Add(on_start, on_end)), inverse_length);  // Eq. 31
    const V axial = hn::Mul(area, load_as(d_, values_of(kAxial, row, lane, walls)));
    const Points<D> axis = load_points(d_, axis_ + row + lane);
    return {{hn::MulSub(axial, axis.x, hn::Mul(shear, axis.y)), hn::MulAdd(axial, axis.y, hn::Mul(shear, axis.x))},
            on_start,
            on_end};
  }

  HWY_INLINE void put_on_joints(std::size_t end, const Points<D>& force, V moment) const {
    store_points(d_, force, wall_force_ + end);
    hn::StoreU(moment, d_, wall_moment_ + end);
  }

  static constexpr D d_{};
  static constexpr F f_{};
  const Scene& scene_;
  FibreMemory<T>& memory_;
  const double step_;
  const RuleFactors<kSections, kDepthPoints, T>& rule_;
  const std::span<const WallBlock> blocks_;

  // Pointers in place of the vectors, which would be asked anew where their numbers lie after every store of a number.
  const Vector2* const position_;
  const double* const spin_;
  Vector2* const axis_;
  double* const length_;
  double* const inverse_length_;
  Vector2* const wall_force_;
  double* const wall_moment_;
  Vector2* const internal_force_;
  double* const internal_moment_;
  T* const stress_;
  T* const passed_;

  const std::ptrdiff_t first_;
  const bool fetches_fibres_;
  const LaneMaterial<F> uniform_;
  bool is_squashed_ = false;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
