// What validate keeps of a crush, curves and frames, and what is read from them: its course and its peaks.
#include "validation/records.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>

#include "scenes/frames.h"
#include "validation/course.h"

namespace cellcrush::validation {
namespace {

/// A crush of 100 mm: 2 MPa to 60 % strain, then rising by 100 MPa a unit of strain, with one peak of 3 MPa round 30 %.
std::vector<Sample> crush(double end) {
  std::vector<Sample> samples;
  for (double strain = 0.001; strain < end; strain += 0.001) {
    Sample sample;
    sample.strain = strain;
    sample.travel = 100.0 * strain;
    sample.stress_impact = strain > 0.28 && strain < 0.32 ? 3.0 : 2.0 + 100.0 * std::max(0.0, strain - 0.6);
    sample.stress_support = sample.stress_impact - 0.5;
    sample.energies.residual = -0.25;
    samples.push_back(sample);
  }
  return samples;
}

class CurveFileTest : public testing::Test {
 protected:
  void SetUp() override {
    CurveFile curve(file_);
    for (const Sample& sample : crush(0.8)) {
      curve.add(sample);
    }
  }
  void TearDown() override { std::filesystem::remove(file_); }

  const std::string file_ = testing::TempDir() + "curve-" + std::to_string(getpid());
};

TEST_F(CurveFileTest, GivesBackWhatWasWritten) {
  const auto written = crush(0.8);
  const auto read = read_curve(file_);
  ASSERT_EQ(read.size(), written.size());
  EXPECT_NEAR(read[400].strain, written[400].strain, 1e-6);
  EXPECT_NEAR(read[400].travel, written[400].travel, 1e-4);
  EXPECT_EQ(read[300].stress_impact, 3.0);
  EXPECT_EQ(read[300].stress_support, 2.5);
  EXPECT_EQ(read[300].energies.residual, -0.25);
}

TEST_F(CurveFileTest, LeavesOutARowThatWasCutShort) {
  const std::size_t rows = read_curve(file_).size();
  std::filesystem::resize_file(file_, std::filesystem::file_size(file_) - 3);
  EXPECT_EQ(read_curve(file_).size(), rows - 1);
}

TEST_F(CurveFileTest, RefusesWhatIsNone) {
  std::ofstream(file_) << "strain,stress\n0,1\n";
  EXPECT_THROW(read_curve(file_), std::runtime_error);
  EXPECT_THROW(read_curve(file_ + "-missing"), std::runtime_error);
}

TEST(Course, HasTheOnsetOfDensificationAndThePeaksBeforeIt) {
  const Course course = find_course(crush(0.8));
  EXPECT_TRUE(course.densified);
  EXPECT_NEAR(course.densification, 0.6, 0.01);
  EXPECT_NEAR(course.densification_travel, 60.0, 1.0);
  EXPECT_NEAR(course.plateau, 2.07, 0.02);
  // 2 + 100 x is twice (1.24 + 2 x + 50 x^2) / (0.6 + x) at x = 0.0221.
  EXPECT_TRUE(course.risen);
  EXPECT_NEAR(course.rise_travel, 62.2, 0.2);
  ASSERT_EQ(course.peaks.size(), 1U);
  EXPECT_NEAR(course.peaks[0].strain, 0.3, 0.02);
}

TEST(Course, OfACrushThatHasNotDensifiedEndsWithIt) {
  const Course course = find_course(crush(0.5));
  EXPECT_FALSE(course.densified);
  EXPECT_FALSE(course.risen);
  EXPECT_NEAR(course.densification, 0.499, 0.002);
}

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

std::vector<Sample> samples_of(const std::function<double(double)>& stress, double end, int count) {
  std::vector<Sample> samples(count);
  for (int i = 0; i < count; ++i) {
    samples[i].strain = end * (i + 1) / count;
    samples[i].stress_impact = stress(end * (i + 0.5) / count);
  }
  return samples;
}

/// A plateau of 1 MPa with a bump of half a sine, 0.05 wide.
double bump(double strain, double middle, double height) {
  const double way = (strain - middle) / 0.05;
  return std::abs(way) < 0.5 ? height * std::cos(way * std::numbers::pi) : 0.0;
}

TEST(Peaks, AreCountedWhoseProminenceIsAShareOfThePlateau) {
  const auto stress = [](double e) { return 1.0 + bump(e, 0.2, 0.3) + bump(e, 0.3, 0.1) + bump(e, 0.4, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.6);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].strain, 0.2, 0.001);
  EXPECT_NEAR(peaks[0].prominence, 0.3, 0.01);
  EXPECT_NEAR(peaks[1].strain, 0.4, 0.001);
  EXPECT_NEAR(peaks[1].stress, 1.5, 0.01);
}

TEST(Peaks, OnTheShoulderOfAHigherOneAreMeasuredFromTheSaddle) {
  const auto stress = [](double e) { return e < 0.3 ? 1.0 + bump(e, 0.2, 0.5) : 1.4 + bump(e, 0.4, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.6);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].prominence, 0.5, 0.01);
  EXPECT_NEAR(peaks[1].prominence, 0.5, 0.01);
}

TEST(Peaks, AreNotMadeByWhatRingsFasterThanTheSmoothing) {
  const auto stress = [](double e) { return 1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * e / 0.001); };
  EXPECT_TRUE(find_salient_peaks(samples_of(stress, 0.5, 5000), 0.5).empty());
}

TEST(Peaks, AreNotMadeByTheWaveOfASuddenStart) {
  const auto stress = [](double e) { return e < 0.003 ? 9.0 : 1.0 + bump(e, 0.05, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.5, 1000), 0.5);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].strain, 0.05, 0.001);
}

TEST(Peaks, BeyondTheLastStrainAndRisesThatDoNotFallAreNone) {
  const auto stress = [](double e) { return 1.0 + bump(e, 0.2, 0.5) + bump(e, 0.55, 0.5) + (e > 0.4 ? e - 0.4 : 0.0); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.5);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].strain, 0.2, 0.001);
}

}  // namespace
}  // namespace cellcrush::validation
