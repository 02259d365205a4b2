#include "contact/plate_forces.h"

#include <algorithm>
#include <span>

#include "contact/friction.h"
#include "contact/normal_force.h"
#include "contact/wide_plates.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// One of the two plates as it is now.
struct Plate {
  double face;       ///< mm
  double velocity;   ///< mm/s
  double outward;    ///< +1 or -1: from its face into the lattice, along the crush
  PlateForce& sum;   ///< of its forces on all particles
  double* friction;  ///< of each particle; null without friction
};

/// Pushes one particle; the plates do not move across the crush, so its slip is its own motion there.
void push(const Scene& scene, State& state, const Plate& plate, std::size_t particle) {
  const int axis = scene.plates.axis;
  const double depth = scene.radius[particle] - plate.outward * (state.position[particle][axis] - plate.face);
  NormalForce force = {0.0, 0.0};
  if (depth > 0.0) {
    const double rate = plate.outward * (plate.velocity - state.velocity[particle][axis]);
    force = evaluate_normal_force(scene.plates.stiffness, scene.contact.damping_ratio, 1.0 / scene.mass[particle],
                                  depth, rate);
    state.contact_stored += 0.5 * force.elastic * depth;
    state.contact_force[particle].elastic[axis] += plate.outward * force.elastic;
    state.contact_force[particle].viscous[axis] += plate.outward * force.viscous;
    plate.sum.elastic += force.elastic;
    plate.sum.viscous += force.viscous;
  }
  if (plate.friction != nullptr && (depth > 0.0 || plate.friction[particle] != 0.0)) {
    const double slip = scene.schedule.time_step * state.velocity[particle][1 - axis];
    double& friction = plate.friction[particle];
    friction = evaluate_friction(friction, scene.plates.stiffness, slip,
                                 scene.plates.friction * (force.elastic + force.viscous));
    state.friction_force[particle][1 - axis] += friction;
  }
}

std::size_t find_near_plates_plain(const Scene& scene, const State& state, const PlateFaces& faces, std::size_t first,
                                   std::size_t end, int* near) {
  std::size_t count = 0;
  const bool rubs = !state.impact_friction.empty();
  for (std::size_t i = first; i < end; ++i) {
    const double place = state.position[i][scene.plates.axis];
    const bool reaches = place - scene.radius[i] < faces.impact || place + scene.radius[i] > faces.support;
    near[count] = static_cast<int>(i);
    count += reaches || (rubs && (state.impact_friction[i] != 0.0 || state.support_friction[i] != 0.0)) ? 1 : 0;
  }
  return count;
}

/// The particles that a plate may act on, ascending: each thread writes behind where its particles begin, then the parts are
/// moved together.
std::span<const int> find_near_plates(const Scene& scene, const State& state, const PlateFaces& faces,
                                      ContactWorkspace& workspace, Workers& workers) {
  const auto find_near = use_wide_kernels() ? find_near_plates_wide : find_near_plates_plain;
  std::vector<int>& near = workspace.near_plates;
  near.resize(scene.particle_count());  // once: it keeps its size
  workspace.parts.resize(static_cast<std::size_t>(workers.count()));
  workers.share_parts(near.size(), kCandidateBatch, [&](std::size_t part, std::size_t first, std::size_t end) {
    workspace.parts[part].near_plates = {first, find_near(scene, state, faces, first, end, near.data() + first)};
  });
  auto last = near.begin();
  for (const ContactPart& part : workspace.parts) {
    const auto first = near.begin() + static_cast<std::ptrdiff_t>(part.near_plates.first);
    last = std::copy(first, first + static_cast<std::ptrdiff_t>(part.near_plates.count), last);
  }
  return {near.begin(), last};
}

}  // namespace

void evaluate_plate_forces(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers) {
  const Plates& plates = scene.plates;
  if (!plates.present) {
    return;
  }
  state.impact_force = {};
  state.support_force = {};
  const bool rubs = plates.friction > 0.0;
  const Plate impact = {plates.impact_face + state.impact_travel,
                        plates.speed_at(state.time - 0.5 * scene.schedule.time_step), 1.0, state.impact_force,
                        rubs ? state.impact_friction.data() : nullptr};
  const Plate support = {plates.support_face, 0.0, -1.0, state.support_force,
                         rubs ? state.support_friction.data() : nullptr};
  for (const int particle : find_near_plates(scene, state, {impact.face, support.face}, workspace, workers)) {
    push(scene, state, impact, static_cast<std::size_t>(particle));
    push(scene, state, support, static_cast<std::size_t>(particle));
  }
}

}  // namespace cellcrush
