#include "bench/precision.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "bench/precision_chart.h"
#include "bench/precision_panel.h"
#include "chart/canvas.h"
#include "chart/display_text.h"
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
  EXPECT_NEAR(found[0].uncertainty, 12.7062 * 0.01, 1e-9);
  EXPECT_NEAR(found[1].error, 0.5, 1e-9);
  EXPECT_NEAR(found[1].seconds, 1.0, 1e-9);
  EXPECT_NEAR(found[1].uncertainty, 4.30265 * 0.01 * std::sqrt(2.0), 1e-9);
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
  const std::string file = testing::TempDir() + "list-" + std::to_string(getpid());
  std::ofstream(file) << "# remark\n[one] type-i speed=50\na:b elements=4 # more\n\n[two] type-i\nc:d\n"
                         "[at-@] type-i speed=@ @=7,8\ne:@ elements=@ @=1,2\n";
  const auto scenes = read_variants(file);
  ASSERT_EQ(scenes.size(), 4u);
  EXPECT_EQ(words_of(scenes[0], scenes[0].variants[0], 3),
            (std::vector<std::string>{"type-i", "speed=50", "elements=4", "seed=3"}));
  EXPECT_EQ(scenes[1].variants[0].name, "c:d");
  EXPECT_EQ(scenes[3].name, "at-8");
  EXPECT_EQ(words_of(scenes[3], scenes[3].variants.at(1), 3),
            (std::vector<std::string>{"type-i", "speed=8", "elements=2", "seed=3"}));
  for (const char* wrong : {"wrong", "group:1,3"}) {
    std::ofstream(file) << "[one] type-i\n" << wrong << "\n";
    try {
      read_variants(file);
      ADD_FAILURE() << wrong << " was taken";
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(":2: "), std::string::npos) << error.what();
    }
  }
  std::filesystem::remove(file);
}

using client::Rectangle;

const std::string kBenchFolder = CELLCRUSH_BENCH_FOLDER;

class PrecisionCharts : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }

  [[nodiscard]] std::string picture() const {
    std::ostringstream text;
    text << std::ifstream(file_).rdbuf();
    return text.str();
  }

  const std::string file_ = testing::TempDir() + "chart-" + std::to_string(getpid()) + ".svg";
  std::vector<VariedScene> scenes_ = read_variants(kBenchFolder + "/work_precision.txt");
  std::vector<CsvRow> rows_ = read_csv(kBenchFolder + "/results/work_precision.csv");
};

struct PlacedText {
  std::string words;
  Rectangle place;
};

/// The upright texts of a picture, in boxes as wide as their letters are on average, and no higher than a digit.
std::vector<PlacedText> texts_of(const std::string& picture) {
  constexpr double kLetter = 0.5;
  static const std::regex kText(
      "<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*font-size=\"([0-9.]+)\" "
      "text-anchor=\"([a-z]+)\"([^>]*)>([^<]*)</text>");
  std::vector<PlacedText> texts;
  for (std::sregex_iterator found(picture.begin(), picture.end(), kText), end; found != end; ++found) {
    const auto& text = *found;
    if (text[5].str().find("rotate") != std::string::npos) continue;
    const double size = std::stod(text[3]);
    const double width = kLetter * size * client::display_width(text[6].str());
    const double shift = text[4] == "start" ? 0.0 : text[4] == "middle" ? 0.5 * width : width;
    texts.push_back({text[6], {std::stod(text[1]) - shift, std::stod(text[2]) - 0.7 * size, width, 0.7 * size}});
  }
  return texts;
}

void expect_no_text_on_another(const std::string& picture) {
  const std::vector<PlacedText> texts = texts_of(picture);
  ASSERT_GT(texts.size(), 10u);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_FALSE(overlap(texts[i].place, texts[k].place)) << texts[i].words << " on " << texts[k].words;
    }
  }
}

int count_of(const std::string& words, const std::string& picture) {
  int count = 0;
  for (std::size_t at = 0; (at = picture.find(words, at)) != std::string::npos; ++at) ++count;
  return count;
}

TEST(PrecisionSeries, KeepKindsOfElementApartFromOtherSettings) {
  EXPECT_EQ(family_of("default:2"), Family::force_based);
  EXPECT_EQ(family_of("elements:4"), Family::force_based);
  EXPECT_EQ(family_of("converged:8"), Family::force_based);
  EXPECT_EQ(family_of("displacement:1"), Family::displacement_based);
  EXPECT_EQ(family_of("paper:8"), Family::papers);
  EXPECT_EQ(family_of("rotary:3"), Family::other_setting);
  EXPECT_EQ(label_of("paper:8"), "8");
  EXPECT_EQ(label_of("step:.25"), "step /4");
  EXPECT_EQ(label_of("new:7"), "new 7");
}

TEST(PrecisionSeries, DrawAnErrorInsideItsIntervalAsABound) {
  const std::vector<Precision> all = {{"paper:1", 3.0, 0.60, 0.01, 0.0, 5, true},
                                      {"paper:2", 5.0, 0.004, 0.012, 0.0, 5, true}};
  const auto series = series_of(all, kMeasures.front(), kConverged);
  ASSERT_EQ(series.size(), 1u);
  const auto& points = series.front().points;
  EXPECT_FALSE(points[0].is_bound);
  EXPECT_NEAR(points[0].error, 60.0, 1e-9);
  EXPECT_NEAR(points[0].low, 59.0, 1e-9);
  EXPECT_TRUE(points[1].is_bound);
  EXPECT_NEAR(points[1].error, 1.2, 1e-9);
  EXPECT_EQ(points[1].low, 0.0);
  EXPECT_NEAR(points[1].high, 1.6, 1e-9);
}

TEST_F(PrecisionCharts, OfTheOverviewNameFourSeriesAndTheReference) {
  // As deploy/evidence titles it.
  const std::string title = "Type I crushed at 100 m/s to 41 % strain: error against time";
  draw_overview(file_, scenes_.front(), rows_, kConverged, title);
  const std::string drawn = picture();
  expect_no_text_on_another(drawn);
  for (int family = 0; family < kFamilyCount; ++family) {
    EXPECT_EQ(count_of(">" + name_of(static_cast<Family>(family)) + "<", drawn), 1);
  }
  EXPECT_EQ(count_of(">8 (reference)<", drawn), 1);
  EXPECT_EQ(count_of(">2 (default)<", drawn), 1);
  EXPECT_EQ(count_of(">" + title + "<", drawn), 1);
  const std::string readme = kBenchFolder + "/results/speed-accuracy.svg";
  if (std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr) std::ofstream(readme) << drawn;
  std::ostringstream committed;
  committed << std::ifstream(readme).rdbuf();
  EXPECT_TRUE(committed.str() == drawn) << readme << " is out of date: run this test with CELLCRUSH_WRITE_PAGES=1";
}

TEST_F(PrecisionCharts, OfAllMeasuresHaveNoTextOnAnother) {
  for (const VariedScene& scene : scenes_) {
    draw_precisions(file_, scene, rows_, kConverged);
    const std::string drawn = picture();
    expect_no_text_on_another(drawn);
    for (const Variant& variant : scene.variants) {
      if (std::ranges::none_of(rows_, [&](const CsvRow& row) { return is_of(row, scene, variant); })) continue;
      const std::string label = variant.name == kConverged ? "8" : label_of(variant.name);
      EXPECT_GE(count_of(">" + label, drawn), static_cast<int>(kMeasures.size())) << scene.name << " " << variant.name;
    }
  }
}

}  // namespace
}  // namespace cellcrush::bench
