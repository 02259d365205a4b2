// Included once for each target.
#if defined(CELLCRUSH_BEAM_WALL_CHUNK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#undef CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#else
#define CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
#endif

#include <algorithm>
#include <cstddef>
#include <span>

#include "beam/cross_section-inl.h"
#include "beam/deformation-inl.h"
#include "beam/element_response-inl.h"
#include "beam/end_turns-inl.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Positions and rotation increments of the particles at one end of the elements of the lanes.
template <class D>
struct EndMotion {
  Points<D> position;
  Lane<D> turn;
};

/// Axial force and end moments of elements (Eq. 28, E7), N and N mm.
template <class D>
struct EndForces {
  Lane<D> axial;
  Lane<D> moment_on_start;
  Lane<D> moment_on_end;
};

/// Forces with which elements resist (Eq. 31, 32, E7), in the fixed frame: N and N mm. The force on the start node is
/// the opposite of that on the end node.
template <class D>
struct NodalForces {
  Points<D> force_on_end;
  Lane<D> moment_on_start;
  Lane<D> moment_on_end;
};

/// A step of the walls of some adjacent blocks (Eq. 7-32, E3 to E7), in three short loops over geometry, fibres and
/// forces. The processor then computes several elements at a time; one element by itself is a long chain of dependent
/// operations. Motion and forces are in double precision (lanes D), fibres in single or double precision (lanes F).
///
/// Deviations from the paper:
///  - strains are taken over the length without elastic strain, where Eq. 24-26 have l_a (E5, E5c). A closed loop of
///    elastic motions then leaves no stress, and the work of the forces equals that of the stresses;
///  - the shear force of Eq. 31 has the current length, as conservation of angular momentum requires (E7);
///  - the forward rotation of Eq. 32 is the current axis itself, so no rotation matrix is needed (E7).
template <bool kForceBased, class Law, class Rule, class D, class F>
class WallChunk {
  using T = hn::TFromD<F>;
  using Real = Lane<D>;
  using Stress = Lane<F>;

 public:
  /// `scratch` has room for kScratchKinds values per element of the blocks.
  HWY_INLINE WallChunk(const Scene& scene, State& state, FibreHistory<T>& memory, double step, const Rule& rule,
                       std::span<const WallBlock> blocks, T* scratch)
      : scene_(scene),
        memory_(memory),
        step_(step),
        rule_(rule),
        blocks_(blocks),
        scratch_(scratch, blocks.front().first_element),
        position_(state.position.data()),
        spin_(state.spin.data()),
        axis_(state.axis.data()),
        length_(state.length.data()),
        inverse_length_(state.inverse_length.data()),
        shortening_(state.shortening.data()),
        grown_(state),
        turns_(state),
        wall_force_(state.wall_force.data()),
        wall_moment_(state.wall_moment.data()),
        internal_force_(state.internal_force.data()),
        internal_moment_(state.internal_moment.data()),
        stress_(memory.stress.data()),
        shear_(scene.walls.shear.empty() ? nullptr : scene.walls.shear.data()),
        inverse_modulus_(1.0 / scene.materials.front().youngs_modulus),
        prefetches_(memory.stress.size() * sizeof(T) > last_cache_bytes() / kCacheShareOfFibres),
        uniform_(LaneMaterials<F>(scene.materials.front())) {}

  /// The first loop: axes, lengths and strains. Returns whether any elements are squashed, so that their modulus is
  /// reduced (E5c).
  HWY_INLINE bool deform() {
    visit_lanes<D>([&](const WallBlock& block, int lane) HWY_ATTR { reverse_motions(block, lane); });
    return is_squashed_;
  }

  /// Greatest growth of half of an element's thickness in the first loop, mm; not below 0.
  [[nodiscard]] HWY_INLINE double thickening_step() const { return grown_.step(); }

  /// The second and the third loop: stresses and forces. `is_squashed` is the result of the first. Adds the plastic
  /// work to that of the lanes.
  HWY_INLINE void respond(bool is_squashed, double* HWY_RESTRICT plastic_work) {
    is_squashed_ = is_squashed;
    visit_lanes<F>([&](const WallBlock& block, int lane) HWY_ATTR {
      set_shear(block, lane);
      return_map_fibres(block, lane);
    });
    visit_lanes<D>([&](const WallBlock& block, int lane) HWY_ATTR { put_forces(block, lane, plastic_work + lane); });
  }

