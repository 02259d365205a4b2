#include "load/scale_chart.h"

#include <algorithm>
#include <utility>

#include "bench/picture_file.h"
#include "chart/chart.h"
#include "chart/palette.h"

namespace cellcrush::load {
namespace {

constexpr double kWidth = 720.0;
constexpr double kHeight = 420.0;
constexpr double kMargin = 12.0;

}  // namespace

void draw_limits(const std::string& file, const std::vector<LimitCurve>& curves) {
  double most_slots = 1.0;
  for (const auto& curve : curves) {
    for (const double slots : curve.slots) most_slots = std::max(most_slots, slots);
  }
  client::Chart chart;
  chart.x = {0.8, 4500.0, "run time of a job (s)", true};
  chart.y = {0.8, 2.0 * most_slots, "slots that one daemon keeps 90 % busy", true};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    client::Curve curve;
    curve.x = curves[i].run_s;
    curve.y = curves[i].slots;
    curve.style = {client::kSeriesColours[i % client::kSeriesColours.size()], 1.6, {}};
    curve.name = curves[i].name;
    curve.marker = client::kSeriesMarkers[i % client::kSeriesMarkers.size()];
    chart.curves.push_back(std::move(curve));
  }
  chart.note = "simulated from figures.csv; above a curve slots wait for the daemon";
  bench::write_picture(file, kWidth, kHeight, [&](cairo_t* context) {
    client::draw_chart(context, {kMargin, kMargin, kWidth - 2.0 * kMargin, kHeight - 2.0 * kMargin}, chart);
  });
}

}  // namespace cellcrush::load
