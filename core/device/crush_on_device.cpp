#define CELLCRUSH_ON_DEVICE

#include <algorithm>
#include <bit>
#include <memory>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "cellcrush/device.h"
#include "contact/topology/face_loops.h"
#include "device/steps-inl.h"
#include "motion/integrate_motion.h"
#include "section/section_rule.h"

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
}

/// Calls visit(kind) for the kind of walls of a scene, with its index.
template <class Visit>
void visit_kind(const Scene& scene, const Visit& visit) {
  const auto is_of = [&]<class Law, class Rule, bool kForceBased>(
                         std::type_identity<on_device::EvaluateWalls<kForceBased, Law, Rule>>) {
    bool has_law = false;
    Laws::visit(scene.law, [&](auto law) { has_law = std::is_same_v<decltype(law), Law>; });
    return has_law && kForceBased == scene.section.force_based &&
           std::is_same_v<typename Rule::Number, float> == scene.single_fibres;
  };
  [&]<std::size_t... Kinds>(std::index_sequence<Kinds...>) {
    const auto visit_one = [&]<std::size_t kIndex>(std::integral_constant<std::size_t, kIndex>) {
      using Kind = std::tuple_element_t<kIndex, on_device::WallKinds>;
      if (is_of(std::type_identity<Kind>())) visit(std::type_identity<Kind>(), static_cast<int>(kIndex));
    };
    (visit_one(std::integral_constant<std::size_t, Kinds>()), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<on_device::WallKinds>>());
}

/// Room for the forces that are added in a step: a few for each particle.
std::size_t most_added_forces(const Scene& scene) { return 16 * scene.particle_count() + 4096; }

Face face_of(const Scene& scene, double place, double outward) {
  Face face = {};
  face.point = face.normal = face.tangent = Vector2::Zero();
  face.point[scene.plates.axis] = place;
  face.normal[scene.plates.axis] = outward;
  face.tangent[1 - scene.plates.axis] = 1.0;
  face.stiffness = scene.plates.stiffness;
  face.grows = scene.thickens();
  return face;
}

/// A crush whose arrays are copies of those of a state.
class CopiedCrush final : public CrushOnDevice {
 public:
  CopiedCrush(Device& device, const Scene& scene, const State& state) : device_(device), scene_(scene) {
    put_scene();
    put_state(state);
    put_search();
    put_contacts(state);
    put_scratch();
    address_ = device_.allocate(sizeof crush_);
    memory_.push_back(address_);
    put_crush();
  }

  ~CopiedCrush() override {
    for (void* of : memory_) device_.free(of);
  }

  bool advance(std::int64_t steps) override {
    if (steps <= 0) return true;
    put_plate_steps(steps);
    device_.advance(&crush_, address_, walls_, steps);
    device_.read(&totals_, crush_.totals.data(), sizeof totals_);
    return totals_.overflow == 0;
  }

  void take(State& state) const override {
    state.step = step_;
    state.time = time_;
    state.impact_travel = totals_.impact_travel;
    visit_shared(crush_.state, state, [&](const auto& from, auto& to) {
      to.resize(from.size());
      if (!to.empty()) device_.read(to.data(), from.data(), from.size() * sizeof(to[0]));
    });
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
    if (totals_.crossed != 0 || has_turned_face(state)) state.crossing_step = step_;
  }

 private:
  /// Whether a face is turned inside out: the search of a processor sees it too.
  [[nodiscard]] bool has_turned_face(const State& state) const {
    if (!scene_.faces.are_enough()) return false;
    const FacesOfBand& faces = scene_.faces.bands.front();
    for (int face = 0; face < faces.count(); ++face) {
      const std::span corners(&faces.particle[faces.offset[face]], static_cast<std::size_t>(faces.corner_count(face)));
      const double area = area_within(corners, state.position);
      if (face == faces.count() - 1 ? area > 0.0 : area < 0.0) return true;
    }
    return false;
  }

  /// An array on the device with copies of some values.
  template <class T, class Values>
  Array<T> put(const Values& values) {
    using Value = std::remove_const_t<T>;
    static_assert(std::is_same_v<Value, std::remove_cvref_t<decltype(values[0])>>);
    const std::size_t bytes = values.size() * sizeof(Value);
    Array<T> array = room<T>(values.size());
    if (bytes > 0) device_.write(const_cast<Value*>(array.data()), values.data(), bytes);
    return array;
  }

  template <class T>
  Array<T> room(std::size_t count) {
    if (count == 0) return {};
    void* const of = device_.allocate(count * sizeof(T));
    memory_.push_back(of);
    return {static_cast<T*>(of), count};
  }

  template <class T>
  Array<T> zeros(std::size_t count) {
    return put<T>(std::vector<T>(count, T{}));
  }

  void put_scene() {
    on_device::Scene& to = crush_.scene;
    to.mass = put<const double>(scene_.mass);
    to.inertia = put<const double>(scene_.inertia);
    to.inverse_mass = put<const double>(scene_.inverse_mass);
    to.inverse_inertia = put<const double>(scene_.inverse_inertia);
    to.radius = put<const double>(scene_.radius);
    to.greatest_radius = scene_.greatest_radius();
    to.elements = put<const Element>(scene_.elements);
    to.incidence_offset = put<const int>(scene_.incidence_offset);
    to.incidence = put<const int>(scene_.incidence);
    to.limited_reaches = {put<const int>(scene_.limited_reaches.offset), put<const int>(scene_.limited_reaches.segment),
                          put<const double>(scene_.limited_reaches.reach)};
    to.wall_end_offset = put<const int>(scene_.wall_end_offset);
    to.wall_ends = put<const int>(scene_.wall_ends);
    to.walls.blocks = put<const WallBlock>(scene_.walls.blocks);
    to.walls.chunk_offset = put<const int>(scene_.walls.chunk_offset);
    to.walls.start = put<const int>(scene_.walls.start);
    to.walls.end = put<const int>(scene_.walls.end);
    to.walls.thickness = put<const double>(scene_.walls.thickness);
    to.walls.undeformed_length = put<const double>(scene_.walls.undeformed_length);
    to.walls.material = put<const int>(scene_.walls.material);
    to.walls.shear = put<const double>(scene_.walls.shear);
    std::vector<on_device::Material> materials;
    for (const Material& of : scene_.materials) {
      materials.push_back({of.youngs_modulus,
                           of.yield_stress,
                           {of.law.hardening_modulus_mpa, of.law.isotropic_fraction},
                           of.plane_strain});
    }
    to.materials = put<const on_device::Material>(materials);
    to.depth = scene_.depth;
    to.constant_area = scene_.constant_area;
    to.section = {scene_.section.force_based};
    to.plates = {scene_.plates.axis};
    to.contact = {scene_.contact.present,       scene_.contact.bends,    scene_.contact.stiffness,
                  scene_.contact.damping_ratio, scene_.contact.thinnest, scene_.contact.face_skin};
    to.mass_scaling = scene_.mass_scaling;
    to.mass_damping = scene_.mass_damping;
    to.schedule = {scene_.schedule.time_step};
    crush_.factors = on_device::step_factors_of(to);
    crush_.impact = face_of(scene_, scene_.plates.impact_face, 1.0);
    crush_.support = face_of(scene_, scene_.plates.support_face, -1.0);
    std::vector<ParticleRange> moved;
    for (std::size_t chunk = 0; chunk < moved_chunk_count(scene_); ++chunk) moved.push_back(moved_chunk(scene_, chunk));
    crush_.moved = put<const ParticleRange>(moved);
    visit_kind(scene_, [&]<class Kind>(std::type_identity<Kind>, int index) {
      const typename Kind::Factors factors(scene_.section);
      const auto* bytes = reinterpret_cast<const unsigned char*>(&factors);
      crush_.rule = put<const unsigned char>(std::vector<unsigned char>(bytes, bytes + sizeof factors));
      walls_ = index;
    });
  }

  void put_state(const State& state) {
    visit_shared(crush_.state, state,
                 [&](auto& to, const auto& from) { to = put<std::remove_reference_t<decltype(to[0])>>(from); });
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
    crush_.totals = put<on_device::Totals>(std::vector<on_device::Totals>{totals_});
    time_ = state.time;
    step_ = state.step;
  }

  void put_search() {
    if (!scene_.contact.present) return;
    double longest = 0.0;
    for (const double length : scene_.walls.undeformed_length) longest = std::max(longest, length);
    // Segments may stretch by half; beyond that the crush ends on the device.
    crush_.square_size = 0.75 * longest + 2.0 * scene_.greatest_radius() + scene_.contact.face_skin;
    crush_.first_segment = room<int>(std::bit_ceil(scene_.element_count()));
    crush_.next_segment = room<int>(scene_.element_count());
    if (scene_.faces.are_enough()) put_faces();
  }

  /// The faces of every ball and segment.
  void put_faces() {
    const std::vector<int>& side = scene_.faces.side;
    std::vector<std::vector<int>> of_segment(scene_.element_count());
    for (std::size_t e = 0; e < of_segment.size(); ++e) of_segment[e] = {side[2 * e], side[2 * e + 1]};
    for (const ThickEnd& end : scene_.faces.thick_ends) of_segment[end.element].push_back(end.face);
    std::vector<std::vector<int>> of_ball(scene_.particle_count());
    for (std::size_t ball = 0; ball < of_ball.size(); ++ball) {
      for (int k = scene_.incidence_offset[ball]; k < scene_.incidence_offset[ball + 1]; ++k) {
        for (const int face : {side[2 * scene_.incidence[k]], side[2 * scene_.incidence[k] + 1]}) {
          if (std::ranges::find(of_ball[ball], face) == of_ball[ball].end()) of_ball[ball].push_back(face);
        }
      }
    }
    put_lists(of_ball, crush_.ball_faces_offset, crush_.ball_faces);
    put_lists(of_segment, crush_.segment_faces_offset, crush_.segment_faces);
  }

  void put_lists(const std::vector<std::vector<int>>& lists, Array<const int>& offset, Array<const int>& all) {
    std::vector<int> ends = {0};
    std::vector<int> joined;
    for (const std::vector<int>& list : lists) {
      joined.insert(joined.end(), list.begin(), list.end());
      ends.push_back(static_cast<int>(joined.size()));
    }
    offset = put<const int>(ends);
    all = put<const int>(joined);
  }

  void put_contacts(const State& state) {
    const std::size_t balls = scene_.particle_count();
    std::vector<int> count(balls, 0);
    std::vector<int> ball(balls * on_device::kMostTouches);
    std::vector<int> segment(ball.size(), 0);
    std::vector<double> reach(ball.size(), 0.0);
    std::vector<int> side(ball.size(), 0);
    for (std::size_t i = 0; i < ball.size(); ++i) ball[i] = static_cast<int>(i / on_device::kMostTouches);
    const cellcrush::TouchMemory& touching = state.contacts.front().touching;
    for (std::size_t i = 0; i < touching.count(); ++i) {
      const int of = touching.ball[i];
      if (count[of] == on_device::kMostTouches) throw DeviceError("A ball touches too many segments.");
      const std::size_t at = static_cast<std::size_t>(of) * on_device::kMostTouches + count[of]++;
      segment[at] = touching.segment[i];
      reach[at] = touching.reach[i];
      side[at] = touching.side[i];
    }
    crush_.touch_count = put<int>(count);
    crush_.touch_ball = put<int>(ball);
    crush_.touch_segment = put<int>(segment);
    crush_.touch_reach = put<double>(reach);
    crush_.touch_side = put<int>(side);
    crush_.touch_linked = zeros<int>(ball.size());
    crush_.touch_squared_depth = zeros<double>(ball.size());
    crush_.touch_stored = zeros<double>(ball.size());
    crush_.active_count = zeros<int>(balls);
    crush_.candidate_count = zeros<int>(scene_.contact.present ? balls : 0);
    crush_.candidate = room<int>(balls * on_device::kMostCandidates);
    crush_.plate_push = room<on_device::PlatePush>(balls);
    crush_.pressed = zeros<unsigned>(balls / 32 + 1);
    crush_.first_added = put<int>(std::vector<int>(balls, on_device::AddedForce::kEnd));
    crush_.added = room<on_device::AddedForce>(most_added_forces(scene_));
  }

  void put_scratch() {
    crush_.lane_works = room<double>(on_device::kWorkTerms * kSumLanes * crush_.moved.size());
    crush_.lane_plastic = room<double>(static_cast<std::size_t>(kMostWallsInBlock) *
                                       static_cast<std::size_t>(scene_.walls.chunk_count()));
    const std::size_t values = kScratchKinds * scene_.element_count();
    if (scene_.single_fibres) {
      crush_.single_scratch = room<float>(values);
    } else {
      crush_.double_scratch = room<double>(values);
    }
  }

  void put_crush() { device_.write(address_, &crush_, sizeof crush_); }

  /// The motion of the plate over the coming steps, which does not depend on the lattice.
  void put_plate_steps(std::int64_t steps) {
    std::vector<PlateStep> plates;
    for (std::int64_t k = 0; k < steps; ++k) {
      plates.push_back(plate_step_of(scene_, no_drive_, time_, totals_.impact_travel));
      totals_.impact_travel = plates.back().travel;
      time_ = static_cast<double>(++step_) * scene_.schedule.time_step;
    }
    if (crush_.plate_steps.size() < plates.size()) {
      crush_.plate_steps = room<const PlateStep>(plates.size());
      put_crush();
    }
    device_.write(const_cast<PlateStep*>(crush_.plate_steps.data()), plates.data(), plates.size() * sizeof(PlateStep));
  }

  template <class T>
  std::vector<std::remove_const_t<T>> values_of(const Array<T>& array) const {
    std::vector<std::remove_const_t<T>> values(array.size());
    if (!values.empty()) device_.read(values.data(), array.data(), values.size() * sizeof(T));
    return values;
  }

  void take_touches(const State& state, ContactLists& lists) const {
    const std::vector<int> count = values_of(crush_.touch_count);
    const std::vector<int> segment = values_of(crush_.touch_segment);
    const std::vector<double> reach = values_of(crush_.touch_reach);
    const std::vector<int> linked = values_of(crush_.touch_linked);
    const std::vector<int> side = values_of(crush_.touch_side);
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
      }
    }
    for (const double growth : state.radius_growth) lists.reach_growth = std::max(lists.reach_growth, 2.0 * growth);
  }

  Device& device_;
  const Scene& scene_;
  const State no_drive_;  ///< of plates whose speed is not controlled
  std::vector<void*> memory_;
  on_device::Crush crush_ = {};
  on_device::Totals totals_ = {};
  void* address_ = nullptr;
  int walls_ = 0;
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

std::unique_ptr<DeviceEngine> make_engine(std::unique_ptr<Device> device) {
  return std::make_unique<Engine>(std::move(device));
}

}  // namespace cellcrush
