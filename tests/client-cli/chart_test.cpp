#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "chart/axes.h"
#include "chart/colour_map.h"
#include "chart/lattice_drawing.h"
#include "chart/smoothing.h"
#include "expect_text.h"
#include "plots/job_curves.h"
#include "plots/job_picture.h"
#include "programs/text_proto.h"
#include "synthetic_crush.h"

namespace cellcrush::client {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

using testing::expect_parts_in;
using testing::synthetic_samples;
using testing::synthetic_stage;

TEST(Ticks, AreRoundAndNotTooMany) {
  for (const double high : {0.013, 0.8, 1.0, 7.3, 45.0, 999.0, 12345.0}) {
    for (const int most : {2, 5, 11}) {
      const Ticks ticks = find_ticks(0.0, high, most);
      ASSERT_LE(static_cast<int>(ticks.values.size()), most);
      ASSERT_GE(ticks.values.size(), 1U);
      double mantissa = ticks.step;
      while (mantissa < 0.999) mantissa *= 10.0;
      while (mantissa > 9.999) mantissa /= 10.0;
      const double nearest = mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : 5.0;
      EXPECT_NEAR(mantissa, nearest, 1e-9) << high;
      EXPECT_GE(ticks.values.front(), 0.0);
      EXPECT_LE(ticks.values.back(), high * (1 + 1e-9));
    }
  }
  EXPECT_EQ(find_ticks(0.0, 0.8, 10).values.size(), 9U);
}

TEST(Ticks, LabelsHaveTheDecimalsOfTheirStep) {
  EXPECT_EQ(tick_label(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tick_label(0.25, 0.05), "0.25");
  EXPECT_EQ(tick_label(200.0, 50.0), "200");
  EXPECT_EQ(tick_label(-1e-17, 0.1), "0.0");
}

TEST(Ticks, OfALogarithmicAxisAreDecadesWithTheirDoublesAndFivesWhereThereIsRoom) {
  EXPECT_EQ(find_logarithmic_ticks(0.5, 25.0, 8).values, (std::vector<double>{0.5, 1.0, 2.0, 5.0, 10.0, 20.0}));
  EXPECT_EQ(find_logarithmic_ticks(0.5, 25.0, 3).values, (std::vector<double>{1.0, 10.0}));
  EXPECT_EQ(find_logarithmic_ticks(1.0, 1e6, 3).values, (std::vector<double>{1.0, 1e3, 1e6}));
  EXPECT_EQ(logarithmic_tick_label(0.002), "0.002");
  EXPECT_EQ(logarithmic_tick_label(600000.0), "600000");
}

TEST(Ticks, AreTwoAtLeastOnEveryAxis) {
  for (const double low : {0.0021, 0.9, 1.1, 2.05, 6.0, 12.0, 61.0}) {
    for (const double ratio : {1.02, 1.3, 2.2, 5.0, 30.0, 900.0, 2e5}) {
      for (const int most : {2, 3, 4, 9}) {
        const double high = ratio * low;
        for (const Ticks& ticks : {find_logarithmic_ticks(low, high, most), find_ticks(low, high, most)}) {
          EXPECT_GE(ticks.values.size(), 2U) << low << ' ' << ratio << ' ' << most;
          EXPECT_LE(static_cast<int>(ticks.values.size()), most) << low << ' ' << ratio << ' ' << most;
          EXPECT_GE(ticks.values.front(), low * (1 - 1e-8));
          EXPECT_LE(ticks.values.back(), high * (1 + 1e-8));
        }
      }
    }
  }
}

TEST(Axes, OfALogarithmicScaleGiveEqualRatiosEqualRoom) {
  const Axes axes({0.0, 0.0, 300.0, 100.0}, {1.0, 1000.0, "x", true}, {0.0, 2.0, "y"});
  EXPECT_NEAR(axes.x(10.0), 100.0, 1e-9);
  EXPECT_NEAR(axes.x(100.0), 200.0, 1e-9);
  EXPECT_NEAR(axes.y(0.5), 75.0, 1e-9);
}

TEST(Smoothing, KeepsAStraightLineAndRemovesAnAlternation) {
  std::vector<double> x;
  std::vector<double> line;
  std::vector<double> alternating;
  for (int i = 0; i <= 100; ++i) {
    x.push_back(0.01 * i);
    line.push_back(3.0 * i);
    alternating.push_back(i % 2 == 0 ? 1.0 : -1.0);
  }
  EXPECT_NEAR(running_mean(x, line, 0.1005)[50], 150.0, 1e-9);
  EXPECT_LT(std::abs(running_mean(x, alternating, 0.2)[50]), 0.1);
  EXPECT_EQ(quantile({4.0, 1.0, 3.0, 2.0, 5.0}, 0.5), 3.0);
}

TEST(ColourMap, GrowsBrighterAndStaysReadableOnWhite) {
  double before = -1.0;
  for (int i = 0; i <= 100; ++i) {
    const Colour colour = map_colour(0.01 * i);
    const double brightness = 0.2126 * colour.red + 0.7152 * colour.green + 0.0722 * colour.blue;
    EXPECT_GT(brightness, before - 0.005);
    EXPECT_LT(brightness, 0.7);
    before = brightness;
  }
}

TEST(LatticeDrawing, TheBoxHoldsAllStagesAndBothPlatesAtTheStart) {
  const Box box = find_box({lattice_stage(synthetic_stage(10, 4, 0.2)), lattice_stage(synthetic_stage(10, 4, 0.6))});
  EXPECT_LT(box.low_x, 0.0);
  EXPECT_GT(box.high_x, 10 * 4 * std::sqrt(3.0));
  EXPECT_LT(box.low_y, 0.0);
  EXPECT_GT(box.high_y, (1.5 * 4 + 0.5) * 4);
}

struct Pixels {
  int width = 0;
  int height = 0;
  std::set<std::uint32_t> colours;
};

Pixels read_png(const std::string& bytes) {
  std::pair<const char*, std::size_t> rest(bytes.data(), bytes.size());
  const auto read = [](void* closure, unsigned char* data, unsigned int length) {
    auto& source = *static_cast<std::pair<const char*, std::size_t>*>(closure);
    if (source.second < length) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, source.first, length);
    source.first += length;
    source.second -= length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &rest);
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  Pixels pixels{cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), {}};
  const unsigned char* data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < pixels.height; ++y) {
    for (int x = 0; x < pixels.width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel, data + y * stride + 4 * x, 4);
      pixels.colours.insert(pixel & 0xFFFFFF);
    }
  }
  cairo_surface_destroy(surface);
  return pixels;
}

