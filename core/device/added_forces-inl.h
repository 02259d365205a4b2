#pragma once

// What the laws of contact add forces to on a device: a state whose contact forces are a list (AddedForce).

#include <cstddef>
#include <cstdint>

#include "device/atomics-inl.h"
#include "device/crush-inl.h"

namespace cellcrush::HWY_NAMESPACE {

/// The forces that one item adds, in its order: of the contacts of a ball, then of the plates on it.
class ForceList {
 public:
  HWY_INLINE ForceList(Crush& crush, int ball)
      : crush_(crush), next_key_((static_cast<std::uint64_t>(ball) << kBitsOfOne) + 1) {}

  /// Friction comes after the normal forces of all balls, and plates after both.
  HWY_INLINE void begin_friction() { next_key_ |= kFriction; }
  HWY_INLINE void begin_plates() { next_key_ |= kPlates; }

  HWY_INLINE void add(int particle, AddedForce::Part part, double x, double y, double z = 0.0, double w = 0.0) {
    const int place = add_at(crush_.totals[0].added_forces, 1);
    if (place >= static_cast<int>(crush_.added.size())) {
      crush_.totals[0].overflow = 1;
      return;
    }
    crush_.added[place] = {next_key_++, particle, exchange_at(crush_.first_added[particle], place), part, {x, y, z, w}};
  }

 private:
  static constexpr int kBitsOfOne = 24;
  static constexpr std::uint64_t kFriction = std::uint64_t{1} << 61;
  static constexpr std::uint64_t kPlates = std::uint64_t{1} << 62;

  Crush& crush_;
  std::uint64_t next_key_;
};

/// Elastic or viscous force on a particle.
class AddedPart {
 public:
  HWY_INLINE AddedPart(ForceList& list, int particle, AddedForce::Part part)
      : list_(list), particle_(particle), part_(part) {}

  HWY_INLINE void operator+=(const Vector2& force) { list_.add(particle_, part_, force.x(), force.y()); }
  HWY_INLINE void operator-=(const Vector2& force) { list_.add(particle_, part_, -force.x(), -force.y()); }

 private:
  ForceList& list_;
  int particle_;
  AddedForce::Part part_;
};

struct AddedForces {
  ForceList& list;
  int particle;
  AddedPart elastic = {list, particle, AddedForce::kElastic};
  AddedPart viscous = {list, particle, AddedForce::kViscous};
};

/// The friction forces, in place of an array of them.
struct FrictionArray {
  ForceList& list;

  HWY_INLINE AddedPart operator[](int particle) const { return {list, particle, AddedForce::kFriction}; }
};

struct ForceArray {
  ForceList& list;

  HWY_INLINE AddedForces operator[](int particle) const { return {list, particle}; }
};

/// The state, with a list in place of its contact forces.
struct AddingState {
  State& state;
  ForceList& list;

  ForceArray contact_force = {list};
  FrictionArray friction_force = {list};
  Array<const Vector2> position = {state.position.values, state.position.count};
  Array<const Vector2> velocity = {state.velocity.values, state.velocity.count};
  Array<const Vector2> axis = {state.axis.values, state.axis.count};
  Array<const double> inverse_length = {state.inverse_length.values, state.inverse_length.count};
  Array<const double> thickening_slope = {state.thickening_slope.values, state.thickening_slope.count};
  Array<const double> radius_growth = {state.radius_growth.values, state.radius_growth.count};

  HWY_INLINE operator const State&() const { return state; }
};

/// Every particle is looked at in every step.
HWY_INLINE void mark_contact_tile(const AddingState& /*state*/, int /*particle*/) {}

HWY_INLINE void add_share(double share, const double* pair, AddedForces to) {
  to.list.add(to.particle, AddedForce::kBoth, share * pair[0], share * pair[1], share * pair[2], share * pair[3]);
}

}  // namespace cellcrush::HWY_NAMESPACE
