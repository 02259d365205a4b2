#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "push/crush.h"
#include "scene/solid_area.h"

namespace cellcrush {

/// Finds the greatest filtered stress at the impact plate: its mean over the time in which the plate travels
/// Summary::kPeakWindow of the undeformed length, from the impulse of the plate. A penalty contact vibrates, so the
/// greatest force of a step, or of an interval between samples, follows the step or the interval. It looks every so
/// many steps, whatever samples and checkpoints are taken, and not past the strain at which the lattice is closed.
class PeakWatch {
 public:
  /// Steps from look to look: about kLooks in a window at the greatest speed. REQUIRES: is_crushed().
  [[nodiscard]] static std::int64_t interval(const Scene& scene) {
    const double steps = Summary::kPeakWindow * scene.length / (crush_speed_of(scene) * scene.schedule.time_step);
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(steps / kLooks, 1e15)));
  }

  /// REQUIRES: calls at ascending times.
  void look(const Scene& scene, const State& state) {
    const double window = Summary::kPeakWindow * scene.length;
    const double travel = crush_travel_of(scene, state);
    if (is_past_closing(scene, travel / scene.length)) return;
    // A plate that is slowed down by control, or that rises to its speed, takes more steps for a window.
    if (travel - looks_.back().travel < window / (2.0 * kLooks)) return;
    const double impulse = impact_impulse_of(scene, state);
    looks_.push_back({travel, state.time, impulse});
    const double begin = travel - window;
    if (begin < 0.0) return;
    while (looks_[1].travel <= begin) looks_.erase(looks_.begin());
    const double part = (begin - looks_[0].travel) / (looks_[1].travel - looks_[0].travel);
    const double since = std::lerp(looks_[0].time, looks_[1].time, part);
    const double before = std::lerp(looks_[0].impulse, looks_[1].impulse, part);
    const double stress = (impulse - before) / ((state.time - since) * scene.width * scene.depth);
    if (stress > peak_.stress) peak_ = {stress, travel / scene.length - 0.5 * Summary::kPeakWindow};
  }

  /// So far; a stress of 0 before the first window is complete.
  [[nodiscard]] const PeakStress& peak() const { return peak_; }

  /// Calls visitor(field) for all data that a look passes on to the next one.
  template <class Visitor>
  void visit_memory(Visitor&& visitor) {
    visitor(looks_);
    visitor(peak_);
  }

 private:
  static constexpr double kLooks = 4.0;

  struct Look {
    double travel = 0.0;   ///< mm, of the impact plate
    double time = 0.0;     ///< s
    double impulse = 0.0;  ///< N s, of the impact plate
  };

  std::vector<Look> looks_ = std::vector<Look>(1);  ///< the first is at or before the beginning of the window
  PeakStress peak_;
};

}  // namespace cellcrush
