#pragma once

// Scene and state of a crush on a device: what its phases read and write, under the names that the laws use
// (cellcrush/scene.h, cellcrush/state.h). Arrays are pointers into the memory of the device; those that a crush on a
// device does not have are empty. Included before any law, by
// device/crush-inl.h.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "cellcrush/ledger.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "simd/lane-inl.h"

namespace cellcrush::HWY_NAMESPACE {

template <class T>
struct Array {
  T* values = nullptr;
  std::size_t count = 0;

  [[nodiscard]] HWY_INLINE T* data() const { return values; }
  [[nodiscard]] HWY_INLINE std::size_t size() const { return count; }
  [[nodiscard]] HWY_INLINE bool empty() const { return count == 0; }
  [[nodiscard]] HWY_INLINE T& operator[](std::size_t i) const { return values[i]; }
  [[nodiscard]] HWY_INLINE T& front() const { return values[0]; }
};

/// Most candidates of a ball, and most segments that it touches at once. A crush with more ends on the device.
inline constexpr int kMostCandidates = 48;
inline constexpr int kMostTouches = 16;

/// Those that the laws on a device read.
struct LawParameters {
  double hardening_modulus_mpa;
  double isotropic_fraction;
};

struct Material {
  double youngs_modulus;
  double yield_stress;
  LawParameters law;
  bool plane_strain;
};

struct Walls {
  Array<const WallBlock> blocks;
  Array<const int> chunk_offset;
  Array<const int> start;
  Array<const int> end;
  Array<const double> thickness;
  Array<const double> undeformed_length;
  Array<const int> material;
  Array<const double> shear;
};

struct SectionFacts {
  bool force_based;
};

struct ContactFacts {
  bool present;
  bool bends;
  double stiffness;
  double damping_ratio;
  double friction;
  double thinnest;
  double face_skin;
};

struct LimitedReaches {
  Array<const int> offset;
  Array<const int> segment;
  Array<const double> reach;
};

/// Walls that overlap before loading are not for a device.
struct NoOverlaps {
  [[nodiscard]] HWY_INLINE bool empty() const { return true; }
};

struct PlatesFacts {
  int axis;
};

struct ScheduleFacts {
  double time_step;
};

struct Scene {
  Array<const double> mass;
  Array<const double> inertia;
  Array<const double> inverse_mass;
  Array<const double> inverse_inertia;
  Walls walls;
  Array<const double> radius;
  double greatest_radius;  ///< that a ball can have, mm
  Array<const Element> elements;
  Array<const int> incidence_offset;
  Array<const int> incidence;
  LimitedReaches limited_reaches;
  NoOverlaps start_overlaps;
  Array<const int> wall_end_offset;
  Array<const int> wall_ends;
  Array<const Material> materials;
  Array<const Support> supports;
  ContactFacts contact;
  double depth;
  bool constant_area;
  SectionFacts section;
  PlatesFacts plates;
  MassScaling mass_scaling;
  double mass_damping;
  ScheduleFacts schedule;

  [[nodiscard]] HWY_INLINE bool is_loaded() const { return false; }
};

template <class T>
struct FibreHistory {
  using Bits = typename cellcrush::FibreHistory<T>::Bits;

  Array<T> stress;
  Array<T> back_stress;
  Array<T> plastic_strain;
  Array<T> tangent;
  Array<T> flow;
  Array<Bits> yielded;
  Array<T> section_axial;
  Array<T> section_moment;
  Array<Bits> yielding;
  Array<T> end_force;
  Array<T> owed;
  Array<T> shear;
};

/// Pairs of a ball: a part of the arrays of all (TouchMemory of cellcrush/contact_lists.h).
struct TouchMemory {
  Array<int> ball;
  Array<int> segment;
  Array<double> reach;
  Array<int> linked;
  Array<int> side;
  Array<int> pushed;
  Array<double> friction;

  [[nodiscard]] HWY_INLINE std::size_t count() const { return ball.count; }
};

struct ContactLists {
  TouchMemory touching;
  double reach_growth;
};

/// Of the pairs of a ball (Touches of contact/contact_workspace.h).
struct Touches {
  static constexpr int kNew = cellcrush::Touches::kNew;

  Array<int> start;
  Array<int> end;
  Array<int> known;
  Array<double> growth;
  Array<double> offset;
  Array<double> share;
  Array<double> depth;
  Array<double> deflection;
  Array<Vector2> normal;
  Array<double> viscous;
  Array<double> slip;
  Array<int> node;
  Array<double> node_depth;
  Array<Vector2> node_normal;
};

struct State {
  Array<Vector2> position;
  Array<Vector2> velocity;
  Array<double> rotation;
  Array<double> spin;
  Array<ReactionImpulse> reaction_impulse;
  Array<Vector2> axis;
  Array<double> length;
  Array<double> inverse_length;
  Array<double> shortening;
  Array<double> thickening;
  Array<double> thickening_slope;
  Array<double> radius_growth;
  Array<double> start_turn;
  Array<double> end_turn;
  FibreHistory<double> fibres;
  FibreHistory<float> single_fibres;
  Array<Vector2> wall_force;
  Array<double> wall_moment;
  Array<Vector2> internal_force;
  Array<double> internal_moment;
  Array<Vector2> load_force;
  Array<double> load_moment;
  Array<ContactForce> contact_force;
  Array<double> contact_moment;
  Array<Vector2> friction_force;
  Array<double> impact_friction;
  Array<double> support_friction;
  Array<std::uint64_t> contact_tiles;
  Ledger ledger;
};

HWY_INLINE double full_reach_of(const Scene& scene, int ball, int segment) {
  return scene.radius[ball] + 0.5 * scene.elements[segment].thickness;
}

HWY_INLINE double most_reach_now(const Scene& scene, const State& /*state*/, int ball, int segment) {
  if (!scene.limited_reaches.offset.empty()) {
    for (int k = scene.limited_reaches.offset[ball]; k < scene.limited_reaches.offset[ball + 1]; ++k) {
      if (scene.limited_reaches.segment[k] == segment) return scene.limited_reaches.reach[k];
    }
  }
  return std::numeric_limits<double>::infinity();
}

HWY_INLINE double reach_now(const Scene& scene, const State& state, int ball, int segment) {
  return std::min(full_reach_of(scene, ball, segment), most_reach_now(scene, state, ball, segment));
}

/// All pairs at hand are those of one ball.
HWY_INLINE PairRange pairs_of_ball(const TouchMemory& touching, int /*ball*/, int /*index*/) {
  return {0, static_cast<int>(touching.count())};
}

/// Fibres of a device are not prefetched.
HWY_INLINE std::size_t last_cache_bytes() { return ~std::size_t{0}; }

}  // namespace cellcrush::HWY_NAMESPACE