  /// The three loops for the walls of the lanes from `lane` on alone, beside threads that compute other walls of the
  /// block.
  HWY_INLINE void advance_alone(const WallBlock& block, int lane, double* HWY_RESTRICT plastic_work) {
    alone_ = lane;
    is_squashed_ = false;
    reverse_motions(block, lane);
    set_shear(block, lane);
    return_map_fibres(block, lane);
    put_forces(block, lane, plastic_work);
  }

 private:
  static constexpr int kTogether = -1;

  /// Calls visit(block, lane) for every group of walls that fills the lanes of tag L.
  template <class L, class Visit>
  HWY_INLINE void visit_lanes(Visit&& visit) const {
    for (const WallBlock& block : blocks_) {
      for (int lane = 0; lane < walls_of(block); lane += static_cast<int>(Lane<L>::kWidth)) {
        visit(block, lane);
      }
    }
  }

  /// Walls of a block, that is, elements of a row. A constant where they fill vectors, so that the addresses in a row
  /// are known at compile time.
  HWY_INLINE static int walls_of(const WallBlock& block) { return Real::kWidth == 1 ? block.walls : kMostWallsInBlock; }

  HWY_INLINE static std::ptrdiff_t row_of(const WallBlock& block, int j) {
    return block.first_element + static_cast<std::ptrdiff_t>(j) * walls_of(block);
  }

  HWY_INLINE EndMotion<D> gather_joint(const int* joints) const {
    return {gather<D>(position_, joints), Real(step_) * gather<D>(spin_, joints)};
  }

  HWY_INLINE EndMotion<D> load_inner(std::ptrdiff_t particle, bool turns) const {
    return {Points<D>::load(position_ + particle), turns ? Real(step_) * Real::load(spin_ + particle) : Real(0)};
  }

  /// Whether the elements of the walls of a block are solved two by two (E5b).
  HWY_INLINE static bool has_pairs(const WallBlock& block) { return kForceBased && block.has_pairs(); }

  /// From the motion of the ends to the strains of the step (E3 to E5).
  HWY_INLINE void reverse_motions(const WallBlock& block, int lane) {
    const int wall = block.first_wall + lane;
    const CrossSection<D> section(scene_, block, lane);
    EndMotion<D> start = gather_joint(&scene_.walls.start[wall]);
    bool grows = false;
    Real turn_before = 0;
    Real slenderness_before = 0;
    Slenderness<D> coupled_before = {0, 0};
    for (int j = 0; j < block.elements; ++j) {
      const std::ptrdiff_t row = row_of(block, j);
      const std::ptrdiff_t e = row + lane;
      const bool is_paired_on = has_pairs(block) && j % 2 == 0;
      const EndMotion<D> end = j + 1 == block.elements
                                   ? gather_joint(&scene_.walls.end[wall])
                                   : load_inner(block.first_inner + (row - block.first_element) + lane, !is_paired_on);
      const Real previous_length = Real::load(length_ + e);
      const Real previous_inverse = Real::load(inverse_length_ + e);
      const Deformation<D> deformation = reverse_motion(end.position - start.position, Points<D>::load(axis_ + e),
                                                        previous_length, previous_inverse, start.turn, end.turn);
      deformation.axis.store(axis_ + e);
      deformation.length.store(length_ + e);
      deformation.inverse_length.store(inverse_length_ + e);
      const RowStrains<T> strains = scratch_.strains(row, lane, walls_of(block));
      const Real shortening = Real::load(shortening_ + e);
      Real thickness = section.thickness;
      const Real compression = section.undeformed * deformation.inverse_length;
      if (HWY_UNLIKELY(any(section.is_squashed(max(shortening, compression))))) {
        thickness += squash(section, e, shortening, compression, strains.modulus_share, grows);
      }
      const Real inverse_strained = section.inverse_strained(shortening);
      const Real slenderness = thickness * inverse_strained;
      (deformation.stretch * inverse_strained).store(strains.membrane);
      if (HWY_UNLIKELY(turns_.are_coupled())) {
        const Slenderness<D> coupled = {thickness * previous_inverse, thickness * deformation.inverse_length};
        (has_pairs(block) && !is_paired_on
             ? turns_.bend_between(e - walls_of(block), e, deformation.rotation_start - turn_before, coupled_before,
                                   coupled)
             : turns_.bend_start(e, deformation.rotation_start, coupled))
            .store(strains.bend_start);
        if (!is_paired_on) {
          turns_.bend_end(e, deformation.rotation_end, coupled).store(strains.bend_end);
        }
        start = end;
        turn_before = deformation.rotation_end;
        coupled_before = coupled;
        continue;
      }
      if (has_pairs(block) && !is_paired_on) {
        // The turn between the two elements, over their mean length: their common node has no rotation.
        const Real turn = deformation.rotation_start - turn_before;
        (Real(0.5) * (slenderness + slenderness_before) * turn).store(strains.bend_start);
      } else {
        (slenderness * deformation.rotation_start).store(strains.bend_start);
      }
      if (!is_paired_on) {
        (slenderness * deformation.rotation_end).store(strains.bend_end);
      }
      start = end;
      turn_before = deformation.rotation_end;
      slenderness_before = slenderness;
    }
    if (HWY_UNLIKELY(grows)) {
      grow_balls(block, lane);
    }
  }

