#include <algorithm>

#include "scene/check_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

class FrameChecker {
 public:
  FrameChecker(const SceneSpec& spec, FieldChecker& check)
      : frame_(std::get<FrameWalls>(spec.lattice)), loads_(spec.loads), check_(check) {}

  void check_nodes() {
    if (frame_.nodes.size() < 2) {
      check_.add("lattice.frame.nodes", std::to_string(frame_.nodes.size()), "are too few.",
                 "Give at least two nodes.");
    }
    visit("nodes", frame_.nodes, [&](const std::string& path, const FrameWalls::Node& node) {
      check_.within_limits(path + ".x_mm", node.x_mm);
      check_.within_limits(path + ".y_mm", node.y_mm);
      check_.within_limits(path + ".attached_mass_g", node.attached_mass_g);
      check_.within_limits(path + ".attached_inertia_g_mm2", node.attached_inertia_g_mm2);
    });
  }

  void check_beams(double elements) {
    if (frame_.beams.empty()) {
      check_.add("lattice.frame.beams", "", "are missing.", "Give at least one beam.");
    }
    std::vector<bool> joined(frame_.nodes.size(), false);
    visit("beams", frame_.beams, [&](const std::string& path, const FrameWalls::Beam& beam) {
      const bool ends = node_exists(path + ".start", beam.start) && node_exists(path + ".end", beam.end);
      check_.within_limits(path + ".thickness_mm", beam.thickness_mm);
      if (beam.elements) {
        check_.within_limits(path + ".elements", beam.elements);
      }
      if (beam.material) {
        check_material(path + ".material.", *beam.material, check_);
      }
      if (ends && has_no_length(beam)) {
        check_.add(path + ".end", std::to_string(beam.end), "gives the beam zero length.",
                   "Connect two nodes at different positions.");
      }
      if (ends) {
        joined[beam.start] = joined[beam.end] = true;
        welded_[beam.start] = welded_[beam.start] || !beam.pin_start;
        welded_[beam.end] = welded_[beam.end] || !beam.pin_end;
      }
    });
    if (elements > kMostElements) {
      check_.add(
          "lattice.frame.beams", std::to_string(frame_.beams.size()),
          "make " + std::to_string(static_cast<std::int64_t>(elements)) + " elements.",
          "Keep the total number of elements at or below " + std::to_string(static_cast<int>(kMostElements)) + ".");
    }
    visit("nodes", joined, [&](const std::string& path, bool is_joined) {
      if (!is_joined) {
        check_.add(path, "", "belongs to no beam.", "Connect it to a beam, or remove it.");
      }
    });
  }

  void check_supports() {
    visit("supports", frame_.supports, [&](const std::string& path, const FrameWalls::Support& support) {
      node_exists(path + ".node", support.node);
    });
    visit("initial_velocities", loads_.initial_velocities,
          [&](const std::string& path, const LoadsSpec::InitialVelocity& velocity) {
            node_exists(path + ".node", velocity.node);
            check_.within_limits(path + ".x_m_per_s", velocity.x_m_per_s);
            check_.within_limits(path + ".y_m_per_s", velocity.y_m_per_s);
            check_.within_limits(path + ".rotation_rad_per_s", velocity.rotation_rad_per_s);
          });
    visit("watched_nodes", frame_.watched_nodes, [&](const std::string& path, int node) { node_exists(path, node); });
  }

  void check_loads() {
    visit("loads", loads_.loads, [&](const std::string& path, const LoadsSpec::NodalLoad& load) {
      check_.is_function_of_time(path + ".force_n_or_n_mm", load.points);
      if (node_exists(path + ".node", load.node) && load.component == LoadsSpec::Component::rotation) {
        check_turns(path + ".component", load.node);
      }
    });
    visit("distributed_loads", loads_.distributed_loads,
          [&](const std::string& path, const LoadsSpec::DistributedLoad& load) {
            if (load.beam < 0 || load.beam >= static_cast<int>(frame_.beams.size())) {
              check_.add(path + ".beam", std::to_string(load.beam), "is not a beam of the frame.",
                         "Give an index into lattice.frame.beams, counting from 0.");
            }
            if (!load.x_points.empty() || load.y_points.empty()) {
              check_.is_function_of_time(path + ".x_n_per_mm", load.x_points);
            }
            if (!load.y_points.empty()) {
              check_.is_function_of_time(path + ".y_n_per_mm", load.y_points);
            }
          });
  }

