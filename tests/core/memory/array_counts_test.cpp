// Whether arrays are as long as their shapes say. That none is left out of the lists the compiler sees to.
#include "scene/array_counts.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>

#include "cellcrush/presets.h"
#include "cellcrush/scene_arrays.h"
#include "cellcrush/state.h"
#include "cellcrush/tuning.h"
#include "measure/sampler.h"
#include "motion/initial_state.h"
#include "scenes/crushes.h"
#include "scenes/dynamic_frames.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// Arrays of a name, of all bands.
struct Listed {
  double entries = 0.0;   ///< by their shape, of all together
  double size = 0.0;      ///< summed
  double capacity = 0.0;  ///< summed
  double arrays = 0.0;
};

/// Those of an object that are not a few, by name.
template <class Object>
std::map<std::string, Listed> list(const Object& object, const ArrayCounts& counts) {
  std::map<std::string, Listed> out;
  visit_arrays(object, [&](const char* name, const auto& array, const Shape& shape) {
    if (shape.per != Per::few) {
      Listed& listed = out[name + (" " + std::to_string(shape.needs))];
      listed.entries = static_cast<double>(counts.entries_of(shape));
      listed.size += static_cast<double>(array.size());
      listed.capacity += static_cast<double>(array.capacity());
      listed.arrays += 1.0;
    }
  });
  return out;
}

template <class Object>
void expect_shapes(const Object& object, const ArrayCounts& counts, double share = 0.0) {
  for (const auto& [name, listed] : list(object, counts)) {
    // Offsets have an end each.
    EXPECT_NEAR(listed.size, listed.entries, listed.arrays + share * listed.entries) << name;
  }
}

/// Of a scene and what has been found to be near and to touch in one of its states.
ArrayCounts counts_with(const Scene& scene, const State& state) {
  ArrayCounts counts = counts_of(scene);
  for (const ContactLists& lists : state.contacts) {
    counts[Per::candidate] += lists.candidate_ball.size();
    counts[Per::touch] += lists.touching.count();
  }
  counts[Per::candidate_batch] = counts[Per::candidate] / kCandidateBatch;
  counts[Per::candidate_of_band] = counts[Per::candidate] / counts[Per::band];
  counts[Per::touch_of_band] = counts[Per::touch] / counts[Per::band];
  return counts;
}

struct Kind {
  const char* name;
  std::function<SceneSpec()> spec;

  friend void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
};

SceneSpec changed(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  change(spec);
  return spec;
}

SceneSpec framed(const std::function<void(FrameLattice&)>& change) {
  SceneSpec spec = scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 1e-3, 1e-2);
  change(std::get<FrameLattice>(spec.lattice));
  return spec;
}

class ArrayShapes : public testing::TestWithParam<Kind> {};

TEST_P(ArrayShapes, AreThoseOfSceneAndState) {
  const auto scene = scenes::build(GetParam().spec());
  State state = make_initial_state(*scene);
  Workspace workspace;
  advance_steps(*scene, state, workspace, 60, nullptr);
  const ArrayCounts counts = counts_with(*scene, state);
  expect_shapes(*scene, counts);
  expect_shapes(state, counts);
}

const Kind kKinds[] = {
    {"default", [] { return scenes::hexagon_specimen(8, 5); }},
    {"squares", [] { return changed([](SceneSpec& spec) {
                       spec.lattice = SquareLattice{8, 6, 4.0, 0.2};
                     }); }},
    {"papers", [] { return scenes::with_the_papers_elements(scenes::hexagon_specimen(8, 5)); }},
    {"double",
     [] {
       return changed(
           [](SceneSpec& spec) { spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision; });
     }},
    {"hardening", [] { return changed([](SceneSpec& spec) { spec.material.hardening_modulus_mpa = 700.0; }); }},
    {"friction", [] { return changed([](SceneSpec& spec) { spec.contact.friction = 0.2; }); }},
    {"rough_plates", [] { return changed([](SceneSpec& spec) { spec.plates.friction = 0.2; }); }},
    {"buckets", [] { return changed([](SceneSpec& spec) { spec.contact.search = ContactSpec::Search::buckets; }); }},
    {"short_elements", [] { return changed([](SceneSpec& spec) { spec.elements_per_wall = 12; }); }},
    {"bands", [] { return scenes::with_the_papers_elements(scenes::hexagon_specimen(10, 1000)); }},
    {"rigid_bodies", [] { return find_preset("inclusions-2")->spec; }},
    {"loaded", [] { return framed([](FrameLattice&) {}); }},
    {"moving",
     [] {
       return framed([](FrameLattice& frame) {
         frame.loads.clear();
         frame.initial_velocities.push_back({1, 0.0, 1.0, 0.0});
       });
     }},
};

INSTANTIATE_TEST_SUITE_P(Kinds, ArrayShapes, testing::ValuesIn(kKinds),
                         [](const auto& test) { return std::string(test.param.name); });

/// A crushed specimen of one band, and the room that its steps have made.
TEST(ArrayCounts, AreThoseOfTheWorkspaceAndOfWhatIsMeasured) {
  SceneSpec spec = scenes::hexagon_specimen(12, 10);
  spec.contact.friction = 0.2;
  spec.loading.speed_m_per_s = 300.0;
  const auto scene = scenes::build(spec);
  State state = make_initial_state(*scene);
  Workspace workspace;
  advance_steps(*scene, state, workspace, scene->schedule.step_count, nullptr);
  const ArrayCounts counts = counts_with(*scene, state);
  ASSERT_GT(counts[Per::touch], 100U);
  for (const auto& [name, listed] : list(workspace, counts)) {
    EXPECT_GE(listed.capacity, 0.95 * listed.entries - 2.0) << name;
    EXPECT_LE(listed.capacity, 1.5 * listed.entries + 2.0) << name;
  }
  FieldFrame frame;
  make_frame(*scene, state, 0, frame);
  expect_shapes(frame, counts);
  const Cells cells = find_cells(*scene);
  expect_shapes(cells.faces, counts, 0.15);  // the border is no cell's
  expect_shapes(cells.field, counts);
  expect_shapes(divide_into_columns(*scene, cells.field.pitch), counts);
}

/// What is expected of a mesh before its faces are traced.
TEST(ArrayCounts, OfFacesAreBoundedByTheMesh) {
  const auto scene = scenes::build(scenes::hexagon_specimen(20, 15));
  const ArrayCounts traced = counts_of(*scene);
  ArrayCounts expected = count_mesh(*scene);
  add_contact(scene->contact, scene->plates, expected);
  add_expected_faces(expected);
  EXPECT_EQ(expected.has, traced.has);
  EXPECT_EQ(expected[Per::face], traced[Per::face]);
  EXPECT_EQ(expected[Per::corner], traced[Per::corner]);
  EXPECT_GE(expected[Per::face_group], traced[Per::face_group]);
  EXPECT_GE(expected[Per::group_member], traced[Per::group_member]);
}

}  // namespace
}  // namespace cellcrush
