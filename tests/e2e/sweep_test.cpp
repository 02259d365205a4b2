// The second day: a sweep and its table, a job that is cancelled, one that is deleted.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class SecondDay : public DaemonTest {
 protected:
  [[nodiscard]] std::string small() const { return write_file("small.txtpb", small_case()); }

  // The first word of what a command printed.
  static std::string first_word(const Outcome& outcome) {
    return outcome.output.substr(0, outcome.output.find_first_of(" \n"));
  }
};

TEST_F(SecondDay, AVelocitySweepEndsInATableWithTheoryBesideIt) {
  const Outcome sweep =
      cellcrush({"sweep", small(), "--over", "loading.speed_m_per_s=50,100,200", "--watch"}, kCrushLimit);
  ASSERT_EQ(sweep.exit_code, 0) << sweep.all();
  EXPECT_THAT(sweep.output, HasSubstr("sweeps/"));
  EXPECT_THAT(sweep.output, HasSubstr("Eq. 51"));
  const std::string name = first_word(sweep);
  const Outcome table = cellcrush({"table", name, "--json"});
  ASSERT_EQ(table.exit_code, 0) << table.all();
  const json rows = json::parse(table.output)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  double before = 0.0;
  for (const json& row : rows) {
    EXPECT_EQ(row["result"]["state"], "SUCCEEDED");
    const double plateau = row["result"]["summary"]["plateau_stress_impact_mpa"];
    EXPECT_GT(plateau, before) << "the plateau grows with the speed";
    before = plateau;
  }
  const Outcome chart = cellcrush({"plot", name, "-o", folder() / "sweep.png"});
  EXPECT_EQ(chart.exit_code, 0) << chart.all();
  EXPECT_GT(std::filesystem::file_size(folder() / "sweep.png"), 10000U);

  const Outcome deleted = cellcrush({"delete", name});
  EXPECT_EQ(deleted.exit_code, 0) << deleted.all();
  EXPECT_EQ(cellcrush({"show", name}).exit_code, 5);
  EXPECT_TRUE(json::parse(cellcrush({"list", "--json"}).output)["jobs"].empty()) << "its jobs go with it";
}

// The fields of a new kind of lattice and of its changes are found by reflection.
TEST_F(SecondDay, AVoronoiHoneycombIsSweptOverItsIrregularityAndItsMissingWalls) {
  const std::string foam = write_file("foam.txtpb", R"(
    lattice { voronoi { columns: 5 rows: 4 side_mm: 4 irregularity: 0.3 seed: 2 relative_density: 0.08 } }
    depth_mm: 4
    material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
    loading { speed_m_per_s: 100 end_strain: 0.4 })");
  const Outcome check = cellcrush({"check", foam, "--set", "lattice.defects.missing_walls=0.1", "--json"});
  ASSERT_EQ(check.exit_code, 0) << check.all();
  EXPECT_THAT(json::parse(check.output)["modelled"].dump(),
              ::testing::ContainsRegex("Voronoi honeycomb of 20 cells, .* walls missing, none of which splits"));
  const Outcome sweep = cellcrush({"sweep", foam, "--over", "lattice.voronoi.irregularity=0.2,0.8", "--over",
                                   "lattice.defects.missing_walls=0,0.1", "--watch"},
                                  kCrushLimit);
  ASSERT_EQ(sweep.exit_code, 0) << sweep.all();
  const json rows = json::parse(cellcrush({"table", first_word(sweep), "--json"}).output)["rows"];
  ASSERT_EQ(rows.size(), 4U);
  for (const json& row : rows) EXPECT_EQ(row["result"]["state"], "SUCCEEDED");
  const Outcome help = cellcrush({"explain", "lattice.voronoi.irregularity"});
  EXPECT_THAT(help.output, HasSubstr("0 gives regular"));
}

TEST_F(SecondDay, ConvergeGivesTheLimitOfEachPlateauWithItsInterval) {
  const Outcome converge = cellcrush(
      {"converge", small(), "--set", "lattice.imperfection.amplitude_mm=0.01", "--meshes", "1,2,4", "--seeds", "2"},
      kCrushLimit);
  ASSERT_EQ(converge.exit_code, 0) << converge.all();
  EXPECT_THAT(converge.output, ::testing::ContainsRegex("\n +elements per wall  runs +mean  scatter +error\n"));
  EXPECT_THAT(converge.output, ::testing::ContainsRegex("plateau at the support plate, [kM]Pa\n[^l]*limit[^\n]* ± "));
  const json found = json::parse(cellcrush({"converge", first_word(converge), "--json"}).output);
  ASSERT_GE(found["quantities"].size(), 2U);
  for (int i : {0, 1}) {
    EXPECT_GT(found["quantities"][i]["interval"], 0.0);
    EXPECT_GT(found["quantities"][i]["limit"], 0.0);
  }
}

