#include "translate/case_words.h"

#include <gmock/gmock.h>

#include "programs/text_proto.h"

namespace cellcrush {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

v1::CaseWords words_of_case(const std::string& text) {
  v1::Job job;
  *job.mutable_case_() = testing::from_text<v1::Case>(text);
  translate::add_words(job);
  return job.words();
}

std::vector<std::string> facts_of(const v1::CaseWords& words) {
  std::vector<std::string> out;
  for (const auto& fact : words.facts()) out.push_back(fact.heading() + ": " + fact.text());
  return out;
}

TEST(CaseWords, DescribeAFrameByItsParts) {
  const auto words = words_of_case(R"(
    lattice { frame {
      nodes { id: "wall" } nodes { id: "elbow" y_mm: 50 attached_mass_g: 3 } nodes { id: "tip" x_mm: 50 y_mm: 50 }
      beams { start: "wall" end: "elbow" thickness_mm: 1 } beams { start: "elbow" end: "tip" thickness_mm: 0.5 }
      supports { node: "wall" fix_x: true fix_y: true fix_rotation: true }
      loads { node: "tip" component: COMPONENT_Y force_n_or_n_mm { points { time_s: 0 value: -1 } } }
      motions { node: "elbow" component: COMPONENT_ROTATION }
      initial_velocities { node: "tip" x_m_per_s: 2 }
      gravity_y_m_per_s2: -9.81
      watched_nodes: "tip" watched_nodes: "elbow"
      end_time_s: 0.02
    } }
    depth_mm: 5)");
  EXPECT_EQ(words.lattice(), "frame of 3 nodes and 2 beams");
  EXPECT_EQ(words.loading(), "loaded for 0.02 s");
  EXPECT_EQ(words.theory_note(), "");
  EXPECT_FALSE(words.plates());
  EXPECT_THAT(facts_of(words),
              ::testing::ElementsAre("beams: 2, 0.5 to 1 mm thick", "supports: wall (x y rotation)",
                                     "attached masses: on 1 node", "forces and moments: tip (y)",
                                     "prescribed motion: elbow (rotation)", "initial velocities: tip",
                                     "contact between beams: ignored", "watched nodes: tip, elbow",
                                     "gravity: 0 m/s2 along x, -9.81 m/s2 along y", "end time: 0.02 s", "depth: 5 mm"));
}

TEST(CaseWords, CutLongListsAndCountTheRest) {
  const auto words =
      words_of_case(R"(lattice { frame { watched_nodes: ["n0", "n1", "n2", "n3", "n4", "n5", "n6", "n7", "n8"] } })");
  EXPECT_THAT(facts_of(words), IsSupersetOf({"watched nodes: n0, n1, n2, n3, n4, n5 and 3 more", "supports: none"}));
}

TEST(CaseWords, DescribeRegularLattices) {
  struct Row {
    const char* text;
    std::vector<std::string> facts;
  };
  const Row rows[] = {
      {"lattice { voronoi { columns: 20 rows: 12 side_mm: 5 irregularity: 0.6 seed: 4 relative_density: 0.1 } }",
       {"cells: 20 x 12, of regular ones 5 mm a side", "nuclei: irregularity 0.6, seed 4",
        "walls: relative density 0.1"}},
      {"lattice { square { columns: 20 rows: 12 side_mm: 5 wall_thickness_mm: 0.2 } defects { missing_walls: 0.05 } "
       "grading { axis: Y thickness_steps: [1, 1.5] } rotation_degrees: 45 outline { corners_mm: [0, 0, 50, 40] } }",
       {"defects: 5 % of the walls missing, seed 0", "grading: along y, thickness by steps 1, 1.5",
        "rotation: 45 degrees", "outline: a rectangle"}},
      {"lattice { square { columns: 20 rows: 12 side_mm: 5 wall_thickness_mm: 0.2 } }",
       {"squares: 20 x 12 cells", "walls: 5 mm long, 0.2 mm thick"}},
      {"lattice { triangle { columns: 74 rows: 21 side_mm: 6.918918918918919 wall_thickness_mm: 0.20500756756756758 } "
       "imperfection { amplitude_mm: 0.01 bow_mm: 0.02 seed: 4 } }",
       {"triangles: 74 x 21 cells", "walls: 6.91892 mm long, 0.205008 mm thick",
        "imperfection: joints displaced by up to 0.01 mm, walls bowed by up to 0.02 mm, seed 4"}},
      {"lattice { hexagon { columns: 8 rows: 9 side_mm: 5 wall_thickness_mm: 0.2 vertical_wall_thickness_mm: 0.4 } "
       "inclusions { rows: 3 rows: 6 thickness_factor: 4 } } elements_per_wall: 2 contact { friction: 0.3 } "
       "material { youngs_modulus_mpa: 68000 yield_stress_mpa: 130 hardening_modulus_mpa: 680 isotropic_fraction: .5 "
       "density_kg_per_m3: 2700 plane: PLANE_STRAIN }",
       {"walls: 5 mm long, 0.2 mm thick; vertical wall thickness 0.4 mm", "elements per wall: 2",
        "inclusions: stiff cells in rows 3, 6, walls 4 times as thick, rigid", "friction between walls: 0.3",
        "material: E 68000 MPa, yield 130 MPa, hardening 680 MPa, isotropic fraction 0.5, 2700 kg/m3, plane strain"}},
      {"material { youngs_modulus_mpa: 68000 yield_stress_mpa: 130 density_kg_per_m3: 2700 plane: STRIP }",
       {"material: E 68000 MPa, yield 130 MPa, 2700 kg/m3, strip"}},
      {"", {}}};
  for (const Row& row : rows) EXPECT_THAT(facts_of(words_of_case(row.text)), IsSupersetOf(row.facts)) << row.text;
}

TEST(CaseWords, SayHowTheCaseIsLoadedAndWhereTheoryDoesNotApply) {
  const auto hexagons = words_of_case(
      "lattice { hexagon { columns: 74 rows: 21 } } loading { direction: Y speed_m_per_s: 100 end_strain: 0.8 }");
  EXPECT_EQ(hexagons.lattice(), "hexagons, 74 x 21 cells");
  EXPECT_EQ(hexagons.loading(), "crushed along Y at 100 m/s to strain 0.8");
  EXPECT_EQ(hexagons.theory_note(), "");
  EXPECT_TRUE(hexagons.plates());
  EXPECT_TRUE(words_of_case("lattice { frame {} } loading { speed_m_per_s: 1 }").plates());
  EXPECT_THAT(words_of_case("lattice { square {} }").theory_note(), HasSubstr("Squares are stretch-dominated: "));
  EXPECT_THAT(words_of_case("lattice { triangle {} }").theory_note(), HasSubstr("Triangles are stretch-dominated: "));
  EXPECT_EQ(words_of_case("lattice { hexagon {} inclusions { rows: 2 } }").theory_note(),
            "The theory ignores the stiff cells.");
}

TEST(CaseWords, DescribeTheLoadingOfAnyLatticeAndWhereTheRunEnds) {
  const auto struck = words_of_case(R"(
    lattice { hexagon { columns: 8 rows: 9 } }
    loading {
      end_time_s: 0.02 end_at_rest: 0.001 gravity_y_m_per_s2: -9.81
      rigid_walls { id: "floor" } rigid_walls { id: "hammer" mass_g: 3 speed_m_per_s: 2 }
      rigid_walls { id: "ram" displacement_mm { points { time_s: 0 value: 1 } } }
    })");
  EXPECT_FALSE(struck.plates());
  EXPECT_EQ(struck.loading(), "loaded for 0.02 s, or until at rest");
  EXPECT_THAT(facts_of(struck),
              IsSupersetOf({"gravity: 0 m/s2 along x, -9.81 m/s2 along y",
                            "rigid walls: floor, hammer (mass_g 3, speed_m_per_s 2), ram (moves)", "end time: 0.02 s",
                            "end at rest: at 0.001 of the greatest kinetic energy"}));
  EXPECT_EQ(words_of_case("lattice { frame { end_time_s: 3 } } loading { speed_m_per_s: 1 end_strain: 0.5 }").loading(),
            "loaded for 3 s, crushed along X at 1 m/s to strain 0.5");
}

TEST(CaseWords, GoWithEveryAnswerThatHasACase) {
  const auto job = testing::from_text<v1::Job>(
      "case { lattice { hexagon { columns: 3 rows: 2 } } depth_mm: 5 } summary { crush_mode: CRUSH_MODE_V }");
  v1::ListJobsResponse list;
  *list.add_jobs() = job;
  v1::JobEvent event;
  *event.mutable_snapshot()->mutable_job() = job;
  v1::WatchJobsResponse watched;
  *watched.mutable_watched()->mutable_event() = event;
  v1::WatchSweepResponse sweep;
  *sweep.mutable_snapshot()->mutable_case_() = job.case_();
  v1::SweepTable table;
  *table.add_rows()->mutable_result()->mutable_summary() = job.summary();
  translate::add_words(list);
  translate::add_words(event);
  translate::add_words(watched);
  translate::add_words(sweep);
  translate::add_words(table);
  for (const auto* has : {&event.snapshot().job(), &watched.watched().event().snapshot().job(), &list.jobs(0)}) {
    EXPECT_EQ(has->words().lattice(), "hexagons, 3 x 2 cells");
    EXPECT_EQ(has->summary().crush_mode_words(), "V-shaped band (V)");
    EXPECT_EQ(has->words().facts_size(), has == &list.jobs(0) ? 0 : 3);
  }
  EXPECT_EQ(sweep.snapshot().words().lattice(), "hexagons, 3 x 2 cells");
  EXPECT_EQ(table.rows(0).result().summary().crush_mode_words(), "V-shaped band (V)");
  EXPECT_FALSE(table.rows(0).result().has_words());
}

}  // namespace
}  // namespace cellcrush
