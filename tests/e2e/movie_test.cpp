// `cellcrush movie` with the real ffmpeg.
#include <gmock/gmock.h>

#include <regex>

#include "e2e/daemon_test.h"

namespace cellcrush::e2e {
namespace {

using ::testing::StartsWith;

TEST(Movie, ShowsEveryFrameAsItIsDrawnInTheFormatOfItsName) {
  const cellcrush::testing::TemporaryFolder folder;
  const auto outcome_of = [&](std::vector<std::string> words, const std::string& input = {}) {
    words.insert(words.begin(), {"/usr/bin/env", "-C", folder.path().string()});
    Outcome outcome = Process(words, input).wait(kCrushLimit);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return outcome;
  };
  outcome_of({CELLCRUSH_PROGRAM, "run", "-", "-o", "out"}, small_case());
  const std::string frames = outcome_of({CELLCRUSH_PROGRAM, "movie", "out", "--frames", "frames"}).output;
  std::smatch count;
  ASSERT_TRUE(std::regex_match(frames, count, std::regex("frames  ([67]) frames\n"))) << frames;
  const std::string length = count[1].str() + "\n" + (count[1] == "6" ? "1.2" : "1.4");  // s
  for (const auto& [file, shape] :
       {std::pair("crush.mp4", "h264,1920,1164,"), std::pair("crush.webm", "vp9,1920,1164,"),
        std::pair("CRUSH.GIF", "gif,960,582,")}) {
    outcome_of({CELLCRUSH_PROGRAM, "movie", "out", "--fps", "5", "-o", file});
    const Outcome probed =
        outcome_of({"ffprobe", "-v", "error", "-count_frames", "-select_streams", "v:0", "-show_entries",
                    "stream=codec_name,width,height,nb_read_frames:format=duration", "-of", "csv=p=0", file});
    EXPECT_THAT(probed.output, StartsWith(shape + length)) << file;
    const Outcome compared =
        outcome_of({"ffmpeg", "-nostdin", "-i", file, "-framerate", "5", "-i", "frames/frame_%05d.png", "-lavfi",
                    "[1][0]scale2ref[drawn][movie];[movie][drawn]psnr", "-f", "null", "-"});
    std::smatch worst;
    ASSERT_TRUE(std::regex_search(compared.errors, worst, std::regex("PSNR .* min:([0-9.]+)"))) << compared.errors;
    EXPECT_GT(std::stod(worst[1]), 40.0) << file << ": decibels; the frame beside the right one has 18";
  }
}

}  // namespace
}  // namespace cellcrush::e2e
