#include "e2e/daemon_test.h"

#include <csignal>
#include <fstream>

namespace cellcrush::e2e {

std::string small_case() {
  return R"(title: "A small specimen of hexagons"
lattice { hexagon { columns: 4 rows: 3 side_mm: 4 wall_thickness_mm: 0.3464 } }
depth_mm: 4
material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
loading { speed_m_per_s: 100 end_strain: 0.5 }
output { sample_count: 100 frame_count: 5 }
)";
}

void DaemonTest::TearDown() {
  if (daemon_) stop_daemon();
}

void DaemonTest::start_daemon() {
  daemon_ = std::make_unique<Process>(std::vector<std::string>{CELLCRUSHD_PROGRAM, "--data",
                                                               (folder() / "data").string(), "--listen", address(),
                                                               "--listen", "127.0.0.1:0", "--http", "none"});
  ASSERT_TRUE(daemon_->wait_for_output("cellcrushd is listening on " + address(), kShortLimit))
      << daemon_->output() << daemon_->errors();
}

void DaemonTest::stop_daemon() {
  daemon_->send(SIGTERM);
  const Outcome outcome = daemon_->wait(kShortLimit);
  daemon_.reset();
  EXPECT_EQ(outcome.exit_code, 0) << "The daemon did not end in order:\n" << outcome.all();
}

std::vector<std::string> DaemonTest::command(std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), CELLCRUSH_PROGRAM);
  arguments.insert(arguments.end(), {"--server", address()});
  return arguments;
}

Outcome DaemonTest::cellcrush(std::vector<std::string> arguments, std::chrono::milliseconds limit) const {
  return run(command(std::move(arguments)), limit);
}

std::string DaemonTest::write_file(const std::string& name, const std::string& text) const {
  const std::filesystem::path path = folder() / name;
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

}  // namespace cellcrush::e2e
