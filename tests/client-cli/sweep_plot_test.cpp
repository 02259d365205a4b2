#include <gtest/gtest.h>

#include "fake_server.h"
#include "program.h"

namespace cellcrush::client::testing {
namespace {

namespace fs = std::filesystem;

TEST(SweepPlot, IsDrawnAsPngAndSvg) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.sweeps = make_sweep_script({v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::SUCCEEDED, v1::Job::FAILED});
  const FakeServer server(script);
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    const std::string file = (server.folder() / name).string();
    const ProgramResult result =
        run_program({"plot", "sweeps/test", "sweeps/test", "--log", "xy", "-o", file, "--server", server.address()});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.output, file + "\n");
    EXPECT_GT(read_file(file).size(), 5000U);
  }
  EXPECT_EQ(read_file(server.folder() / "a.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_NE(read_file(server.folder() / "a.svg").find("</svg>"), std::string::npos);
}

TEST(SweepPlot, WithoutAPlateauIsRefusedAndAnUnknownSweepNotFound) {
  Script script;
  script.job = make_job(v1::Job::SUCCEEDED);
  script.sweeps = make_sweep_script({v1::Job::CANCELLED, v1::Job::FAILED});
  const FakeServer server(script);
  const std::string file = (server.folder() / "a.png").string();
  const ProgramResult refused =
      run_program({"plot", "sweeps/test", "sweeps/test", "--log", "xy", "-o", file, "--server", server.address()});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("with a plateau yet"), std::string::npos) << refused.errors;
  EXPECT_EQ(run_program({"plot", "sweeps/none", "-o", file, "--server", server.address()}).exit_code, 5);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace cellcrush::client::testing