JobHistory make_history() {
  return {cellcrush::testing::from_text<v1::Job>(R"(name: "jobs/a" state: SUCCEEDED words { plates: true }
            summary { plateau_window_low: 0.2 plateau_window_high: 0.4 plateau_stress_impact_mpa: 3.4 })"),
          synthetic_samples(500, 0.8)};
}

TEST(Picture, APngShowsLatticeAndCurve) {
  const Pixels with = read_png(render_job_picture(PictureFormat::png, make_history(), {synthetic_stage(20, 6, 0.4)}));
  const Pixels without = read_png(render_job_picture(PictureFormat::png, make_history(), {}));
  EXPECT_EQ(with.width, 1000 * kPixelsPerUnit);
  EXPECT_GT(with.height, without.height);
  EXPECT_GT(without.colours.size(), 50U);
  EXPECT_GT(with.colours.size(), without.colours.size() + 200);
}

TEST(Picture, RigidElementsHaveTheColourOfThePlates) {
  const std::string stroke = "stroke(:|=.)rgb.35%, ?36%, ?40%";
  MeshFrame stage = synthetic_stage(10, 4, 0.3);
  EXPECT_THAT(render_job_picture(PictureFormat::svg, make_history(), {stage}), Not(ContainsRegex(stroke)));
  stage.mesh.set_rigid_element_count(3);
  EXPECT_THAT(render_job_picture(PictureFormat::svg, make_history(), {stage}), ContainsRegex(stroke));
}

TEST(Picture, ParticlesOfWallsThatOverlappedHaveRings) {
  const std::string stroke = "stroke(:|=.)rgb.80%, ?15%, ?55%";
  MeshFrame stage = synthetic_stage(10, 4, 0.3);
  EXPECT_THAT(render_job_picture(PictureFormat::svg, make_history(), {stage}), Not(ContainsRegex(stroke)));
  stage.mesh.add_overlap_particle(5);
  EXPECT_THAT(render_job_picture(PictureFormat::svg, make_history(), {stage}), ContainsRegex(stroke));
}

