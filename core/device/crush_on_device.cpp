#define CELLCRUSH_ON_DEVICE

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "beam/internal_forces.h"
#include "cellcrush/device.h"
#include "contact/topology/face_loops.h"
#include "device/device_memory.h"

namespace cellcrush {
namespace {

namespace on_device = HWY_NAMESPACE;
using on_device::Array;

/// Calls visit(array on the device, array of the state) for all that a crush on a device changes.
template <class OnDevice, class Own, class Visit>
void visit_shared(OnDevice& device, Own& own, const Visit& visit) {
  visit(device.position, own.position);
  visit(device.velocity, own.velocity);
  visit(device.rotation, own.rotation);
  visit(device.spin, own.spin);
  visit(device.axis, own.axis);
  visit(device.length, own.length);
  visit(device.inverse_length, own.inverse_length);
  visit(device.shortening, own.shortening);
  visit(device.thickening, own.thickening);
  visit(device.thickening_slope, own.thickening_slope);
  visit(device.radius_growth, own.radius_growth);
  visit(device.start_turn, own.start_turn);
  visit(device.end_turn, own.end_turn);
  const auto visit_fibres = [&](auto& on, auto& of) {
    visit(on.stress, of.stress);
    visit(on.back_stress, of.back_stress);
    visit(on.plastic_strain, of.plastic_strain);
    visit(on.yielded, of.yielded);
    visit(on.section_axial, of.section_axial);
    visit(on.section_moment, of.section_moment);
    visit(on.yielding, of.yielding);
    visit(on.end_force, of.end_force);
    visit(on.owed, of.owed);
    visit(on.shear, of.shear);
  };
  visit_fibres(device.fibres, own.fibres);
  visit_fibres(device.single_fibres, own.single_fibres);
  visit(device.wall_force, own.wall_force);
  visit(device.wall_moment, own.wall_moment);
  visit(device.internal_force, own.internal_force);
  visit(device.internal_moment, own.internal_moment);
  visit(device.contact_force, own.contact_force);
  visit(device.friction_force, own.friction_force);
  visit(device.impact_friction, own.impact_friction);
  visit(device.support_friction, own.support_friction);
}

/// Room for the forces that are added in a step. A contact adds up to five, with friction or growth up to forty.
std::size_t most_added_forces(const Scene& scene) {
  const std::size_t of_particle = scene.contact.friction > 0.0 || scene.thickens() ? 64 : 16;
  return of_particle * scene.particle_count() + 4096;
}

/// A crush whose arrays are copies of those of a state.
class CopiedCrush final : public CrushOnDevice {
 public:
  CopiedCrush(Device& device, const Scene& scene, const State& state)
      : device_(device), memory_(device), scene_(scene), walls_(copy_scene(scene, memory_, crush_)) {
    put_state(state);
    put_contacts(state);
    put_scratch();
    put_crush();
  }

  std::optional<std::string> advance(std::int64_t steps) override {
    if (steps <= 0) return std::nullopt;
    put_plate_steps(steps);
    device_.advance(&crush_, on_device_.data(), walls_, steps);
    device_.read(&totals_, crush_.totals.data(), sizeof totals_);
    if (totals_.overflow != 0) return "a list had no room";
    // The processor finds the step, and searches otherwise from it on.
    if (totals_.crossed != 0 || has_turned_face()) return "walls crossed";
    return std::nullopt;
  }

  void take(State& state) const override {
    state.step = step_;
    state.time = time_;
    state.impact_travel = totals_.impact_travel;
    visit_shared(crush_.state, state, [&](const auto& from, auto& to) { memory_.read(from, to); });
    state.ledger = totals_.ledger;
    state.impact_impulse = totals_.impact_impulse;
    state.support_impulse = totals_.support_impulse;
    state.impact_force = totals_.impact_force;
    state.support_force = totals_.support_force;
    state.contact_totals = totals_.contacts;
    state.contact_totals.deepest_penetration = std::bit_cast<double>(totals_.deepest_penetration);
    state.contact_totals.deepest_birth = std::bit_cast<double>(totals_.deepest_birth);
    state.contact_tiles.clear();
    state.contacts.assign(1, ContactLists());
    take_touches(state, state.contacts.front());
  }

