#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "contact/contact_forces.h"
#include "contact/contact_search.h"
#include "contact/search/pair_search.h"
#include "motion/initial_state.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/near_pairs.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

using scenes::FaceNeighbours;
using scenes::listed_pairs;
using scenes::Pairs;

const std::pair<const char*, RegularLattice> kLattices[] = {{"hexagon", scenes::hexagons(5, 4, 4.0, 0.3464, 0.3464)},
                                                            {"square", scenes::squares(6, 5, 4.0, 0.2)},
                                                            {"triangle", scenes::triangles(6, 5, 4.0, 0.12)},
                                                            {"thick ends", scenes::hexagons(5, 4, 4.0, 0.15, 0.4)}};

std::shared_ptr<Scene> block_of(const RegularLattice& lattice) {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.lattice = lattice;
  spec.elements_per_wall = 2;  // brute force takes the square of their number
  return scenes::build(spec);
}

/// Shears and squeezes: what they map is as planar as before, as far as walls stay straight.
class PlanarMap {
 public:
  explicit PlanarMap(std::mt19937& generator) {
    std::uniform_real_distribution<double> even(0.0, 1.0);
    squeeze_ = {0.05 + 0.6 * even(generator), 0.3 + 0.7 * even(generator)};
    for (double& number : numbers_) {
      number = even(generator);
    }
  }

  [[nodiscard]] Vector2 operator()(const Vector2& point) const {
    Vector2 mapped = squeeze_.cwiseProduct(point);
    mapped.x() += 2.0 * numbers_[0] * std::sin(0.4 * numbers_[1] * mapped.y() + 6.0 * numbers_[2]);
    mapped.y() += 2.0 * numbers_[3] * std::sin(0.4 * numbers_[4] * mapped.x() + 6.0 * numbers_[5]);
    return mapped;
  }

 private:
  Vector2 squeeze_;
  double numbers_[6] = {};
};

Pairs that_share_a_face(const Pairs& pairs, const FaceNeighbours& neighbours) {
  Pairs result;
  for (const auto& [ball, segment] : pairs) {
    if (neighbours.share_a_face(ball, segment)) {
      result.emplace(ball, segment);
    }
  }
  return result;
}