TEST(NodeChart, ShowsHowTheWatchedNodesOfAFrameMoved) {
  JobHistory history;
  history.job.mutable_case_()->mutable_lattice()->mutable_frame()->set_end_time_s(0.02);
  for (int i = 0; i <= 20; ++i) {
    v1::Sample& sample = history.samples.emplace_back();
    sample.set_time_s(1e-3 * i);
    sample.set_energy_kinetic_mj(i);
    sample.add_watched()->set_node("tip");
    sample.mutable_watched(0)->set_uy_mm(-0.1 * i);
  }
  const Chart moved = build_node_chart(history);
  ASSERT_EQ(moved.curves.size(), 1U);
  EXPECT_EQ(moved.curves[0].name, "y of tip");
  EXPECT_NEAR(moved.curves[0].y.back(), -2.0, 1e-12);
  EXPECT_NEAR(moved.x.high, 20.0, 1e-9);
  EXPECT_LT(moved.y.low, -2.0);
  EXPECT_FALSE(render_job_picture(PictureFormat::png, history, {}).empty());
  for (v1::Sample& sample : history.samples) sample.clear_watched();
  EXPECT_EQ(build_node_chart(history).y.label, "energy (mJ)");
}

TEST(Picture, AnSvgHasTextThatCanBeSelectedAndAPdfIsOne) {
  JobHistory history = make_history();
  history.job.mutable_case_()->set_title("Cells < 4 mm & more");
  const std::string svg = render_job_picture(PictureFormat::svg, history, {synthetic_stage(10, 4, 0.3, true)});
  expect_parts_in(svg, {"<svg", "<path", "</svg>"});
  EXPECT_THAT(svg, HasSubstr(">Cells &lt; 4 mm &amp; more (jobs/a)</text>"));
  EXPECT_THAT(svg, HasSubstr(">nominal stress (MPa)</text>"));
  EXPECT_THAT(svg, Not(HasSubstr("<symbol"))) << "no glyphs are drawn";
  EXPECT_EQ(render_job_picture(PictureFormat::pdf, history, {}).substr(0, 5), "%PDF-");
}

TEST(JobChart, TheStressAxisFollowsThePlateauAndAnArrowSaysHowHighTheFirstWaveGoes) {
  JobHistory history = make_history();
  history.samples.clear();
  for (int i = 0; i <= 800; ++i) {
    v1::Sample& sample = history.samples.emplace_back();
    sample.set_strain(1e-3 * i);
    sample.set_stress_impact_mpa(i < 40 ? 50.0 : 3.4);
  }
  v1::Summary& summary = *history.job.mutable_summary();
  summary = from_text<v1::Summary>(
      "plateau_stress_impact_mpa: 3.4 densification_strain: 0.62 theory { shock_mpa: 3.5 }"
      "warnings { kind: WALLS_NECK strain: 0.7 } warnings { kind: BORDERS_NEAR strain: 0.3 }"
      "valid_to_strain: 0.72 warnings { kind: CLOSED strain: 0.72 }");
  const Chart chart = build_job_chart(history);
  ASSERT_EQ(chart.marks.size(), 2U) << "near borders put nothing in doubt";
  EXPECT_EQ(chart.marks[0].text, "densification 0.62");
  EXPECT_EQ(chart.marks[1].text, "in doubt: walls neck");
  ASSERT_FALSE(chart.bands.empty());
  EXPECT_EQ(chart.bands.back().text, "closed");
  EXPECT_NEAR(chart.bands.back().from, 0.72, 1e-12);
  summary.clear_densification_strain();
  summary.set_other_rise_strain(0.62);
  summary.set_other_rise_words("second collapse");
  EXPECT_EQ(build_job_chart(history).marks[0].text, "second collapse 0.62");
  EXPECT_NEAR(chart.bands.back().to, 0.8, 1e-12);
  EXPECT_THAT(chart.note, HasSubstr("Eq. 52: no front"));
  EXPECT_GT(chart.y.high, 3.4);
  EXPECT_LT(chart.y.high, 8.0);
  ASSERT_EQ(chart.overshoots.size(), 1U);
  EXPECT_EQ(chart.overshoots[0].text, "50 MPa");
  EXPECT_LT(chart.overshoots[0].x, 0.04);
}

TEST(Picture, OddDataIsDrawnAndDoesNoHarm) {
  JobHistory history = make_history();
  history.samples.resize(1);
  EXPECT_FALSE(render_job_picture(PictureFormat::png, history, {}).empty());
  history.samples[0].set_stress_impact_mpa(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(render_job_picture(PictureFormat::png, history, {}).empty());
  MeshFrame stage = synthetic_stage(4, 2, 0.1);
  stage.frame.set_position_mm(4, std::numeric_limits<float>::infinity());
  EXPECT_FALSE(render_job_picture(PictureFormat::png, history, {stage}).empty());
  EXPECT_FALSE(render_comparison_picture(PictureFormat::png, {history, make_history()}).empty());
}

}  // namespace
}  // namespace cellcrush::client