  /// Updates the thickness in contact (E5f) and the modulus (E5c) of squashed elements. Returns what the thickness in
  /// bending is above that before loading.
  HWY_INLINE Real squash(const CrossSection<D>& section, std::ptrdiff_t element, Real shortening, Real compression,
                         T* modulus_share, bool& grows) {
    if (!section.constant_area && (section.grows(compression) || any(grown_.thickening(element) > Real(0)))) {
      grown_.grow(section, element, compression);
      grows = true;
    }
    const Real thickening = section.thickening(shortening);
    note_modulus(section.modulus_share(shortening, thickening), modulus_share);
    return thickening + thickening;
  }

  HWY_INLINE void grow_balls(const WallBlock& block, int lane) const {
    for (int j = 1; j < block.elements; ++j) {
      const std::ptrdiff_t particle = block.first_inner + static_cast<std::ptrdiff_t>(j - 1) * walls_of(block) + lane;
      grown_.grow_balls(particle, row_of(block, j - 1) + lane, row_of(block, j) + lane);
    }
  }

  /// Few chunks have squashed elements; in the others these values are never filled.
  HWY_INLINE void note_modulus(Real share, T* to) {
    if (!is_squashed_) {
      for (const WallBlock& block : blocks_) {
        const int walls = walls_of(block);
        const int first = alone_ == kTogether ? 0 : std::min(alone_, walls);
        const int end = alone_ == kTogether ? walls : std::min(alone_ + static_cast<int>(Real::kWidth), walls);
        for (int j = 0; j < block.elements; ++j) {
          std::fill_n(scratch_.strains(row_of(block, j), first, walls).modulus_share, end - first, T(1.0));
        }
      }
      is_squashed_ = true;
    }
    share.store(to);
  }

  HWY_INLINE Fibres<T> fibres_of(std::ptrdiff_t row, int lane, int stride) const {
    const std::ptrdiff_t first = row * rule_.fibres() + lane;
    return {stress_ + first,
            Law::kFacts.keeps_back_stress ? &memory_.back_stress[first] : nullptr,
            Law::kFacts.keeps_plastic_strain ? &memory_.plastic_strain[first] : nullptr,
            Law::kFacts.keeps_tangent ? &memory_.tangent[first] : nullptr,
            Law::kFacts.keeps_tangent ? &memory_.flow[first] : nullptr,
            Law::kFacts.keeps_plastic_strain ? nullptr : &memory_.yielded[row + lane],
            static_cast<std::size_t>(stride)};
  }