 private:
  /// Whether a face is turned inside out: the search of a processor sees it too.
  [[nodiscard]] bool has_turned_face() const {
    if (!scene_.faces.are_enough()) return false;
    const std::vector<Vector2> position = values_of(crush_.state.position);
    const FacesOfBand& faces = scene_.faces.bands.front();
    for (int face = 0; face < faces.count(); ++face) {
      const std::span corners(&faces.particle[faces.offset[face]], static_cast<std::size_t>(faces.corner_count(face)));
      const double area = area_within(corners, position);
      if (face == faces.count() - 1 ? area > 0.0 : area < 0.0) return true;
    }
    return false;
  }

  void put_state(const State& state) {
    visit_shared(crush_.state, state,
                 [&](auto& to, const auto& from) { to = memory_.put<std::remove_reference_t<decltype(to[0])>>(from); });
    const Plates& plates = scene_.plates;
    const bool grows = scene_.thickens();
    crush_.impact = face_of_plate(scene_, plates.impact_face, 1.0, 0.0, crush_.state.impact_friction.values, grows);
    crush_.support = face_of_plate(scene_, plates.support_face, -1.0, 0.0, crush_.state.support_friction.values, grows);
    totals_ = {};
    totals_.ledger = state.ledger;
    totals_.impact_impulse = state.impact_impulse;
    totals_.support_impulse = state.support_impulse;
    totals_.impact_travel = state.impact_travel;
    totals_.impact_force = state.impact_force;
    totals_.support_force = state.support_force;
    totals_.deepest_penetration = std::bit_cast<std::uint64_t>(state.contact_totals.deepest_penetration);
    totals_.deepest_birth = std::bit_cast<std::uint64_t>(state.contact_totals.deepest_birth);
    totals_.search_travel = 2.0 * scene_.contact.face_skin + 1.0;  // the first step searches
    crush_.totals = memory_.put<on_device::Totals>(std::vector<on_device::Totals>{totals_});
    time_ = state.time;
    step_ = state.step;
  }

  void put_contacts(const State& state) {
    const std::size_t balls = scene_.particle_count();
    std::vector<int> count(balls, 0);
    std::vector<int> ball(balls * on_device::kMostTouches);
    std::vector<int> segment(ball.size(), 0);
    std::vector<double> reach(ball.size(), 0.0);
    std::vector<int> side(ball.size(), 0);
    std::vector<int> pushed(ball.size(), 0);
    std::vector<double> friction(ball.size(), 0.0);
    for (std::size_t i = 0; i < ball.size(); ++i) ball[i] = static_cast<int>(i / on_device::kMostTouches);
    const cellcrush::TouchMemory& touching = state.contacts.front().touching;
    for (std::size_t i = 0; i < touching.count(); ++i) {
      const int of = touching.ball[i];
      if (count[of] == on_device::kMostTouches) throw DeviceError("A ball touches too many segments.");
      const std::size_t at = static_cast<std::size_t>(of) * on_device::kMostTouches + count[of]++;
      segment[at] = touching.segment[i];
      reach[at] = touching.reach[i];
      side[at] = touching.side[i];
      if (touching.pushed.empty()) continue;
      pushed[at] = touching.pushed[i];
      friction[at] = touching.friction[i];
    }
    if (scene_.contact.friction > 0.0) {
      crush_.touch_pushed = memory_.put<int>(pushed);
      crush_.touch_friction = memory_.put<double>(friction);
      crush_.touch_known = memory_.room<int>(ball.size());
      crush_.before_count = memory_.zeros<int>(balls);
      crush_.before_segment = memory_.room<int>(ball.size());
      crush_.before_pushed = memory_.room<int>(ball.size());
      crush_.before_friction = memory_.room<double>(ball.size());
      crush_.before_goes_on = memory_.room<int>(ball.size());
    }
    crush_.touch_count = memory_.put<int>(count);
    crush_.touch_ball = memory_.put<int>(ball);
    crush_.touch_segment = memory_.put<int>(segment);
    crush_.touch_reach = memory_.put<double>(reach);
    crush_.touch_side = memory_.put<int>(side);
    crush_.touch_linked = memory_.zeros<int>(ball.size());
    crush_.touch_squared_depth = memory_.zeros<double>(ball.size());
    crush_.touch_stored = memory_.zeros<double>(ball.size());
    crush_.active_count = memory_.zeros<int>(balls);
    crush_.candidate_count = memory_.zeros<int>(scene_.contact.present ? balls : 0);
    crush_.candidate = memory_.room<int>(balls * on_device::kMostCandidates);
    crush_.plate_push = memory_.room<on_device::PlatePush>(balls);
    crush_.pressed = memory_.zeros<unsigned>(balls / 32 + 1);
    crush_.first_added = memory_.put<int>(std::vector<int>(balls, on_device::AddedForce::kEnd));
    crush_.added = memory_.room<on_device::AddedForce>(most_added_forces(scene_));
  }