bool includes(const Pairs& all, const Pairs& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

// All that is within the skin is listed, but what shares no face; nothing is that is farther than the widest skin. The
// lists do not depend on the processor.
TEST(FaceSearch, AgreesWithBruteForceOnRandomPlanarStates) {
  for (const auto& [lattice, cells] : kLattices) {
    const auto scene = block_of(cells);
    ASSERT_TRUE(scene->faces.are_enough());
    const FaceNeighbours neighbours(*scene);
    std::mt19937 generator(5);
    std::size_t most = 0;
    int planar = 0;
    Workers workers(1);
    for (int round = 0; round < 40; ++round) {
      State state = place_particles(*scene);
      const PlanarMap map(generator);
      for (Vector2& position : state.position) {
        position = map(position);
      }
      if (!scenes::find_crossings(*scene, state).empty()) {
        continue;
      }
      ++planar;
      scenes::follow_positions(*scene, state);
      const State before = state;
      find_contacts(*scene, state, workers);
      ASSERT_LT(state.crossing_step, 0) << lattice << round;
      const Pairs listed = listed_pairs(state);
      scenes::for_every_target([&] {
        State on_target = before;
        find_contacts(*scene, on_target, workers);
        EXPECT_EQ(listed_pairs(on_target), listed);
        EXPECT_EQ(on_target.contacts.front().face_clearance, state.contacts.front().face_clearance);
      });
      const double skin = scene->contact.face_skin;
      EXPECT_TRUE(includes(listed, that_share_a_face(scenes::near_pairs(*scene, state, skin), neighbours))) << lattice;
      EXPECT_TRUE(includes(scenes::near_pairs(*scene, state, 4.0 * skin), listed)) << lattice;
      EXPECT_EQ(that_share_a_face(listed, neighbours), listed) << lattice;
      most = std::max(most, listed.size());
    }
    EXPECT_GT(planar, 10) << lattice;
    EXPECT_GT(most, 300u) << lattice;
  }
}

/// The pairs that push or could.
Pairs touching_pairs(const State& state) {
  Pairs pairs;
  const TouchMemory& touching = state.contacts.front().touching;
  for (std::size_t i = 0; i < touching.count(); ++i) {
    if (touching.side[i] != 0) {
      EXPECT_TRUE(pairs.emplace(touching.ball[i], touching.segment[i]).second) << "touches twice";
    }
  }
  EXPECT_EQ(pairs.size() + state.contacts.front().released.size(), touching.count());
  return pairs;
}

// The particles are thrown about at random round a lattice that is squeezed flat and drawn out again, faster and
// slower, with rests and with steps as long as the skin: no pair of a face may touch that is not listed and found in
// the very step.
TEST(FaceSearch, MissesNoTouchUnderRandomKicks) {
  for (const auto& [lattice, cells] : kLattices) {
    const auto scene = block_of(cells);
    const double step = scene->schedule.time_step;
    const FaceNeighbours neighbours(*scene);
    State state = make_initial_state(*scene);
    ContactWorkspace workspace;
    Workers workers(1);
    std::mt19937 generator(17);
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    double squeeze = 1.0;
    double rate = 0.0;
    std::size_t touches = 0;
    for (int i = 0; i < 1200; ++i) {
      if (i % 25 == 0) {
        rate = (i / 300 % 2 == 0 ? -1.0 : 1.0) * 0.0045 * (1.0 + even(generator));
      }
      squeeze = std::clamp(squeeze + rate, 0.04, 1.0);
      const double kick = i / 50 % 3 == 2 ? 0.0 : 0.02;
      const bool along_y = lattice == std::string("thick ends");  // so that they meet
      const Vector2 squeezed = along_y ? Vector2(1.0, squeeze) : Vector2(squeeze, 1.0);
      for (std::size_t p = 0; p < scene->particle_count(); ++p) {
        const Vector2 target =
            squeezed.cwiseProduct(scene->position[p]) + kick * squeeze * Vector2(even(generator), even(generator));
        state.velocity[p] = (target - state.position[p]) / step;
        state.position[p] = target;
      }
      ++state.step;
      scenes::follow_positions(*scene, state);
      find_contacts(*scene, state, workers);
      ASSERT_LT(state.crossing_step, 0) << lattice << " at " << squeeze;
      scenes::evaluate_wall_contacts(*scene, state, workspace, workers);
      const Pairs listed = listed_pairs(state);
      const Pairs touching = touching_pairs(state);
      for (const scenes::Overlap& overlap : scenes::overlaps_by_buckets(*scene, state)) {
        if (overlap.depth > 1e-9 && neighbours.share_a_face(overlap.ball, overlap.segment)) {
          ++touches;
          ASSERT_TRUE(listed.count({overlap.ball, overlap.segment}) == 1) << lattice << " in step " << i;
          ASSERT_TRUE(touching.count({overlap.ball, overlap.segment}) == 1) << lattice << " in step " << i;
        }
      }
    }
    EXPECT_GT(touches, 10000u) << lattice;
    // Many faces sleep: the test would be empty if all were searched in every step.
    EXPECT_LT(state.contacts.front().face_search_count, 1200 * scene->faces.bands.front().count() * 2 / 3) << lattice;
  }
}

TEST(FaceSearch, GivesTheSameBitsAsBucketsWhileAllThatTouchesSharesAFace) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.contact.friction = 0.2;
  const State by_faces = scenes::state_after(*scenes::build(spec), 1200);
  spec.contact.search = ContactSpec::Search::buckets;
  const State by_buckets = scenes::state_after(*scenes::build(spec), 1200);
  ASSERT_GT(by_faces.contact_totals.count, 10);
  EXPECT_TRUE(by_buckets.contacts.front().face_list.empty());
  EXPECT_GT(by_buckets.contacts.front().search_count, 5);
  EXPECT_EQ(by_faces.contacts.front().search_count, 0);
  EXPECT_TRUE(by_faces.position == by_buckets.position);
  EXPECT_TRUE(by_faces.velocity == by_buckets.velocity);
  EXPECT_TRUE(by_faces.friction_force == by_buckets.friction_force);
}