  HWY_INLINE ElementMemory<T> memory_of(std::ptrdiff_t row, int lane, int stride) const {
    const std::ptrdiff_t first = row * rule_.sections() + lane;
    return {fibres_of(row, lane, stride),
            &memory_.section_axial[first],
            &memory_.section_moment[first],
            &memory_.yielding[row + lane],
            &memory_.end_force[row * kEndForces + lane],
            &memory_.owed[row + lane]};
  }

  /// Prefetches the stresses of the lanes kRowsAhead rows ahead.
  HWY_INLINE void prefetch_fibres(std::ptrdiff_t row, int lane, int walls) const {
    constexpr std::size_t kLine = 64 / sizeof(T);
    const T* const from = stress_ + (row + kRowsAhead * walls + lane) * rule_.fibres();
    for (std::size_t i = 0; i < rule_.fibres() * Stress::kWidth; i += kLine) {
      prefetch_to_change(from + i);
    }
  }

  /// From the strains to the sums over the stresses (E5 to E6).
  HWY_INLINE void return_map_fibres(const WallBlock& block, int lane) const {
    const LaneMaterial<F> material =
        scene_.materials.size() == 1 ? uniform_ : LaneMaterial<F>(LaneMaterials<F>(scene_, block.first_wall + lane));
    const int together = has_pairs(block) ? 2 : 1;
    for (int j = 0; j < block.elements; j += together) {
      if (prefetches_) {
        for (int e = 0; e < together; ++e) {
          prefetch_fibres(row_of(block, j + e), lane, walls_of(block));
        }
      }
      if constexpr (kForceBased) {
        together == 2 ? advance_unit<2>(block, lane, j, material) : advance_unit<1>(block, lane, j, material);
      } else {
        const std::ptrdiff_t row = row_of(block, j);
        const RowStrains<T> strains = scratch_.strains(row, lane, walls_of(block));
        put_sums(return_map_element<Law>(softened(material, strains), rule_, load_strains(strains),
                                         fibres_of(row, lane, walls_of(block)), step_),
                 scratch_.sums(row, lane, walls_of(block)));
      }
    }
  }

  /// The elements of a force-based unit, from element j of the wall on.
  template <int kElements>
  HWY_INLINE void advance_unit(const WallBlock& block, int lane, int j, const LaneMaterial<F>& material) const {
    const int walls = walls_of(block);
    UnitResponse<Law, kElements, Rule, F> unit(rule_, step_, elastic_);
    LaneMaterial<F> soft[kElements];
    for (int e = 0; e < kElements; ++e) {
      const std::ptrdiff_t row = row_of(block, j + e);
      const RowStrains<T> strains = scratch_.strains(row, lane, walls);
      if (is_squashed_) {
        soft[e] = softened(material, strains);
      }
      unit.set(e, is_squashed_ ? soft[e] : material, material.modulus, is_squashed_, memory_of(row, lane, walls),
               load_strains(strains));
      if (HWY_UNLIKELY(shear_ != nullptr)) {
        unit.set_shear(e, &memory_.shear[row + lane]);
      }
    }
    ElementSums<F> sums[kElements];
    unit.advance(sums);
    for (int e = 0; e < kElements; ++e) {
      put_sums(sums[e], scratch_.sums(row_of(block, j + e), lane, walls));
    }
  }

  HWY_INLINE void set_shear(const WallBlock& block, int lane) {
    if (HWY_UNLIKELY(shear_ != nullptr)) {
      elastic_ = ElasticElement<F>(load_shear(block.first_wall + lane));
    }
  }

  /// phi of the walls of the lanes (E5i).
  HWY_INLINE Stress load_shear(int wall) const {
    T phi[Stress::kWidth];
    for (std::size_t i = 0; i < Stress::kWidth; ++i) {
      phi[i] = static_cast<T>(shear_[wall + static_cast<int>(i)]);
    }
    return Stress::load(phi);
  }

  HWY_INLINE LaneMaterial<F> softened(const LaneMaterial<F>& material, const RowStrains<T>& strains) const {
    return is_squashed_ ? material.softened(Stress::load(strains.modulus_share)) : material;
  }