  void check_extent(const SceneSpec& spec) {
    const auto along = crush_axis_of(spec) == 0 ? &FrameWalls::Node::x_mm : &FrameWalls::Node::y_mm;
    if (has_plates(spec) && !frame_.nodes.empty()) {
      const auto [low, high] = std::ranges::minmax_element(frame_.nodes, {}, along);
      if (!((*high).*along > (*low).*along)) {
        check_.add("lattice.frame.nodes", "", "have no extent along loading.direction, so there is no strain.",
                   "Choose the other direction, or remove loading.");
      }
    }
  }

  void check_motions() {
    visit("motions", loads_.motions, [&](const std::string& path, const LoadsSpec::NodalMotion& motion) {
      check_.is_function_of_time(path + ".displacement_mm_or_rad", motion.points);
      if (node_exists(path + ".node", motion.node)) {
        check_single_motion(path + ".component", motion);
        if (motion.component == LoadsSpec::Component::rotation) {
          check_turns(path + ".component", motion.node);
        }
      }
    });
  }

 private:
  /// Calls check(path, item) for each item of a list of the frame.
  template <class Items, class Check>
  static void visit(const std::string& list, const Items& items, const Check& check) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      check("lattice.frame." + list + "[" + std::to_string(i) + "]", items[i]);
    }
  }

  /// A node to which all beams are pinned has no rotation to load or to impose.
  void check_turns(const std::string& field, int node) {
    if (!welded_[node]) {
      check_.add(field, "", "turns a node to which all beams are pinned.",
                 "Leave out the pin_start or pin_end of a beam at this node, or remove the moment or rotation.");
    }
  }

  /// A motion of a node is given only once, and is not held by a support as well.
  void check_single_motion(const std::string& field, const LoadsSpec::NodalMotion& motion) {
    const auto first = std::ranges::find_if(loads_.motions, [&](const LoadsSpec::NodalMotion& other) {
      return other.node == motion.node && other.component == motion.component;
    });
    if (&*first != &motion) {
      check_.add(field, "", "of this node already has another motion.", "Give one motion per node and component.");
    }
    const bool held = std::ranges::any_of(frame_.supports, [&](const FrameWalls::Support& support) {
      return support.node == motion.node && (motion.component == LoadsSpec::Component::x   ? support.fix_x
                                             : motion.component == LoadsSpec::Component::y ? support.fix_y
                                                                                           : support.fix_rotation);
    });
    if (held) {
      check_.add(field, "", "of this node is held by a support.", "Release it in the support, or remove the motion.");
    }
  }

  bool node_exists(const std::string& field, int node) {
    if (node >= 0 && node < static_cast<int>(frame_.nodes.size())) {
      return true;
    }
    check_.add(field, std::to_string(node), "is not a node of the frame.", "Name one of lattice.frame.nodes.");
    return false;
  }

  [[nodiscard]] bool has_no_length(const FrameWalls::Beam& beam) const {
    const FrameWalls::Node& start = frame_.nodes[beam.start];
    const FrameWalls::Node& end = frame_.nodes[beam.end];
    return end.x_mm - start.x_mm == 0.0 && end.y_mm - start.y_mm == 0.0;
  }

  const FrameWalls& frame_;
  const LoadsSpec& loads_;
  std::vector<bool> welded_ = std::vector<bool>(frame_.nodes.size(), false);  ///< nodes to which a beam is not pinned
  FieldChecker& check_;
};

}  // namespace

void check_frame(const SceneSpec& spec, FieldChecker& check) {
  FrameChecker checker(spec, check);
  checker.check_nodes();
  checker.check_beams(count_elements(spec));
  checker.check_supports();
  checker.check_loads();
  checker.check_extent(spec);
  checker.check_motions();
}

}  // namespace cellcrush