// Told of a change in the middle of a crush, the search begins again, by the faces or, where these are no longer
// enough, by buckets. As no wall has changed here, forces keep their bits.
TEST(FaceSearch, BeginsAgainWhenToldThatWallsHaveChanged) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.contact.friction = 0.2;
  const auto scene = scenes::build(spec);
  Scene without_faces = *scene;
  without_faces.faces = {};
  without_faces.faces.premise = ContactFaces::Premise::several_parts;
  State state = scenes::state_after(*scene, 1000);
  ASSERT_GT(state.contact_totals.count, 10);
  State by_faces = state;
  State by_buckets = state;
  change_topology(*scene, by_faces, TopologyChange::walls_changed, state.step);
  change_topology(without_faces, by_buckets, TopologyChange::walls_changed, state.step);
  EXPECT_TRUE(searches_faces(*scene, by_faces));
  EXPECT_EQ(by_buckets.contacts.front().search_count, 1);
  for (int i = 0; i < 200; ++i) {
    advance_step(*scene, state, nullptr);
    advance_step(*scene, by_faces, nullptr);
    advance_step(without_faces, by_buckets, nullptr);
  }
  EXPECT_GT(by_faces.contacts.front().candidate_count, 100);
  for (const State* told : {&by_faces, &by_buckets}) {
    EXPECT_TRUE(told->position == state.position);
    EXPECT_TRUE(told->friction_force == state.friction_force);
    EXPECT_LT(told->crossing_step, 0);
  }
}

// A joint that has merged into the end of a segment no longer touches it.
TEST(FaceSearch, ReleasesPairsWhoseBallHasBecomeAnEndOfTheirSegment) {
  const auto scene = scenes::build(scenes::hexagon_specimen(8, 5));
  State state = make_initial_state(*scene);
  while (state.contact_totals.count == 0) {
    advance_step(*scene, state, nullptr);
  }
  const TouchMemory& touching = state.contacts.front().touching;
  Scene merged = *scene;
  merged.elements[touching.segment.front()].end = touching.ball.front();
  change_topology(merged, state, TopologyChange::walls_changed, state.step);
  EXPECT_EQ(touching.side.front(), 0);
  EXPECT_EQ(state.contacts.front().released.front(), 0);
}

/// Moves one particle straight to `goal` in `steps`, all others standing.
void move_one(const Scene& scene, State& state, int particle, const Vector2& goal, int steps) {
  std::fill(state.velocity.begin(), state.velocity.end(), Vector2::Zero());
  const Vector2 way = (goal - state.position[particle]) / steps;
  state.velocity[particle] = way / scene.schedule.time_step;
  Workers workers(1);
  for (int i = 0; i < steps; ++i) {
    state.position[particle] += way;
    ++state.step;
    scenes::follow_positions(scene, state);
    find_contacts(scene, state, workers);
  }
}

TEST(FaceSearch, GoesOverToBucketsWhenAWallHasCrossedAnother) {
  const auto scene = scenes::build(scenes::hexagon_specimen(5, 4));
  State state = make_initial_state(*scene);
  const FacesOfBand& faces = scene->faces.bands.front();
  const int inner = faces.particle[faces.offset[faces.count() / 2]];
  const Vector2 place = state.position[inner];
  move_one(*scene, state, inner, place + Vector2(1.0, 0.7), 100);
  EXPECT_TRUE(scenes::find_crossings(*scene, state).empty());
  EXPECT_LT(state.crossing_step, 0);

  move_one(*scene, state, inner, place + Vector2(9.0, 6.0), 400);
  EXPECT_FALSE(scenes::find_crossings(*scene, state).empty());
  EXPECT_GT(state.crossing_step, 100);
  EXPECT_GT(state.contacts.front().search_count, 0);
  const Pairs listed = listed_pairs(state);
  for (const scenes::Overlap& overlap : scenes::overlaps_by_buckets(*scene, state)) {
    EXPECT_EQ(listed.count({overlap.ball, overlap.segment}), 1u);
  }
}