  HWY_INLINE static ElementStrains<F> load_strains(const RowStrains<T>& strains) {
    return {Stress::load(strains.membrane), Stress::load(strains.bend_start), Stress::load(strains.bend_end)};
  }

  HWY_INLINE static void put_sums(const ElementSums<F>& element, const RowSums<T>& sums) {
    element.axial.store(sums.axial);
    element.moment_start.store(sums.moment_start);
    element.moment_end.store(sums.moment_end);
    element.plastic_work.store(sums.plastic_work);
  }

  /// Areas of elements, mm^2: A; and for moments A, or V_0 / l of coupled bending, times the thickness over that before
  /// loading.
  struct Areas {
    Real axial;
    Real moment;
  };

  /// The areas where bending is coupled: moments over the current length (E5j).
  HWY_INLINE Areas coupled(const Areas& areas, const CrossSection<D>& section, std::ptrdiff_t element) const {
    return {areas.axial, section.volume() * Real::load(inverse_length_ + element) * (areas.moment / areas.axial)};
  }

  /// From the sums over the stresses to the forces on the particles (E7). At the common node of a pair the section has
  /// the mean of both.
  HWY_INLINE void put_forces(const WallBlock& block, int lane, double* HWY_RESTRICT plastic_work) const {
    const CrossSection<D> section(scene_, block, lane);
    const Real inverse_modulus = scene_.materials.size() == 1 ? inverse_modulus_ : Real(1) / section.modulus();
    const std::size_t ends = 2 * static_cast<std::size_t>(block.first_wall) + lane;
    NodalForces<D> before = {{0, 0}, 0, 0};
    Real work = Real::load(plastic_work);
    const int walls = walls_of(block);
    const auto shorten_row = [&](int j) HWY_ATTR {
      const std::ptrdiff_t row = row_of(block, j);
      const Areas areas = shorten(section, row, lane, walls, inverse_modulus, work);
      return HWY_UNLIKELY(turns_.are_coupled()) ? coupled(areas, section, row + lane) : areas;
    };
    Areas own = shorten_row(0);
    Real start_area = own.moment;
    for (int j = 0; j < block.elements; ++j) {
      const std::ptrdiff_t row = row_of(block, j);
      const RowSums<T> sums = scratch_.sums(row, lane, walls);
      const bool is_paired_on = has_pairs(block) && j % 2 == 0;
      const Areas next = j + 1 < block.elements ? shorten_row(j + 1) : own;
      const Real end_area = is_paired_on ? Real(0.5) * (own.moment + next.moment) : own.moment;
      const Real inverse_length = Real::load(inverse_length_ + row + lane);
      Real axial = own.axial * Real::load(sums.axial);
      if (HWY_UNLIKELY(turns_.are_coupled())) {
        axial -= section.thickness * own.moment * inverse_length *
                 turns_.work_of(row + lane, Real::load(sums.moment_start), Real::load(sums.moment_end));
      }
      const NodalForces<D> forces = nodal_forces({axial, section.thickness * start_area * Real::load(sums.moment_start),
                                                  section.thickness * end_area * Real::load(sums.moment_end)},
                                                 inverse_length, Points<D>::load(axis_ + row + lane));
      work = fma(section.volume(), Real::load(sums.plastic_work), work);
      if (j == 0) {
        put_on_joints(ends, forces.force_on_end, -forces.moment_on_start);
      } else {
        const std::ptrdiff_t particle = block.first_inner + static_cast<std::ptrdiff_t>(j - 1) * walls + lane;
        (forces.force_on_end - before.force_on_end).store(internal_force_ + particle);
        (-(before.moment_on_end + forces.moment_on_start)).store(internal_moment_ + particle);
      }
      before = forces;
      start_area = is_paired_on ? end_area : next.moment;
      own = next;
    }
    put_on_joints(ends + walls, -before.force_on_end, -before.moment_on_end);
    work.store(plastic_work);
  }

