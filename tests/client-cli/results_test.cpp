#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "chart/smoothing.h"
#include "results/field_value.h"
#include "results/sweep_results.h"

namespace cellcrush::client {
namespace {

TEST(QuadraticFit, HasTheLeastSumOfSquares) {
  const std::vector<double> x = {0.0, 1.0, 2.0, 3.0, 4.0};
  const std::vector<double> y = {1.0, 0.0, 4.0, 3.0, 9.0};
  const auto fit = find_quadratic_fit(x, y);
  ASSERT_TRUE(fit.has_value());
  const auto squares = [&](double constant, double linear, double quadratic) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += std::pow(y[i] - constant - linear * x[i] - quadratic * x[i] * x[i], 2);
    return sum;
  };
  const double least = squares(fit->constant, fit->linear, fit->quadratic);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_GT(squares(fit->constant + step, fit->linear, fit->quadratic), least);
    EXPECT_GT(squares(fit->constant, fit->linear + step, fit->quadratic), least);
    EXPECT_GT(squares(fit->constant, fit->linear, fit->quadratic + step), least);
  }
}

TEST(QuadraticFit, NeedsThreeDifferentFinitePoints) {
  EXPECT_FALSE(find_quadratic_fit({1.0, 2.0}, {1.0, 2.0}).has_value());
  EXPECT_FALSE(find_quadratic_fit({1.0, 2.0, 2.0, 1.0}, {1.0, 2.0, 3.0, 4.0}).has_value());
  EXPECT_FALSE(find_quadratic_fit({1.0, 2.0, 3.0}, {1.0, 2.0, std::nan("")}).has_value());
  EXPECT_TRUE(find_quadratic_fit({1.0, 2.0, 3.0}, {1.0, 2.0, 5.0}).has_value());
}

TEST(FieldValue, IsFoundByItsPath) {
  v1::Case scene;
  scene.mutable_loading()->set_speed_m_per_s(50.0);
  scene.mutable_lattice()->mutable_imperfection()->set_seed(7);
  scene.mutable_lattice()->mutable_hexagon()->set_columns(12);
  EXPECT_EQ(field_value_text(scene, "loading.speed_m_per_s"), "50");
  EXPECT_EQ(field_value_text(scene, "lattice.imperfection.seed"), "7");
  EXPECT_EQ(field_value_text(scene, "lattice.hexagon.columns"), "12");
  for (const char* path : {"", ".", "loading", "loading.", "loading.sped", "depth_mm", "lattice.square.columns",
                           "loading.speed_m_per_s.x", "title"}) {
    EXPECT_EQ(field_value_text(scene, path), "") << path;
  }
}

TEST(FieldValue, HasAName) {
  EXPECT_EQ(words_of("loading.speed_m_per_s").name, "speed");
  EXPECT_EQ(words_of("loading.speed_m_per_s").unit, "m/s");
  EXPECT_EQ(words_of("lattice.hexagon.wall_thickness_mm").name, "wall thickness");
  EXPECT_EQ(words_of("elements_per_wall").unit, "");
  EXPECT_EQ(words_of("material.density_kg_per_m3").unit, "kg/m³");
}

v1::SweepTable grid() {
  v1::SweepTable table;
  table.add_fields("loading.speed_m_per_s");
  table.add_fields("depth_mm");
  for (const double speed : {100.0, 50.0}) {
    for (const double depth : {1.0, 2.0}) {
      auto& row = *table.add_rows();
      row.add_values(speed);
      row.add_values(depth);
      row.mutable_result()->set_state(v1::Job::SUCCEEDED);
      row.mutable_result()->mutable_summary()->set_plateau_stress_impact_mpa(speed + depth);
      row.mutable_result()->mutable_summary()->set_plateau_stress_support_mpa(0.4);
    }
  }
  return table;
}

TEST(ResultSeries, SplitByTheLaterFieldsAndAscendInTheFirst) {
  v1::SweepTable table = grid();
  table.mutable_rows(3)->mutable_result()->set_state(v1::Job::FAILED);
  const auto all = split_series(table);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].name, "depth = 1 mm");
  EXPECT_EQ(all[0].x, (std::vector<double>{50.0, 100.0}));
  EXPECT_EQ(all[0].summaries[1]->plateau_stress_impact_mpa(), 101.0);
  EXPECT_EQ(all[1].x, (std::vector<double>{100.0}));
  EXPECT_FALSE(find_plateau_fit(all[0]).has_value());
}

}  // namespace
}  // namespace cellcrush::client
