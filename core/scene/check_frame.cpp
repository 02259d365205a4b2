#include "scene/check_frame.h"

#include <cmath>

namespace cellcrush {
namespace {

class FrameChecker {
 public:
  FrameChecker(const FrameLattice& frame, FieldChecker& check) : frame_(frame), check_(check) {}

  void check_nodes() {
    if (frame_.nodes.size() < 2) {
      check_.add("lattice.frame.nodes", std::to_string(frame_.nodes.size()), "are too few.",
                 "Give at least two nodes.");
    }
    for (std::size_t i = 0; i < frame_.nodes.size(); ++i) {
      const std::string path = "lattice.frame.nodes[" + std::to_string(i) + "].";
      const FrameLattice::Node& node = frame_.nodes[i];
      check_.in_range(path + "x_mm", node.x_mm, {-1e9, 1e9}, " mm");
      check_.in_range(path + "y_mm", node.y_mm, {-1e9, 1e9}, " mm");
      check_.in_range(path + "attached_mass_g", node.attached_mass_g, {0.0, 1e12}, " g");
      check_.in_range(path + "attached_inertia_g_mm2", node.attached_inertia_g_mm2, {0.0, 1e15}, " g mm2");
    }
  }

  void check_beams() {
    if (frame_.beams.empty()) {
      check_.add("lattice.frame.beams", "", "are missing.", "Give at least one beam.");
    }
    for (std::size_t i = 0; i < frame_.beams.size(); ++i) {
      const std::string path = "lattice.frame.beams[" + std::to_string(i) + "].";
      const FrameLattice::Beam& beam = frame_.beams[i];
      const bool ends = node_exists(path + "start", beam.start) && node_exists(path + "end", beam.end);
      check_.positive(path + "thickness_mm", beam.thickness_mm, " mm");
      if (beam.elements) {
        check_.in_range(path + "elements", beam.elements, {1, 10000}, "");
      }
      if (ends && length_of(beam) == 0.0) {
        check_.add(path + "end", std::to_string(beam.end), "makes a beam without length.",
                   "Join nodes at different places.");
      }
    }
  }

  void check_loads() {
    for (std::size_t i = 0; i < frame_.supports.size(); ++i) {
      node_exists("lattice.frame.supports[" + std::to_string(i) + "].node", frame_.supports[i].node);
    }
    for (std::size_t i = 0; i < frame_.initial_velocities.size(); ++i) {
      node_exists("lattice.frame.initial_velocities[" + std::to_string(i) + "].node",
                  frame_.initial_velocities[i].node);
    }
    for (std::size_t i = 0; i < frame_.loads.size(); ++i) {
      const std::string path = "lattice.frame.loads[" + std::to_string(i) + "].";
      node_exists(path + "node", frame_.loads[i].node);
      const auto& points = frame_.loads[i].points;
      bool ordered = !points.empty();
      for (std::size_t k = 0; k < points.size(); ++k) {
        ordered = ordered && std::isfinite(points[k].first) && std::isfinite(points[k].second) &&
                  (k == 0 || points[k - 1].first < points[k].first);
      }
      if (!ordered) {
        check_.add(path + "force_n_or_n_mm.points", "", "are not a function of time.",
                   "Give at least one point, finite values, and times that ascend.");
      }
    }
    check_.positive("lattice.frame.end_time_s", frame_.end_time_s, " s");
  }

 private:
  bool node_exists(const std::string& field, int node) {
    if (node >= 0 && node < static_cast<int>(frame_.nodes.size())) {
      return true;
    }
    check_.add(field, std::to_string(node), "is no node of the frame.", "Name one of lattice.frame.nodes.");
    return false;
  }

  [[nodiscard]] double length_of(const FrameLattice::Beam& beam) const {
    const FrameLattice::Node& start = frame_.nodes[beam.start];
    const FrameLattice::Node& end = frame_.nodes[beam.end];
    return std::hypot(end.x_mm - start.x_mm, end.y_mm - start.y_mm);
  }

  const FrameLattice& frame_;
  FieldChecker& check_;
};

}  // namespace

void check_frame(const FrameLattice& frame, FieldChecker& check) {
  FrameChecker checker(frame, check);
  checker.check_nodes();
  checker.check_beams();
  checker.check_loads();
}

}  // namespace cellcrush