  /// Updates L of the elements of a row (E5c) and returns the areas that follow. Takes from `work` what the elements
  /// store as their modulus falls (E5g).
  HWY_INLINE Areas shorten(const CrossSection<D>& section, std::ptrdiff_t row, int lane, int walls,
                           Real inverse_modulus, Real& work) const {
    const std::ptrdiff_t element = row + lane;
    const Real before = Real::load(shortening_ + element);
    const Real elastic = Real::load(scratch_.sums(row, lane, walls).axial) * inverse_modulus;
    const Real now = section.shortening(Real::load(inverse_length_ + element), elastic);
    if (HWY_UNLIKELY(any(section.is_squashed(max(before, now))))) {
      return shorten_squashed(section, row, lane, walls, inverse_modulus, work);
    }
    now.store(shortening_ + element);
    const Real area = section.area(now);
    return {area, area};
  }

  /// The same where any are squashed, before the step or after it.
  HWY_NOINLINE Areas shorten_squashed(const CrossSection<D>& section, std::ptrdiff_t row, int lane, int walls,
                                      Real inverse_modulus, Real& work) const {
    const std::ptrdiff_t element = row + lane;
    const RowSums<T> sums = scratch_.sums(row, lane, walls);
    const Real axial = Real::load(sums.axial);
    const Real before = Real::load(shortening_ + element);
    const LaneMask<D> was_squashed = section.is_squashed(before);
    const Real thickening = section.thickening(before);
    const Real of_stiffness = inverse_modulus / section.stiffness_at_bound();
    const Real inverse = select(was_squashed, of_stiffness * section.stiffness(before, thickening), inverse_modulus);
    const Real elastic =
        select(was_squashed, section.elastic_strain(axial, inverse, inverse_modulus), axial * inverse_modulus);
    const Real now = section.shortening(Real::load(inverse_length_ + element), elastic);
    now.store(shortening_ + element);
    const Real left = Real::load(sums.moment_start);  // over A h: their squares are a twelfth of those over A gamma
    const Real right = -Real::load(sums.moment_end);
    Real squares = fma(Real(4), fma(left, left, fma(left, right, right * right)), axial * axial);
    if (shear_ != nullptr) {
      squares = fma(Real(12) * Real::load(shear_ + section.wall), (left - right) * (left - right), squares);
    }
    const Real inverse_now = select(section.is_squashed(now),
                                    of_stiffness * section.stiffness(now, section.thickening(now)), inverse_modulus);
    work = fnma(Real(0.5) * section.volume() * (inverse_now - inverse), squares, work);
    const Real area = section.area(now);
    return {area, area * (Real(1) + (thickening + thickening) / section.thickness)};
  }

  /// Forces of an element from its axial force and end moments (Eq. 31, 32, E7).
  HWY_INLINE static NodalForces<D> nodal_forces(const EndForces<D>& of, Real inverse_length, const Points<D>& axis) {
    const Real shear = -(of.moment_on_start + of.moment_on_end) * inverse_length;
    return {{fms(of.axial, axis.x, shear * axis.y), fma(of.axial, axis.y, shear * axis.x)},
            of.moment_on_start,
            of.moment_on_end};
  }

  HWY_INLINE void put_on_joints(std::size_t end, const Points<D>& force, Real moment) const {
    force.store(wall_force_ + end);
    moment.store(wall_moment_ + end);
  }

  const Scene& scene_;
  FibreHistory<T>& memory_;
  const double step_;
  const Rule& rule_;
  const std::span<const WallBlock> blocks_;
  const ChunkScratch<T> scratch_;

  // Raw pointers: a store may alias a vector's own pointer.
  const Vector2* const position_;
  const double* const spin_;
  Vector2* const axis_;
  double* const length_;
  double* const inverse_length_;
  double* const shortening_;
  GrownWalls<D> grown_;
  const EndTurns<D> turns_;
  Vector2* const wall_force_;
  double* const wall_moment_;
  Vector2* const internal_force_;
  double* const internal_moment_;
  T* const stress_;
  const double* const shear_;  // null unless the walls shear

  const Real inverse_modulus_;  // of one material
  const bool prefetches_;
  const LaneMaterial<F> uniform_;
  ElasticElement<F> elastic_;  // of walls that shear, of those in the lanes
  bool is_squashed_ = false;
  int alone_ = kTogether;  // the lane, where one advances alone
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_WALL_CHUNK_INL_H_