// A triangle of three elements: none of them crosses another when it is turned over.
TEST(FaceSearch, GoesOverToBucketsWhenAFaceIsTurnedInsideOut) {
  const auto scene = scenes::build(
      scenes::elastic_frame(scenes::touching_beams({{0, 0}, {20, 0}, {10, 15}}, {{0, 1}, {1, 2}, {2, 0}}, 1.0, 1)));
  ASSERT_TRUE(scene->faces.are_enough());
  State state = make_initial_state(*scene);
  move_one(*scene, state, 2, {10.0, -15.0}, 1000);
  EXPECT_TRUE(scenes::find_crossings(*scene, state).empty());
  EXPECT_GT(state.crossing_step, 500);  // half way, and before the node is beyond reach
  EXPECT_LT(state.crossing_step, 600);
}

TEST(FaceSearch, LeavesTheListsAsTheyAreAfterAPositionThatIsNotFinite) {
  const auto scene = scenes::build(scenes::hexagon_specimen(5, 4));
  State state = make_initial_state(*scene);
  Workers workers(1);
  for (const double lost : {std::nan(""), HUGE_VAL}) {
    State spoiled = state;
    spoiled.velocity[30] = {lost, 0.0};
    spoiled.position[30] = {lost, lost};
    scenes::follow_positions(*scene, spoiled);
    find_contacts(*scene, spoiled, workers);
    find_contacts(*scene, spoiled, workers);
    EXPECT_EQ(spoiled.contacts.front().candidate_count, 0);
    EXPECT_LT(spoiled.crossing_step, 0);
    EXPECT_EQ(spoiled.contacts.front().face_search_count, state.contacts.front().face_search_count);
  }
}

// Two beams side by side; then an end of one is moved through the other.
TEST(ContactSearch, FindsThatAWallHasCrossedAnother) {
  const auto scene = scenes::build(
      scenes::elastic_frame(scenes::touching_beams({{0, 0}, {20, 0}, {10, 2}, {10, 20}}, {{0, 1}, {2, 3}}, 1.0, 1)));
  ASSERT_FALSE(scene->faces.are_enough());
  State state = make_initial_state(*scene);
  Workers workers(1);
  const auto move_to = [&](double height) {
    state.position[2] = {10.0, height};
    scenes::follow_positions(*scene, state);
  };
  move_to(-0.5);
  find_contacts(*scene, state, workers);
  EXPECT_LT(state.crossing_step, 0) << "the list holds";
  move_to(15.0);
  find_contacts(*scene, state, workers);
  EXPECT_LT(state.crossing_step, 0);
  move_to(-0.5);
  state.step = 7;
  find_contacts(*scene, state, workers);
  EXPECT_EQ(state.crossing_step, 7);
}

// Walls of a lattice thrown about at random: sparse and dense, round the origin and far from it, in a line, on one
// point. Where one particle flies away, the buckets must not grow with the distance, nor lose the rest.
TEST(ContactSearch, AgreesWithBruteForceOnRandomScenes) {
  const auto scene = scenes::build(scenes::hexagon_specimen(4, 4));
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  std::size_t most = 0;
  const auto expect_all = [&](State& state) {
    scenes::follow_positions(*scene, state);
    list_by_buckets(*scene, state, state.contacts.front());
    const Pairs near = scenes::near_pairs(*scene, state, scene->contact.skin);
    EXPECT_EQ(listed_pairs(state), near);
    most = std::max(most, near.size());
  };
  for (const Vector2& middle : {Vector2(0.0, 0.0), Vector2(-3e3, 7e2), Vector2(-1e6, -1e6)}) {
    for (const Vector2& spread : {Vector2(300.0, 300.0), Vector2(30.0, 30.0), Vector2(4.0, 4.0), Vector2(0.1, 0.1),
                                  Vector2(50.0, 0.0), Vector2(0.0, 20.0), Vector2(1e4, 1.0), Vector2(0.0, 0.0)}) {
      SCOPED_TRACE(testing::Message() << middle.transpose() << " spread " << spread.transpose());
      State state = place_particles(*scene);
      for (Vector2& position : state.position) {
        position = middle + spread.cwiseProduct(Vector2(even(generator), even(generator)));
      }
      expect_all(state);
    }
  }
  EXPECT_EQ(most, scene->element_count() * (scene->particle_count() - 2));  // on one point, all
  State state = place_particles(*scene);
  state.position[7] = {4e7, -2e7};
  expect_all(state);
}

}  // namespace
}  // namespace cellcrush
