#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "bench/csv_table.h"
#include "validation/crush_run.h"
#include "validation/curve_file.h"
#include "validation/options.h"

namespace cellcrush::validation {
namespace {

const std::filesystem::path kRecords = CELLCRUSH_RECORDS;

/// A crush that was run once to its end: the words of its command and its curve's file.
struct Kept {
  std::vector<std::string> words;
  std::string curve;
};

std::vector<Kept> all_kept() {
  std::vector<Kept> all;
  for (const bench::CsvRow& row : bench::read_csv(kRecords / "slow_half.csv")) {
    std::istringstream stream(row.at("preset") + " " + row.at("options"));
    all.push_back({{std::istream_iterator<std::string>(stream), {}}, row.at("curve")});
  }
  return all;
}

std::string name_of(const testing::TestParamInfo<Kept>& info) {
  std::string name = std::filesystem::path(info.param.curve).stem();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char letter) { return !std::isalnum(letter); }, '_');
  return name;
}

void PrintTo(const Kept& kept, std::ostream* stream) { *stream << kept.curve; }

class SlowHalf : public testing::TestWithParam<Kept> {};

/// Chaos comes later. AVX2 and AVX-512 give the same six digits up to here, the plain text and SSE4 stresses that
/// differ by up to 0.7 % of the greatest so far: three times that is allowed. Samples are those of the whole run.
TEST_P(SlowHalf, BeginsAsItsKeptCurve) {
  constexpr double kUntil = 0.02;
  constexpr double kTolerance = 0.02;  // of the greatest stress so far
  const Options options = read_options(GetParam().words);
  const CrushRun run = run_crush(options.spec, kUntil);
  const std::vector<Sample> kept = read_curve(kRecords / GetParam().curve);
  ASSERT_GE(kept.size(), run.samples.size());
  ASSERT_GE(run.samples.size(), 10U);
  ASSERT_GE(run.samples.back().strain, kUntil);
  double greatest = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < run.samples.size(); ++i) {
    const Sample& now = run.samples[i];
    ASSERT_NEAR(now.strain / kept[i].strain, 1.0, 1e-5) << "sample " << i;
    greatest = std::max({greatest, kept[i].stress_impact, kept[i].stress_support});
    for (const auto stress : {&Sample::stress_impact, &Sample::stress_support}) {
      const double difference = std::abs(now.*stress - kept[i].*stress);
      EXPECT_LE(difference, kTolerance * greatest) << "at strain " << now.strain;
      worst = std::max(worst, difference / greatest);
    }
  }
  RecordProperty("worst_difference", std::to_string(worst));
  EXPECT_LT(run.summary.energy_error_relative, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Crushes, SlowHalf, testing::ValuesIn(all_kept()), name_of);

}  // namespace
}  // namespace cellcrush::validation
