#include "scene/check_frame.h"

#include <cmath>

#include "scene/mesh_size.h"

namespace cellcrush {
namespace {

class FrameChecker {
 public:
  FrameChecker(const FrameLattice& frame, int elements_per_wall, FieldChecker& check)
      : frame_(frame), elements_per_wall_(elements_per_wall), check_(check) {}

  void check_nodes() {
    if (frame_.nodes.size() < 2) {
      check_.add("lattice.frame.nodes", std::to_string(frame_.nodes.size()), "are too few.",
                 "Give at least two nodes.");
    }
    for (std::size_t i = 0; i < frame_.nodes.size(); ++i) {
      const std::string path = item("nodes", i);
      const FrameLattice::Node& node = frame_.nodes[i];
      check_.in_range(path + "x_mm", node.x_mm, {-1e9, 1e9}, " mm");
      check_.in_range(path + "y_mm", node.y_mm, {-1e9, 1e9}, " mm");
      check_.in_range(path + "attached_mass_g", node.attached_mass_g, {0.0, 1e12}, " g");
      check_.in_range(path + "attached_inertia_g_mm2", node.attached_inertia_g_mm2, {0.0, 1e15}, " g mm2");
    }
  }

  void check_beams() {
    std::vector<bool> joined(frame_.nodes.size(), false);
    if (frame_.beams.empty()) {
      check_.add("lattice.frame.beams", "", "are missing.", "Give at least one beam.");
    }
    for (std::size_t i = 0; i < frame_.beams.size(); ++i) {
      const std::string path = item("beams", i);
      const FrameLattice::Beam& beam = frame_.beams[i];
      const bool ends = node_exists(path + "start", beam.start) && node_exists(path + "end", beam.end);
      check_.positive(path + "thickness_mm", beam.thickness_mm, " mm");
      if (beam.elements) {
        check_.in_range(path + "elements", beam.elements, {1, 10000}, "");
      }
      if (beam.material) {
        check_material(path + "material.", *beam.material, check_);
      }
      if (ends && length_of(beam) == 0.0) {
        check_.add(path + "end", std::to_string(beam.end), "gives the beam zero length.",
                   "Connect two nodes at different positions.");
      }
      if (ends) {
        joined[beam.start] = joined[beam.end] = true;
      }
    }
    check_size(count_elements(frame_, elements_per_wall_));
    for (std::size_t i = 0; i < frame_.nodes.size(); ++i) {
      if (!joined[i]) {
        check_.add("lattice.frame.nodes[" + std::to_string(i) + "]", "", "belongs to no beam.",
                   "Connect it to a beam, or remove it.");
      }
    }
  }

  void check_size(double elements) {
    if (elements > kMostElements) {
      check_.add(
          "lattice.frame.beams", std::to_string(frame_.beams.size()),
          "make " + std::to_string(static_cast<std::int64_t>(elements)) + " elements.",
          "Keep the total number of elements at or below " + std::to_string(static_cast<int>(kMostElements)) + ".");
    }
  }

  void check_supports() {
    for (std::size_t i = 0; i < frame_.supports.size(); ++i) {
      node_exists(item("supports", i) + "node", frame_.supports[i].node);
    }
    for (std::size_t i = 0; i < frame_.initial_velocities.size(); ++i) {
      const std::string path = item("initial_velocities", i);
      const FrameLattice::InitialVelocity& velocity = frame_.initial_velocities[i];
      node_exists(path + "node", velocity.node);
      check_.in_range(path + "x_m_per_s", velocity.x_m_per_s, {-1e6, 1e6}, " m/s");
      check_.in_range(path + "y_m_per_s", velocity.y_m_per_s, {-1e6, 1e6}, " m/s");
      check_.in_range(path + "rotation_rad_per_s", velocity.rotation_rad_per_s, {-1e9, 1e9}, " rad/s");
    }
    for (std::size_t i = 0; i < frame_.watched_nodes.size(); ++i) {
      node_exists("lattice.frame.watched_nodes[" + std::to_string(i) + "]", frame_.watched_nodes[i]);
    }
  }