  void put_scratch() {
    crush_.lane_works = memory_.room<double>(on_device::kWorkTerms * kSumLanes * crush_.moved.size());
    crush_.lane_plastic = memory_.room<double>(static_cast<std::size_t>(kMostWallsInBlock) *
                                               static_cast<std::size_t>(scene_.walls.chunk_count()));
    const std::size_t values = kScratchKinds * scene_.element_count();
    if (scene_.single_fibres) {
      crush_.single_scratch = memory_.room<float>(values);
    } else {
      crush_.double_scratch = memory_.room<double>(values);
    }
  }

  void put_crush() {
    if (on_device_.empty()) on_device_ = memory_.room<on_device::Crush>(1);
    memory_.write(on_device_, std::vector<on_device::Crush>{crush_});
  }

  /// The motion of the plate over the coming steps, which does not depend on the lattice.
  void put_plate_steps(std::int64_t steps) {
    std::vector<PlateStep> plates;
    for (std::int64_t k = 0; k < steps; ++k) {
      plates.push_back(plate_step_of(scene_, no_drive_, time_, totals_.impact_travel));
      totals_.impact_travel = plates.back().travel;
      time_ = static_cast<double>(++step_) * scene_.schedule.time_step;
    }
    if (crush_.plate_steps.size() < plates.size()) {
      crush_.plate_steps = memory_.room<const PlateStep>(plates.size());
      put_crush();
    }
    memory_.write(crush_.plate_steps, plates);
  }

  template <class T>
  std::vector<T> values_of(const Array<T>& array) const {
    std::vector<T> values;
    memory_.read(array, values);
    return values;
  }

  void take_touches(const State& state, ContactLists& lists) const {
    const std::vector<int> count = values_of(crush_.touch_count);
    const std::vector<int> segment = values_of(crush_.touch_segment);
    const std::vector<double> reach = values_of(crush_.touch_reach);
    const std::vector<int> linked = values_of(crush_.touch_linked);
    const std::vector<int> side = values_of(crush_.touch_side);
    const std::vector<int> pushed = values_of(crush_.touch_pushed);
    const std::vector<double> friction = values_of(crush_.touch_friction);
    cellcrush::TouchMemory& touching = lists.touching;
    for (std::size_t ball = 0; ball < count.size(); ++ball) {
      for (std::size_t i = ball * on_device::kMostTouches; i < ball * on_device::kMostTouches + count[ball]; ++i) {
        if (side[i] == 0) lists.released.push_back(static_cast<int>(touching.count()));
        touching.ball.push_back(static_cast<int>(ball));
        touching.segment.push_back(segment[i]);
        touching.reach.push_back(reach[i]);
        touching.place.push_back(0);
        touching.linked.push_back(linked[i]);
        touching.side.push_back(side[i]);
        if (pushed.empty()) continue;
        touching.pushed.push_back(pushed[i]);
        touching.friction.push_back(friction[i]);
      }
    }
    for (const double growth : state.radius_growth) lists.reach_growth = std::max(lists.reach_growth, 2.0 * growth);
  }

  Device& device_;
  DeviceMemory memory_;
  const Scene& scene_;
  const State no_drive_;  ///< of plates whose speed is not controlled
  on_device::Crush crush_ = {};
  const int walls_;  ///< their kind
  Array<on_device::Crush> on_device_;
  on_device::Totals totals_ = {};
  double time_ = 0.0;
  std::int64_t step_ = 0;
};

class Engine final : public DeviceEngine {
 public:
  explicit Engine(std::unique_ptr<Device> device) : device_(std::move(device)) {}

  [[nodiscard]] std::string name() const override { return device_->name(); }
  std::unique_ptr<CrushOnDevice> begin(const Scene& scene, const State& state) override {
    return std::make_unique<CopiedCrush>(*device_, scene, state);
  }

 private:
  std::unique_ptr<Device> device_;
};

}  // namespace

std::size_t layout_of_crush() { return on_device::kLayout; }

std::unique_ptr<DeviceEngine> make_engine(std::unique_ptr<Device> device) {
  return std::make_unique<Engine>(std::move(device));
}

}  // namespace cellcrush
