// Results in other programs: xarray, meshio and ParaView.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class Files : public DaemonTest {
 protected:
  void SetUp() override {
    DaemonTest::SetUp();
    const std::string submitted = write_file("small.txtpb", small_case());
    ASSERT_EQ(cellcrush({"submit", submitted, "--watch"}, kCrushLimit).exit_code, 0);
  }

  // Fetches job 1 into a folder of its own, which it returns.
  fs::path fetch(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"fetch", "jobs/1", "-o", (folder() / "out").string()};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = cellcrush(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return folder() / "out";
  }

  // What a script prints whose first argument is the folder.
  std::string printed_by(const std::string& program, const std::string& script) const {
    const Outcome outcome = run({program, write_file("script.py", "import os, sys\nos.chdir(sys.argv[1])\n" + script),
                                 (folder() / "out").string()},
                                kCrushLimit);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return outcome.output;
  }
};

TEST_F(Files, XarrayOpensAResultByTheLinesOfThePage) {
  fetch({});
  const std::string page = text_of(fs::path(CELLCRUSH_SOURCE_ROOT) / "server/store/result_format.md");
  std::smatch block;
  ASSERT_TRUE(std::regex_search(page, block, std::regex("```python\n([^`]*)```")));
  const std::string printed = printed_by("/usr/bin/python3", block.str(1) + R"(
print(dict(history.sizes), sorted(history.coords), history.stress_impact_mpa.units)
print(history.stress_impact_mpa.description)
frames = xarray.open_dataset("result.h5", group="frames", engine="h5netcdf")
print(frames.position_mm.dims, frames.plastic_fraction.dims, float(frames.strain[0]))
whole = xarray.open_dataset("result.h5", engine="h5netcdf")
print(whole.attrs["name"], "Wu, Tsai and Lee" in whole.attrs["citation"], "SUCCEEDED" in whole.attrs["job"])
)");
  EXPECT_THAT(printed, HasSubstr("['strain', 'time_s'] MPa\nMean stress at the impact plate: its force"));
  EXPECT_THAT(printed, HasSubstr("('time_s', 'particle', 'axis') ('time_s', 'element') 0.0\njobs/1 True True\n"));
}

TEST_F(Files, MeshioReadsEveryFieldOfAFrame) {
  const fs::path out = fetch({"--vtu"});
  EXPECT_THAT(text_of(out / "crush.pvd"), HasSubstr("file=\"frame_0000.vtu\""));
  const std::string printed = printed_by("/usr/bin/python3", R"(
import glob, h5py, meshio, numpy
result = h5py.File("result.h5")
files = sorted(glob.glob("frame_*.vtu"))
mesh = meshio.read(files[-1])
position = result["frames/position_mm"][-1]
print(len(files) == len(result["frames/time_s"]), (mesh.points[:, :2] == position).all())
print((mesh.cells_dict["line"] == result["mesh/beam_nodes"][:]).all())
print((mesh.cell_data["plastic_fraction"][0] == result["frames/plastic_fraction"][-1]).all())
print((mesh.cell_data["thickness_mm"][0] == result["mesh/thickness_mm"][:]).all())
moved = position - result["frames/position_mm"][0]
print((mesh.point_data["displacement_mm"][:, :2] == moved).all(), abs(moved).max() > 1)
)");
  EXPECT_EQ(printed, "True True\nTrue\nTrue\nTrue\nTrue True\n");
}

TEST_F(Files, ParaViewPlaysTheCrush) {
  if (!fs::exists("/usr/bin/pvpython")) GTEST_SKIP() << "pvpython is not installed";
  fetch({"--vtk"});
  const std::string printed = printed_by("/usr/bin/pvpython", R"(
import glob
from paraview.simple import *
reader = PVDReader(FileName=os.path.join(os.getcwd(), "crush.pvd"))
times = list(reader.TimestepValues)
reader.UpdatePipeline(times[-1])
data = reader.GetDataInformation()
print(len(times) == len(glob.glob("frame_*.vtp")), times == sorted(times))
print(data.GetNumberOfPoints() > 0, data.GetNumberOfCells() > 0)
print(sorted(reader.CellData.keys()), sorted(reader.PointData.keys()))
print(reader.PointData["displacement_mm"].GetRange(-1)[1] > 1)
print(Tube(Input=reader).GetDataInformation().GetNumberOfCells() >= 0)
)");
  EXPECT_THAT(printed, HasSubstr("True True\nTrue True\n"));
  EXPECT_THAT(printed, HasSubstr("['plastic_fraction', 'thickness_mm'] ['displacement_mm']\nTrue\nTrue\n"));
}

TEST_F(Files, DecimalCommasStandBetweenSemicolons) {
  std::string expected = text_of(fetch({}) / "history.csv");
  for (char& letter : expected) letter = letter == ',' ? ';' : letter == '.' ? ',' : letter;
  EXPECT_EQ(text_of(fetch({"--decimal-comma"}) / "history.csv"), expected) << "and it overwrites its own file";
}

}  // namespace
}  // namespace cellcrush::e2e
