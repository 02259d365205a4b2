#include "bench/precision_chart.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include "bench/label_places.h"
#include "bench/precision_series.h"
#include "chart/canvas.h"
#include "chart/display_text.h"

namespace cellcrush::bench {
namespace {

using client::Rectangle;

const std::string kBenchFolder = CELLCRUSH_BENCH_FOLDER;

class PrecisionCharts : public ::testing::Test {
 public:
  PrecisionCharts(const PrecisionCharts&) = delete;
  PrecisionCharts& operator=(const PrecisionCharts&) = delete;

 protected:
  PrecisionCharts() {
    std::string pattern = (std::filesystem::temp_directory_path() / "cellcrush-chart-XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~PrecisionCharts() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string file() const { return folder_ / "chart.svg"; }

  [[nodiscard]] std::string picture() const {
    std::ostringstream text;
    text << std::ifstream(file()).rdbuf();
    return text.str();
  }

  std::vector<VariedScene> scenes_ = read_variants(kBenchFolder + "/work_precision.txt");
  std::vector<CsvRow> rows_ = read_csv(kBenchFolder + "/results/work_precision.csv");

 private:
  std::filesystem::path folder_;
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
  draw_overview(file(), scenes_.front(), rows_, kConverged, "Type I at 100 m/s");
  const std::string drawn = picture();
  expect_no_text_on_another(drawn);
  for (int family = 0; family < kFamilyCount; ++family) {
    EXPECT_EQ(count_of(">" + name_of(static_cast<Family>(family)) + "<", drawn), 1);
  }
  EXPECT_EQ(count_of(">8 (reference)<", drawn), 1);
  EXPECT_EQ(count_of(">2 (default)<", drawn), 1);
  EXPECT_EQ(count_of(">Type I at 100 m/s<", drawn), 1);
}

TEST_F(PrecisionCharts, OfAllMeasuresHaveNoTextOnAnother) {
  for (const VariedScene& scene : scenes_) {
    draw_precisions(file(), scene, rows_, kConverged);
    const std::string drawn = picture();
    expect_no_text_on_another(drawn);
    for (const Variant& variant : scene.variants) {
      const std::string label = variant.name == kConverged ? "8" : label_of(variant.name);
      EXPECT_GE(count_of(">" + label, drawn), static_cast<int>(kMeasures.size())) << scene.name << " " << variant.name;
    }
  }
}

}  // namespace
}  // namespace cellcrush::bench
