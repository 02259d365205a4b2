#include "validation/frames_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "scenes/frames.h"

namespace cellcrush::validation {
namespace {

class FramesFileTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  /// Frames of a crush before loading and after 50 steps.
  std::vector<FieldFrame> write() const {
    const auto scene = scenes::build(scenes::hexagon_specimen(4, 3));
    FramesFile frames(file_, mesh_of(*scene));
    Simulation simulation(scene);
    std::vector<FieldFrame> written = {simulation.take_frame(0)};
    simulation.advance(50);
    written.push_back(simulation.take_frame(1));
    for (const FieldFrame& frame : written) {
      frames.add(frame);
    }
    return written;
  }

  const std::string file_ = testing::TempDir() + "frames-" + std::to_string(getpid());
};

TEST_F(FramesFileTest, GivesBackTheFramesThatWereAdded) {
  const auto written = write();
  const KeptFrames kept = read_frames(file_);
  ASSERT_EQ(kept.frames.size(), 2U);
  EXPECT_EQ(kept.mesh.element_nodes.size(), 2 * written[1].plastic_fraction.size());
  EXPECT_EQ(kept.frames[1].index, 1);
  EXPECT_EQ(kept.frames[1].strain, written[1].strain);
  EXPECT_EQ(kept.frames[1].position, written[1].position);
  EXPECT_EQ(kept.frames[1].plastic_fraction, written[1].plastic_fraction);
  EXPECT_NE(kept.frames[1].position, kept.frames[0].position);
}

TEST_F(FramesFileTest, LeavesOutAFrameThatWasCutShort) {
  write();
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 4);
  EXPECT_EQ(read_frames(file_).frames.size(), 1U);
}

TEST_F(FramesFileTest, RefusesWhatIsNone) {
  EXPECT_THROW(read_frames(file_), std::runtime_error);
  std::ofstream(file_) << "strain,stress_impact";
  EXPECT_THROW(read_frames(file_), std::runtime_error);
}

}  // namespace
}  // namespace cellcrush::validation