// A cantilever whose tip is pushed until it yields.
TEST_F(SecondDay, ConvergeSpeaksOfAFrameAsOne) {
  const std::string frame = write_file("frame.txtpb", R"(lattice { frame {
    nodes { id: "root" x_mm: 0 y_mm: 0 } nodes { id: "tip" x_mm: 50 y_mm: 0 }
    beams { start: "root" end: "tip" thickness_mm: 2 }
    supports { node: "root" fix_x: true fix_y: true fix_rotation: true }
    motions { node: "tip" component: COMPONENT_Y
              displacement_mm_or_rad { points { time_s: 0 value: 0 } points { time_s: 2e-3 value: 5 } } }
    end_time_s: 2e-3 } }
    depth_mm: 1
    material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 })");
  const Outcome converge = cellcrush({"converge", frame}, kCrushLimit);
  ASSERT_EQ(converge.exit_code, 0) << converge.all();
  for (const char* words :
       {"elements per beam", "work of the loads", "plastic work", "largest fibre strain", "limit"}) {
    EXPECT_THAT(converge.output, HasSubstr(words));
  }
  for (const char* words : {"wall", "plateau", "seed"}) EXPECT_THAT(converge.output, ::testing::Not(HasSubstr(words)));
  const json found = json::parse(cellcrush({"converge", first_word(converge), "--json"}).output);
  EXPECT_EQ(found["mesh_words"], "elements per beam");
}

TEST_F(SecondDay, ANoteIsWrittenShownReplacedAndRemoved) {
  const Outcome submitted = cellcrush({"submit", small(), "--note", "as drawn"});
  const std::string job = first_word(submitted);
  EXPECT_THAT(cellcrush({"list"}).output, HasSubstr("as drawn")) << submitted.all();
  const Outcome replaced = cellcrush({"note", job, "walls 0.3 mm\nnot 0.4"});
  EXPECT_EQ(replaced.output, job + ": walls 0.3 mm\nnot 0.4\nReplaced: as drawn\n") << replaced.all();
  EXPECT_THAT(cellcrush({"show", job}).output, ::testing::ContainsRegex("note +walls 0.3 mm\n +not 0.4\n"));
  EXPECT_EQ(json::parse(cellcrush({"note", job, "", "--json"}).output)["note"], "");
  const std::string sweep =
      first_word(cellcrush({"sweep", small(), "--over", "loading.speed_m_per_s=100", "--note", "second series"}));
  EXPECT_THAT(cellcrush({"note", sweep, ""}).output, HasSubstr(sweep + " has no note\nReplaced: second series"));
  EXPECT_EQ(cellcrush({"note", sweep, "of all"}).output, sweep + ": of all\n");
  EXPECT_THAT(cellcrush({"list", "--sweeps"}).output, HasSubstr("of all"));
  EXPECT_THAT(cellcrush({"show", sweep}).output, ::testing::ContainsRegex("note +of all"));
  const Outcome refused = cellcrush({"note", job, "\a"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.errors, HasSubstr("job.note: has the control character 0x07."));
  EXPECT_EQ(cellcrush({"note", "jobs/99", "none"}).exit_code, 5);
}

TEST_F(SecondDay, ACancelledJobKeepsWhatItComputedAndCanThenBeDeleted) {
  const Outcome submitted = cellcrush({"submit", "preset:type-i"});
  ASSERT_EQ(submitted.exit_code, 0) << submitted.all();
  const std::string job = first_word(submitted);
  EXPECT_EQ(cellcrush({"delete", job}).exit_code, 2) << "a job that runs is not deleted";
  const auto deadline = std::chrono::steady_clock::now() + kShortLimit;
  json shown;
  do {
    shown = json::parse(cellcrush({"show", job, "--json"}).output);
  } while (!shown["progress"].contains("step") && std::chrono::steady_clock::now() < deadline);
  ASSERT_EQ(cellcrush({"cancel", job}).exit_code, 0);
  EXPECT_EQ(cellcrush({"watch", job}).exit_code, 1);
  EXPECT_EQ(json::parse(cellcrush({"show", job, "--json"}).output)["state"], "CANCELLED");
  const Outcome fetched = cellcrush({"fetch", job, "-o", folder() / "partial"});
  EXPECT_EQ(fetched.exit_code, 0) << fetched.all();
  EXPECT_GT(std::filesystem::file_size(folder() / "partial" / "result.h5"), 1000U);
  EXPECT_EQ(cellcrush({"delete", job}).exit_code, 0);
  EXPECT_EQ(cellcrush({"show", job}).exit_code, 5);
}

}  // namespace
}  // namespace cellcrush::e2e
