#include "chart/job_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "chart/colour_map.h"
#include "chart/lattice_drawing.h"
#include "terminal/case_text.h"
#include "terminal/number_text.h"

namespace cellcrush::client {

namespace {

constexpr double kWidth = 1000.0;
constexpr double kMargin = 26.0;
constexpr double kInner = kWidth - 2.0 * kMargin;
constexpr double kTitleHeight = 50.0;
constexpr double kColourBarRoom = 380.0;  // of the subtitle's line
constexpr double kChartHeight = 400.0;
constexpr double kStageTitle = 20.0;
constexpr double kGap = 14.0;
constexpr double kTallestStage = 520.0;
constexpr double kWideAspect = 1.7;
const TextStyle kTitleStyle{.size = 18.0, .bold = true};
const TextStyle kSubtitleStyle{.size = 12.5, .colour = kMutedInk};

// Where the stages of a picture stand.
struct StageLayout {
  std::vector<Rectangle> places;  ///< of the drawings, titles not included
  double bottom = 0.0;
};

StageLayout lay_stages(const Box& box, std::size_t count, double top) {
  StageLayout layout{{}, top};
  const double aspect = box.width() / box.height();
  const bool stacked = count == 1 || aspect >= kWideAspect;
  const double columns = stacked ? 1.0 : static_cast<double>(count);
  const double width = (kInner - (columns - 1.0) * kGap) / columns;
  const double height = std::min(width / aspect, kTallestStage);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = stacked ? kMargin : kMargin + static_cast<double>(i) * (width + kGap);
    const double y = stacked ? top + static_cast<double>(i) * (kStageTitle + height + kGap) : top;
    layout.places.push_back({x, y + kStageTitle, width, height});
    layout.bottom = y + kStageTitle + height + kGap;
  }
  return layout;
}

void draw_title(cairo_t* context, const std::string& title, const std::string& subtitle) {
  draw_text(context, kMargin, kMargin + 14.0, fit_text(context, title, kInner, kTitleStyle), kTitleStyle);
  draw_text(context, kMargin, kMargin + 36.0, fit_text(context, subtitle, kInner - kColourBarRoom, kSubtitleStyle),
            kSubtitleStyle);
}

void draw_stages(cairo_t* context, const StageLayout& layout, const Box& box, const std::vector<MeshFrame>& stages) {
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Rectangle& place = layout.places[i];
    const v1::FieldFrame& frame = stages[i].frame;
    const std::string time = frame.time_s() > 0 ? fmt::format(", {} ms", number_text(1e3 * frame.time_s())) : "";
    draw_text(context, place.x, place.y - 5.0, fmt::format("strain {:.2f}{}", frame.strain(), time), {.size = 12.5});
    draw_lattice(context, place, box, stages[i]);
  }
}

std::string subtitle_of(const v1::Job& job) {
  const std::string scene = scene_text(job.case_());
  std::string text = scene.empty() ? job.name() : scene + "   (" + job.name() + ")";
  if (job.state() != v1::SUCCEEDED) text += ", " + v1::JobState_Name(job.state());
  return text;
}

}  // namespace

std::string render_job_picture(PictureFormat format, const JobHistory& history, const std::vector<MeshFrame>& stages) {
  constexpr double kTop = kMargin + kTitleHeight;
  const Box box = stages.empty() ? Box{} : find_box(stages);
  const StageLayout layout = stages.empty() ? StageLayout{{}, kTop} : lay_stages(box, stages.size(), kTop);
  const double height = layout.bottom + kChartHeight + kMargin;
  return render_picture(format, kWidth, height, [&](cairo_t* context) {
    draw_title(context, picture_name(history.job), subtitle_of(history.job));
    if (!stages.empty()) {
      draw_colour_bar(context, kWidth - kMargin - 6.0, kMargin + 26.0, 150.0, "plastic fraction of the wall");
      draw_stages(context, layout, box, stages);
    }
    draw_chart(context, {kMargin, layout.bottom, kInner, kChartHeight}, build_job_chart(history));
  });
}

std::string render_comparison_picture(PictureFormat format, const std::vector<JobHistory>& histories) {
  const double height =
      kMargin + kTitleHeight + 1.2 * kChartHeight + 20.0 * static_cast<double>(histories.size()) + kMargin;
  return render_picture(format, kWidth, height, [&](cairo_t* context) {
    draw_title(context, fmt::format("{} runs compared", histories.size()), "plate stress against nominal strain");
    const double top = kMargin + kTitleHeight;
    draw_chart(context, {kMargin, top, kInner, height - top - kMargin}, build_comparison_chart(histories));
  });
}

}  // namespace cellcrush::client
