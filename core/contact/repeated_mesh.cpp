#include "contact/repeated_mesh.h"

#include <algorithm>
#include <utility>

namespace cellcrush {
namespace {

template <class List>
void copy_elements(const List& from, int copies, List& to) {
  to.resize(from.size() * static_cast<std::size_t>(copies));
  for (int copy = 0; copy < copies; ++copy) {
    std::ranges::copy(from, to.begin() + static_cast<std::ptrdiff_t>(from.size()) * copy);
  }
}

void swap_lists(State& one, State& other) {
  std::swap(one.contacts, other.contacts);
  std::swap(one.parted, other.parted);
  std::swap(one.crossing_step, other.crossing_step);
}

int each_side_of(const Scene& scene) { return scene.repeated->first_ball / static_cast<int>(scene.particle_count()); }

}  // namespace

void begin_repeated_contacts(const Scene& scene, State& state, State& repeated) {
  const int particles = static_cast<int>(scene.particle_count());
  const int each_side = each_side_of(scene);
  const int axis = scene.period.axis;
  const std::size_t count = scene.repeated->particle_count();
  repeated.position.resize(count);
  repeated.velocity.resize(count);
  repeated.contact_force.assign(count, ContactForce());
  repeated.friction_force.assign(scene.contact.friction > 0.0 ? count : 0, Vector2::Zero());
  for (int copy = -each_side; copy <= each_side; ++copy) {
    const double offset = copy * state.sides.front().width;
    const double speed = copy * state.sides.front().speed;
    Vector2* const position = &repeated.position[static_cast<std::size_t>((copy + each_side) * particles)];
    Vector2* const velocity = &repeated.velocity[static_cast<std::size_t>((copy + each_side) * particles)];
    for (int i = 0; i < particles; ++i) {
      position[i] = state.position[i];
      position[i][axis] += offset;
      velocity[i] = state.velocity[i];
      velocity[i][axis] += speed;
    }
  }
  const int copies = 2 * each_side + 1;
  copy_elements(state.radius_growth, copies, repeated.radius_growth);
  copy_elements(state.axis, copies, repeated.axis);
  copy_elements(state.length, copies, repeated.length);
  copy_elements(state.inverse_length, copies, repeated.inverse_length);
  copy_elements(state.thickening, copies, repeated.thickening);
  copy_elements(state.thickening_slope, copies, repeated.thickening_slope);
  repeated.thickening_step = state.thickening_step;
  repeated.step = state.step;
  swap_lists(state, repeated);
}

void end_repeated_contacts(const Scene& scene, State& repeated, State& state, SideForce& on_width) {
  const int particles = static_cast<int>(scene.particle_count());
  const int each_side = each_side_of(scene);
  const int axis = scene.period.axis;
  const bool rubs = !repeated.friction_force.empty();
  for (int copy = -each_side; copy <= each_side; ++copy) {
    for (int i = 0; i < particles; ++i) {
      const auto from = static_cast<std::size_t>((copy + each_side) * particles + i);
      const ContactForce& force = repeated.contact_force[from];
      state.contact_force[i].elastic += force.elastic;
      state.contact_force[i].viscous += force.viscous;
      on_width.elastic += copy * force.elastic[axis];
      on_width.viscous += copy * force.viscous[axis];
      if (rubs) {
        state.friction_force[i] += repeated.friction_force[from];
        on_width.friction += copy * repeated.friction_force[from][axis];
      }
    }
  }
  swap_lists(state, repeated);
}

std::vector<Vector2> repeated_positions(const Scene& scene, const State& state) {
  std::vector<Vector2> places;
  places.reserve(scene.repeated->particle_count());
  const int each_side = each_side_of(scene);
  for (int copy = -each_side; copy <= each_side; ++copy) {
    for (Vector2 place : state.position) {
      place[scene.period.axis] += copy * state.sides.front().width;
      places.push_back(place);
    }
  }
  return places;
}

bool outgrows_copies(const Scene& scene, const State& state) {
  if (scene.repeated == nullptr) return false;
  const int axis = scene.period.axis;
  const auto [low, high] =
      std::ranges::minmax(state.position, {}, [axis](const Vector2& place) { return place[axis]; });
  return high[axis] - low[axis] + 2.0 * scene.greatest_radius() > (each_side_of(scene) + 1) * state.sides.front().width;
}

}  // namespace cellcrush