  void check_loads() {
    for (std::size_t i = 0; i < frame_.loads.size(); ++i) {
      const std::string path = item("loads", i);
      node_exists(path + "node", frame_.loads[i].node);
      function_of_time(path + "force_n_or_n_mm", frame_.loads[i].points);
    }
    for (std::size_t i = 0; i < frame_.distributed_loads.size(); ++i) {
      const std::string path = item("distributed_loads", i);
      const FrameLattice::DistributedLoad& load = frame_.distributed_loads[i];
      if (load.beam < 0 || load.beam >= static_cast<int>(frame_.beams.size())) {
        check_.add(path + "beam", std::to_string(load.beam), "is not a beam of the frame.",
                   "Give an index into lattice.frame.beams, counting from 0.");
      }
      if (!load.x_points.empty() || load.y_points.empty()) {
        function_of_time(path + "x_n_per_mm", load.x_points);
      }
      if (!load.y_points.empty()) {
        function_of_time(path + "y_n_per_mm", load.y_points);
      }
    }
    check_.in_range("lattice.frame.gravity_x_m_per_s2", frame_.gravity_x_m_per_s2, {-1e9, 1e9}, " m/s2");
    check_.in_range("lattice.frame.gravity_y_m_per_s2", frame_.gravity_y_m_per_s2, {-1e9, 1e9}, " m/s2");
    check_.in_range("lattice.frame.end_time_s", frame_.end_time_s, {1e-12, 1e12}, " s");
  }

  void check_motions() {
    for (std::size_t i = 0; i < frame_.motions.size(); ++i) {
      const std::string path = item("motions", i);
      const FrameLattice::NodalMotion& motion = frame_.motions[i];
      function_of_time(path + "displacement_mm_or_rad", motion.points);
      if (node_exists(path + "node", motion.node)) {
        check_single_motion(path, i);
      }
    }
  }

 private:
  static std::string item(const char* list, std::size_t position) {
    return "lattice.frame." + std::string(list) + "[" + std::to_string(position) + "].";
  }

  /// A motion of a node is given only once, and is not held by a support as well.
  void check_single_motion(const std::string& path, std::size_t index) {
    const FrameLattice::NodalMotion& motion = frame_.motions[index];
    for (std::size_t other = 0; other < index; ++other) {
      if (frame_.motions[other].node == motion.node && frame_.motions[other].component == motion.component) {
        check_.add(path + "component", "", "of this node already has another motion.",
                   "Give one motion per node and component.");
        break;
      }
    }
    for (const FrameLattice::Support& support : frame_.supports) {
      const bool held = motion.component == FrameLattice::Component::x   ? support.fix_x
                        : motion.component == FrameLattice::Component::y ? support.fix_y
                                                                         : support.fix_rotation;
      if (support.node == motion.node && held) {
        check_.add(path + "component", "", "of this node is held by a support.",
                   "Release it in the support, or remove the motion.");
        break;
      }
    }
  }

  void function_of_time(const std::string& field, const FrameLattice::TimeFunction& points) {
    bool ordered = !points.empty();
    for (std::size_t k = 0; k < points.size(); ++k) {
      ordered = ordered && std::isfinite(points[k].first) && std::isfinite(points[k].second) &&
                (k == 0 || points[k - 1].first < points[k].first);
    }
    if (!ordered) {
      check_.add(field + ".points", "", "do not define a function of time.",
                 "Give at least one point, with finite values and ascending times.");
    }
  }

  bool node_exists(const std::string& field, int node) {
    if (node >= 0 && node < static_cast<int>(frame_.nodes.size())) {
      return true;
    }
    check_.add(field, std::to_string(node), "is not a node of the frame.", "Name one of lattice.frame.nodes.");
    return false;
  }

  [[nodiscard]] double length_of(const FrameLattice::Beam& beam) const {
    const FrameLattice::Node& start = frame_.nodes[beam.start];
    const FrameLattice::Node& end = frame_.nodes[beam.end];
    return std::hypot(end.x_mm - start.x_mm, end.y_mm - start.y_mm);
  }

  const FrameLattice& frame_;
  int elements_per_wall_;
  FieldChecker& check_;
};

}  // namespace

void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  check.positive(path + "youngs_modulus_mpa", material.youngs_modulus_mpa, " MPa");
  check.positive(path + "yield_stress_mpa", material.yield_stress_mpa, " MPa");
  check.in_range(path + "hardening_modulus_mpa", material.hardening_modulus_mpa, {0.0, 1e12}, " MPa");
  check.in_range(path + "isotropic_fraction", material.isotropic_fraction, {0.0, 1.0}, "");
  check.in_range(path + "poissons_ratio", material.poissons_ratio, {0.0, 0.5}, "");
  check.positive(path + "density_kg_per_m3", material.density_kg_per_m3, " kg/m3");
}

void check_frame(const FrameLattice& frame, int elements_per_wall, FieldChecker& check) {
  FrameChecker checker(frame, elements_per_wall, check);
  checker.check_nodes();
  checker.check_beams();
  checker.check_supports();
  checker.check_loads();
  checker.check_motions();
}

}  // namespace cellcrush
