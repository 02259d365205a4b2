#include "contact/thickening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>

#include "beam/internal_forces.h"
#include "contact/contact_tiles.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "scenes/small_specimen.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// Thick squares, squashed at 200 m/s, with contacts that lose nothing.
SceneSpec squashed_squares(MaterialSpec::Plane plane) {
  SceneSpec spec = scenes::spec_of({"square", 200.0, 0.3}, 5, 4);
  scenes::cells_of(spec).wall_thickness_mm = 0.5;
  spec.elements_per_wall = 4;
  spec.material.plane = plane;
  spec.contact.damping_ratio = 0.0;
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

/// Contacts of a state whose particles have been moved by hand.
class MovedContacts {
 public:
  MovedContacts(const Scene& scene, const State& state) : scene_(scene), base_(state) {}

  /// With one particle moved by `way`.
  const State& with(std::size_t particle, const Vector2& way) {
    moved_ = base_;
    moved_.position[particle] += way;
    size_thickening_step(scene_, moved_);
    deform_walls(scene_, moved_, walls_, workers_);
    clear_contact_forces(moved_, 0, static_cast<int>(scene_.particle_count()));
    scenes::evaluate_wall_contacts(scene_, moved_, contact_, workers_);
    return moved_;
  }

 private:
  const Scene& scene_;
  const State& base_;
  State moved_;
  WallsWorkspace walls_;
  ContactWorkspace contact_;
  Workers workers_{1};
};

bool has_grown(const State& state, const TouchMemory& touching, std::size_t t, const Element& segment) {
  return state.radius_growth[touching.ball[t]] > 0.0 || state.radius_growth[segment.start] > 0.0 ||
         state.radius_growth[segment.end] > 0.0;
}

// Blind to: plates, friction and the viscous force.
TEST(Thickening, ForcesOfContactsAreTheGradientOfTheirEnergyWhileWallsGrow) {
  double worst = 0.0;
  for (const auto plane : {MaterialSpec::Plane::stress, MaterialSpec::Plane::strain}) {
    const auto scene = scenes::build(squashed_squares(plane));
    State state = make_initial_state(*scene);
    for (int n = 0; n < 1200; ++n) {
      advance_step(*scene, state, nullptr);
    }
    const TouchMemory& touching = state.contacts.front().touching;
    std::size_t grown = 0;
    for (std::size_t t = 0; t < touching.count(); ++t) {
      grown += has_grown(state, touching, t, scene->elements[touching.segment[t]]) ? 1 : 0;
    }
    EXPECT_GT(grown, 5U) << "of " << touching.count();
    MovedContacts contacts(*scene, state);
    const std::vector<ContactForce> forces = [&] {
      const State& still = contacts.with(0, Vector2::Zero());
      return std::vector<ContactForce>(still.contact_force.begin(), still.contact_force.end());
    }();
    double largest = 0.0;
    for (const ContactForce& force : forces) {
      largest = std::max(largest, force.elastic.norm());
    }
    constexpr double kWay = 1e-7;  // mm
    for (std::size_t i = 0; i < forces.size(); ++i) {
      for (const Vector2& along : {Vector2(Vector2::UnitX()), Vector2(Vector2::UnitY())}) {
        const double ahead = contacts.with(i, kWay * along).contact_totals.stored;
        const double behind = contacts.with(i, -kWay * along).contact_totals.stored;
        worst = std::max(worst, std::abs(forces[i].elastic.dot(along) + (ahead - behind) / (2.0 * kWay)) / largest);
      }
    }
  }
  EXPECT_LT(worst, 1e-4);
  scenes::record_bound("difference over the largest force", worst);
}

}  // namespace
}  // namespace cellcrush
