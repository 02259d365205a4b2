#include "motion/periodic_sides.h"

namespace cellcrush {
namespace {

Vector2 force_on(const State& state, int joint) {
  Vector2 force =
      state.internal_force[joint] + (state.contact_force[joint].elastic + state.contact_force[joint].viscous);
  if (!state.friction_force.empty()) force += state.friction_force[joint];
  if (!state.load_force.empty()) force += state.load_force[joint];
  return force;
}

double speed_of(const Scene& scene, const State& state) {
  const Period& period = scene.period;
  return period.is_fixed ? 0.0
                         : (state.velocity[period.high.front()] - state.velocity[period.low.front()])[period.axis];
}

MotionWorks works_over(const SideForce& force, double way) {
  return {.contact = -force.elastic * way, .contact_damping = -force.viscous * way, .friction = -force.friction * way};
}

void share_moment(const Scene& scene, int low, int high, State& state) {
  const double inertia = scene.inertia[low] + scene.inertia[high];
  if (inertia == 0.0) return;
  const double turning = (state.internal_moment[low] + state.internal_moment[high]) / inertia;
  for (const int joint : {low, high}) state.internal_moment[joint] = scene.inertia[joint] * turning;
}

}  // namespace

void tie_sides(const Scene& scene, const SideForce& on_width, State& state) {
  const Period& period = scene.period;
  if (!period.repeats()) return;
  const std::size_t count = period.low.size();
  double force = on_width.total();
  double mass = 0.0;
  for (std::size_t p = 0; p < count; ++p) {
    const double of_low = scene.mass[period.low[p]];
    const double of_high = scene.mass[period.high[p]];
    force += (of_low * force_on(state, period.high[p])[period.axis] -
              of_high * force_on(state, period.low[p])[period.axis]) /
             (of_low + of_high);
    mass += of_low * of_high / (of_low + of_high);
  }
  const double widening = period.is_fixed ? 0.0 : force / mass;  // mm/s^2
  for (std::size_t p = 0; p < count; ++p) {
    const int low = period.low[p];
    const int high = period.high[p];
    const Vector2 on_low = force_on(state, low);
    const Vector2 on_high = force_on(state, high);
    const double together = scene.mass[low] + scene.mass[high];
    Vector2 acceleration = (on_low + on_high) / together;
    acceleration[period.axis] -= scene.mass[high] / together * widening;
    state.internal_force[low] += scene.mass[low] * acceleration - on_low;
    acceleration[period.axis] += widening;
    state.internal_force[high] += scene.mass[high] * acceleration - on_high;
    share_moment(scene, low, high, state);
  }
}

void move_sides(const Scene& scene, State& state) {
  const Period& period = scene.period;
  if (!period.repeats()) return;
  SidesMotion& sides = state.sides.front();
  const double step = scene.schedule.time_step;
  const double before = sides.speed;
  sides.speed = speed_of(scene, state);
  sides.way = 0.5 * step * (before + sides.speed);
  sides.width += step * sides.speed;
  for (std::size_t p = 0; p < period.low.size(); ++p) {
    const int low = period.low[p];
    const int high = period.high[p];
    state.velocity[high] = state.velocity[low];
    state.velocity[high][period.axis] += sides.speed;
    state.position[high] = state.position[low];
    state.position[high][period.axis] += sides.width;
    state.spin[high] = state.spin[low];
    state.rotation[high] = state.rotation[low];
  }
}

void stagger_sides(const Scene& scene, State& state) {
  if (scene.period.repeats()) state.sides.front().speed = speed_of(scene, state);
}

MotionWorks works_of_sides(const State& state) {
  return state.sides.empty() ? MotionWorks() : works_over(state.side_force.front(), state.sides.front().way);
}

MotionWorks half_step_works_of_sides(const Scene& scene, const State& state) {
  if (state.sides.empty()) return {};
  return works_over(state.side_force.front(), 0.5 * scene.schedule.time_step * state.sides.front().speed);
}

}  // namespace cellcrush
