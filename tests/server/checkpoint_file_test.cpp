#include "worker/checkpoint_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <fstream>
#include <string>

#include "programs/temporary_folder.h"
#include "server/small_case.h"
#include "store/case_hash.h"

namespace cellcrush::worker {
namespace {

using ::testing::HasSubstr;

class CheckpointFileTest : public ::testing::Test {
 protected:
  static Checkpoint::Origin origin() {
    Checkpoint::Origin out;
    out.set_solver_revision("1.0");
    out.set_simd_target("avx2");
    out.set_case_hash("abc");
    return out;
  }

  void write(std::int64_t step) const {
    Checkpoint checkpoint;
    *checkpoint.mutable_origin() = origin();
    checkpoint.set_step(step);
    write_checkpoint(job_, checkpoint, [](const ByteSink& sink) {
      for (const std::string_view piece : {std::string_view("simu"), std::string_view(), std::string_view("lation")})
        sink(piece);
      sink(std::string(1'000'000, 's'));
    });
  }

  static void expect_simulation(const FoundCheckpoint& found, const std::string& expected) {
    std::string bytes(found.simulation.size, ' ');
    EXPECT_TRUE(found.simulation.read(bytes.data(), bytes.size()));
    EXPECT_TRUE(bytes == expected);
  }

  static void replace(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
  }

  testing::TemporaryFolder folder_;
  store::JobFolder job_{folder_.path()};
};

TEST_F(CheckpointFileTest, TheNewestCounts) {
  EXPECT_FALSE(find_checkpoint(job_, origin()).checkpoint);
  for (const std::int64_t step : {10, 20, 30}) write(step);
  const auto found = find_checkpoint(job_, origin());
  ASSERT_TRUE(found.checkpoint);
  EXPECT_EQ(found.checkpoint->step(), 30);
  EXPECT_TRUE(found.refused.empty());
  expect_simulation(found, "simulation" + std::string(1'000'000, 's'));
}

// Its simulation stood between the other fields.
TEST_F(CheckpointFileTest, OneOfAnEarlierVersionIsRead) {
  Checkpoint checkpoint;
  *checkpoint.mutable_origin() = origin();
  checkpoint.set_step(1'000'000'000'000);
  checkpoint.set_simulation("simulation");
  checkpoint.set_sample_count(17);
  checkpoint.add_stage_seconds(1.5);
  checkpoint.set_clock_seconds(2.5);
  const std::string bytes = checkpoint.SerializeAsString();
  const auto crc = crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  replace(job_.checkpoint(), fmt::format("CELLCRUSH CHECKPOINT 2 {} {}\n", crc, bytes.size()) + bytes);
  const auto found = find_checkpoint(job_, origin());
  ASSERT_TRUE(found.checkpoint);
  expect_simulation(found, "simulation");
  checkpoint.clear_simulation();
  EXPECT_EQ(found.checkpoint->SerializeAsString(), checkpoint.SerializeAsString());
}

TEST_F(CheckpointFileTest, ATornOrBitFlippedOneIsRefusedByNameAndTheOneBeforeCounts) {
  write(10);
  write(20);
  const std::string whole = testing::text_of_file(job_.checkpoint());
  for (std::size_t i = 0; i < whole.size(); i += i < 200 ? 13 : 49'999) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    for (const auto& bytes : {flipped, whole.substr(0, i)}) {
      replace(job_.checkpoint(), bytes);
      const auto found = find_checkpoint(job_, origin());
      ASSERT_TRUE(found.checkpoint) << i;
      EXPECT_EQ(found.checkpoint->step(), 10) << i;
      ASSERT_EQ(found.refused.size(), 1U) << i;
      EXPECT_THAT(found.refused[0], HasSubstr("checkpoint is "));
    }
  }
}

TEST_F(CheckpointFileTest, KilledBetweenTheTwoNamesTheOneBeforeCounts) {
  write(10);
  write(20);
  std::filesystem::rename(job_.checkpoint(), job_.previous_checkpoint());
  replace(job_.partial_checkpoint(), "half");
  const auto found = find_checkpoint(job_, origin());
  ASSERT_TRUE(found.checkpoint);
  EXPECT_EQ(found.checkpoint->step(), 20);
}

TEST_F(CheckpointFileTest, OneOfAnotherSolverOrProcessorOrCaseIsRefused) {
  write(10);
  auto newer = origin();
  newer.set_solver_revision("1.1");
  const auto found = find_checkpoint(job_, newer);
  EXPECT_FALSE(found.checkpoint);
  ASSERT_EQ(found.refused.size(), 1U);
  EXPECT_THAT(found.refused[0], HasSubstr("1.1"));
  auto scalar = origin();
  scalar.set_simd_target("scalar");
  EXPECT_FALSE(find_checkpoint(job_, scalar).checkpoint);
  auto other = origin();
  other.set_case_hash("abd");
  EXPECT_FALSE(find_checkpoint(job_, other).checkpoint);
}

TEST(CaseHash, IsThatOfTheContent) {
  v1::Case one = testing::small_case();
  const auto hash = store::hash_of(one);
  EXPECT_EQ(store::hash_of(testing::small_case()), hash);
  one.set_depth_mm(4.5);
  EXPECT_NE(store::hash_of(one), hash);
}

}  // namespace
}  // namespace cellcrush::worker
