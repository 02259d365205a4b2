#include "bench/precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "validation/options.h"

namespace cellcrush::bench {
namespace {

const Measure kSupport = {"plateau_stress_support", "support", false};

VariedScene scene() {
  return {"s",
          {"type-i"},
          {{"converged:reference", {"elements=8"}}, {"fast:1", {"elements=1"}}, {"slow:4", {"elements=4"}}}};
}

CsvRow row(const Variant& variant, int seed, double seconds, double value) {
  return {{"scene", "s"},
          {"variant", variant.name},
          {"seed", std::to_string(seed)},
          {"options", validation::read_options(words_of(scene(), variant, seed)).changes},
          {"status", "finished"},
          {"processor_seconds", std::to_string(seconds)},
          {"plateau_stress_support", std::to_string(value)}};
}

std::vector<CsvRow> rows() {
  std::vector<CsvRow> all;
  const auto variants = scene().variants;
  for (int seed = 1; seed <= 2; ++seed) {
    const double scatter = seed == 1 ? -0.01 : 0.01;
    all.push_back(row(variants[0], seed, 100.0, 1.0 + scatter));
    all.push_back(row(variants[1], seed, 1.0, 1.5 + scatter));
    all.push_back(row(variants[2], seed, 10.0, 1.005 + scatter));
  }
  return all;
}

TEST(Precision, IsTheDistanceOfMeansWithTheIntervalOfBoth) {
  double scatter = 0.0;
  const auto found = precisions(scene(), rows(), kSupport, "converged:reference", scatter);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(scatter, 0.01 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(found[0].error, 0.0);
  EXPECT_NEAR(found[0].uncertainty, 12.71 * 0.01, 1e-9);
  EXPECT_NEAR(found[1].error, 0.5, 1e-9);
  EXPECT_NEAR(found[1].seconds, 1.0, 1e-9);
  EXPECT_NEAR(found[1].uncertainty, 4.30 * 0.01 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(found[1].scatter, 0.01 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(found[2].error, 0.005, 1e-9);
}

// The slower one's error lies below its uncertainty: it counts as that.
TEST(Precision, MarksTheFrontByErrorsNoSurerThanTheirScatter) {
  double scatter = 0.0;
  auto all = rows();
  auto found = precisions(scene(), all, kSupport, "converged:reference", scatter);
  EXPECT_TRUE(found[1].on_front);
  EXPECT_TRUE(found[2].on_front);
  for (CsvRow& cells : all) {
    if (cells["variant"] == "fast:1") cells["plateau_stress_support"] = "1.02";
  }
  found = precisions(scene(), all, kSupport, "converged:reference", scatter);
  EXPECT_TRUE(found[1].on_front);
  EXPECT_FALSE(found[2].on_front);
}

TEST(Precision, LeavesOutCrushesThatFailedAndWordsThatChanged) {
  double scatter = 0.0;
  auto all = rows();
  all[1]["status"] = "diverged";
  all[2]["options"] = "elements=3 seed=1";
  EXPECT_EQ(precisions(scene(), all, kSupport, "converged:reference", scatter).size(), 1u);
  EXPECT_THROW(precisions(scene(), all, kSupport, "converged:other", scatter), std::invalid_argument);
}

TEST(Variants, AreReadByScenesAndAWrongLineIsNamed) {
  std::string pattern = (std::filesystem::temp_directory_path() / "cellcrush-list-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  const std::string file = pattern + "/list";
  std::ofstream(file) << "# remark\n[one] type-i speed=50\na:b elements=4 # more\n\n[two] type-i\nc:d\n";
  const auto scenes = read_variants(file);
  ASSERT_EQ(scenes.size(), 2u);
  EXPECT_EQ(words_of(scenes[0], scenes[0].variants[0], 3),
            (std::vector<std::string>{"type-i", "speed=50", "elements=4", "seed=3"}));
  EXPECT_EQ(scenes[1].variants[0].name, "c:d");
  for (const char* wrong : {"wrong", "group:1,3"}) {
    std::ofstream(file) << "[one] type-i\n" << wrong << "\n";
    try {
      read_variants(file);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(":2: "), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove_all(pattern);
}

}  // namespace
}  // namespace cellcrush::bench
