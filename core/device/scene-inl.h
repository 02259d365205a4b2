#pragma once

// Scene and state of a crush on a device: what its phases read and write, under the names that the laws use
// (cellcrush/scene.h, cellcrush/state.h). Arrays are pointers into the memory of the device; those that a crush on a
// device does not have are empty.

#include <cstddef>
#include <cstdint>

#include "cellcrush/ledger.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
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
  bool bends;
  double stiffness;
  double damping_ratio;
  double thinnest;
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
  Array<std::uint64_t> contact_tiles;
  Ledger ledger;
};

/// Fibres of a device are not prefetched.
HWY_INLINE std::size_t last_cache_bytes() { return ~std::size_t{0}; }

}  // namespace cellcrush::HWY_NAMESPACE
