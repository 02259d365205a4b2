// Broken walls in a result file: what the writer got is what the reader gives, and nothing of them in a file without
// any.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "programs/temporary_folder.h"
#include "programs/text_proto.h"
#include "server/small_case.h"
#include "store/result_reader.h"
#include "store/result_writer.h"

namespace cellcrush::store {
namespace {

v1::Sample sample_at(int step, const std::vector<v1::Break>& breaks, int count) {
  v1::Sample sample;
  sample.set_step(step);
  sample.set_time_s(0.1 * step);
  sample.set_break_count(count);
  sample.mutable_breaks()->Add(breaks.begin(), breaks.end());
  return sample;
}

v1::FieldFrame frame_at(int index, const std::string& ends) {
  v1::FieldFrame frame = testing::from_text<v1::FieldFrame>(ends);
  frame.set_index(index);
  for (int k = 0; k < 6; ++k) frame.add_position_mm(static_cast<float>(k));
  for (int k = 0; k < 2; ++k) frame.add_plastic_fraction(0.5F);
  for (int k = 0; k < 2; ++k) frame.add_fibre_strain(0.1F);
  return frame;
}

class ResultBreaksTest : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::vector<v1::Sample>& samples, const std::vector<v1::FieldFrame>& frames) {
    const std::filesystem::path path = folder_.path() / "result.h5";
    const auto mesh = testing::from_text<v1::Mesh>(
        "particle_count: 3 element_nodes: [0, 1, 1, 2] thickness_mm: [0.5, 0.25] element_wall: [0, 1]");
    ResultWriter writer(path, mesh);
    for (const v1::Sample& sample : samples) writer.add_sample(sample);
    for (const v1::FieldFrame& frame : frames) writer.add_frame(frame);
    v1::Job job = testing::from_text<v1::Job>(R"(name: "jobs/7" state: SUCCEEDED attempt: 1)");
    *job.mutable_case_() = testing::small_case();
    job.mutable_summary()->set_break_count(samples.back().break_count());
    writer.finish({job, "1", "scalar", 1, 1e-7, {}});
    return path;
  }

  testing::TemporaryFolder folder_;
};

const char* const kFirst = R"(step: 12 time_s: 1.25 wall: 1 x_mm: 3 y_mm: -4 energy_mj: 0.5 element: 1 particle: 1)";
const char* const kSecond = R"(step: 31 time_s: 3.125 wall: 0 x_mm: 5 element: 0 at_end: true particle: 1)";

TEST_F(ResultBreaksTest, AreReadAsTheyWereWritten) {
  const auto first = testing::from_text<v1::Break>(kFirst);
  const auto second = testing::from_text<v1::Break>(kSecond);
  const std::vector<v1::Sample> samples = {sample_at(10, {}, 0), sample_at(20, {first}, 1), sample_at(30, {}, 1),
                                           sample_at(40, {second}, 2)};
  const std::vector<v1::FieldFrame> frames = {frame_at(0, ""), frame_at(1, "broken_end: 2 end_position_mm: [1, 2]"),
                                              frame_at(2, "broken_end: [2, 1] end_position_mm: [1.5, 2.5, 3, 4]")};
  const ResultReader result(write(samples, frames));
  const std::vector<v1::Sample> history = result.history();
  ASSERT_EQ(history.size(), samples.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    ASSERT_EQ(history[i].breaks_size(), samples[i].breaks_size()) << i;
    for (int k = 0; k < samples[i].breaks_size(); ++k) {
      EXPECT_EQ(history[i].breaks(k).SerializeAsString(), samples[i].breaks(k).SerializeAsString()) << i;
    }
  }
  const std::vector<v1::Sample> last = result.history(3, 1);
  ASSERT_EQ(last.size(), 1U);
  ASSERT_EQ(last[0].breaks_size(), 1);
  EXPECT_EQ(last[0].breaks(0).step(), 31);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const v1::FieldFrame frame = result.frame(static_cast<int>(i));
    EXPECT_THAT(frame.broken_end(), ::testing::ElementsAreArray(frames[i].broken_end())) << i;
    EXPECT_THAT(frame.end_position_mm(), ::testing::ElementsAreArray(frames[i].end_position_mm())) << i;
  }
  EXPECT_EQ(result.job().summary().break_count(), 2);
}

TEST_F(ResultBreaksTest, AreAbsentWhereNoneBroke) {
  const ResultReader result(write({sample_at(10, {}, 0)}, {frame_at(0, "")}));
  EXPECT_EQ(result.history().at(0).breaks_size(), 0);
  EXPECT_EQ(result.frame(0).broken_end_size(), 0);
}

}  // namespace
}  // namespace cellcrush::store
