#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "columns/sample_parts.h"
#include "translate/case_to_spec.h"
#include "translate/read_choice.h"

namespace cellcrush::translate {
namespace {

std::string item(const char* list, int position) {
  return "lattice.frame." + std::string(list) + "[" + std::to_string(position) + "]";
}

// Ids become groups of the result file, so characters with a meaning in paths are not allowed.
bool is_name(const std::string& id) {
  return !id.empty() && id.size() <= 64 && std::all_of(id.begin(), id.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

Problem missing(const std::string& field) { return {field, "", "is missing.", "Set it."}; }

// Notes the position of a node or wall with a valid id of its own.
void read_id(const std::string& field, const std::string& what, const std::string& id, int position,
             std::unordered_map<std::string, int>& positions, Problems& problems) {
  if (!is_name(id)) {
    problems.push_back({field, id, "is not a valid name: names have 1 to 64 letters, digits, '_' or '-'.",
                        "Give each " + what + " a unique, valid name."});
  } else if (!positions.emplace(id, position).second) {
    problems.push_back(
        {field, id, "is the name of another " + what + " as well.", "Give each " + what + " a unique name."});
  }
}

LoadsSpec::TimeFunction read_function(const std::string& path, const v1::Frame::TimeFunction& in, Problems& problems) {
  LoadsSpec::TimeFunction out;
  for (int k = 0; k < in.points_size(); ++k) {
    const std::string point = path + ".points[" + std::to_string(k) + "]";
    if (!in.points(k).has_time_s()) problems.push_back(missing(point + ".time_s"));
    if (!in.points(k).has_value()) problems.push_back(missing(point + ".value"));
    out.emplace_back(in.points(k).time_s(), in.points(k).value());
  }
  return out;
}

// Converts one frame: the wire refers to nodes by id, the spec by index.
class FrameReader {
 public:
  FrameReader(const v1::Frame& in, LoadsSpec& loads, Problems& problems)
      : in_(in), loads_(loads), problems_(problems) {}

  FrameWalls read() {
    read_nodes();
    read_beams();
    read_supports();
    read_loads();
    read_initial_velocities();
    read_motions();
    read_distributed_loads();
    read_watched_nodes();
    if (in_.has_self_contact()) out_.self_contact = in_.self_contact();
    return std::move(out_);
  }

 private:
  void read_nodes() {
    for (int i = 0; i < in_.nodes_size(); ++i) {
      const auto& node = in_.nodes(i);
      const std::string path = item("nodes", i);
      read_id(path + ".id", "node", node.id(), i, positions_, problems_);
      if (!node.has_x_mm()) problems_.push_back(missing(path + ".x_mm"));
      if (!node.has_y_mm()) problems_.push_back(missing(path + ".y_mm"));
      out_.nodes.push_back({node.x_mm(), node.y_mm(), node.attached_mass_g(), node.attached_inertia_g_mm2()});
    }
  }

  void read_beams() {
    for (int i = 0; i < in_.beams_size(); ++i) {
      const auto& beam = in_.beams(i);
      const std::string path = item("beams", i);
      FrameWalls::Beam out;
      out.start = find_node(path + ".start", beam.start());
      out.end = find_node(path + ".end", beam.end());
      if (!beam.has_thickness_mm()) problems_.push_back(missing(path + ".thickness_mm"));
      out.thickness_mm = beam.thickness_mm();
      if (beam.has_material()) out.material = to_spec(beam.material(), path + ".material.", problems_);
      if (beam.has_elements()) out.elements = beam.elements();
      out.pin_start = beam.pin_start();
      out.pin_end = beam.pin_end();
      out_.beams.push_back(out);
    }
  }

  void read_supports() {
    for (int i = 0; i < in_.supports_size(); ++i) {
      const auto& support = in_.supports(i);
      out_.supports.push_back({find_node(item("supports", i) + ".node", support.node()), support.fix_x(),
                               support.fix_y(), support.fix_rotation()});
    }
  }

  void read_loads() {
    for (int i = 0; i < in_.loads_size(); ++i) {
      const auto& load = in_.loads(i);
      const std::string path = item("loads", i);
      loads_.loads.push_back({find_node(path + ".node", load.node()), component(path + ".component", load.component()),
                              read_function(path + ".force_n_or_n_mm", load.force_n_or_n_mm(), problems_)});
    }
  }

  void read_initial_velocities() {
    for (int i = 0; i < in_.initial_velocities_size(); ++i) {
      const auto& velocity = in_.initial_velocities(i);
      loads_.initial_velocities.push_back({find_node(item("initial_velocities", i) + ".node", velocity.node()),
                                           velocity.x_m_per_s(), velocity.y_m_per_s(), velocity.rotation_rad_per_s()});
    }
  }

  void read_motions() {
    for (int i = 0; i < in_.motions_size(); ++i) {
      const auto& motion = in_.motions(i);
      const std::string path = item("motions", i);
      loads_.motions.push_back(
          {find_node(path + ".node", motion.node()), component(path + ".component", motion.component()),
           read_function(path + ".displacement_mm_or_rad", motion.displacement_mm_or_rad(), problems_)});
    }
  }

  void read_distributed_loads() {
    for (int i = 0; i < in_.distributed_loads_size(); ++i) {
      const auto& load = in_.distributed_loads(i);
      const std::string path = item("distributed_loads", i);
      if (!load.has_beam()) problems_.push_back(missing(path + ".beam"));
      loads_.distributed_loads.push_back({load.beam(),
                                          read_function(path + ".x_n_per_mm", load.x_n_per_mm(), problems_),
                                          read_function(path + ".y_n_per_mm", load.y_n_per_mm(), problems_)});
    }
  }

  void read_watched_nodes() {
    for (int i = 0; i < in_.watched_nodes_size(); ++i) {
      const std::string field = item("watched_nodes", i);
      const int node = find_node(field, in_.watched_nodes(i));
      if (std::find(out_.watched_nodes.begin(), out_.watched_nodes.end(), node) != out_.watched_nodes.end())
        problems_.push_back({field, in_.watched_nodes(i), "is already watched.", "Name each node once."});
      out_.watched_nodes.push_back(node);
    }
  }

  int find_node(const std::string& field, const std::string& id) {
    const auto found = positions_.find(id);
    if (found != positions_.end()) return found->second;
    if (id.empty()) {
      problems_.push_back(missing(field));
    } else {
      problems_.push_back({field, id, "is not the name of a node.", "Name one of lattice.frame.nodes."});
    }
    return 0;
  }

  LoadsSpec::Component component(const std::string& field, v1::Frame::Component value) {
    switch (value) {
      case v1::Frame::COMPONENT_X: return LoadsSpec::Component::x;
      case v1::Frame::COMPONENT_Y: return LoadsSpec::Component::y;
      case v1::Frame::COMPONENT_ROTATION: return LoadsSpec::Component::rotation;
      case v1::Frame::COMPONENT_UNSPECIFIED: problems_.push_back(missing(field)); break;
      default:
        problems_.push_back({field, std::to_string(value), "is not a valid component.",
                             "Use COMPONENT_X, COMPONENT_Y or COMPONENT_ROTATION."});
    }
    return LoadsSpec::Component::x;
  }

  const v1::Frame& in_;
  LoadsSpec& loads_;
  Problems& problems_;
  FrameWalls out_;
  std::unordered_map<std::string, int> positions_;
};

}  // namespace

FrameWalls to_spec(const v1::Frame& in, LoadsSpec& loads, Problems& problems) {
  return FrameReader(in, loads, problems).read();
}

namespace {

LoadsSpec::RigidWall read_rigid_wall(const v1::Frame::RigidWall& in, const std::string& path, Problems& problems) {
  const bool at_edge = in.edge() != v1::Loading::Grip::EDGE_UNSPECIFIED;
  if (!at_edge && !in.has_x_mm()) problems.push_back(missing(path + ".x_mm"));
  if (!at_edge && !in.has_y_mm()) problems.push_back(missing(path + ".y_mm"));
  LoadsSpec::RigidWall out = {in.x_mm(), in.y_mm(), in.normal_x(), in.normal_y(), in.friction()};
  if (at_edge) {
    out.edge = LoadsSpec::Edge::left;
    read_choice(in.edge(), path + ".edge", *out.edge, problems);
  }
  const auto read = [&](const std::string& name, const v1::Frame::TimeFunction& function) {
    LoadsSpec::TimeFunction points = read_function(path + "." + name, function, problems);
    if (points.empty()) problems.push_back(missing(path + "." + name + ".points"));
    return points;
  };
  if (in.has_displacement_mm()) out.points = read("displacement_mm", in.displacement_mm());
  const auto& reflection = *in.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> given;
  reflection.ListFields(in, &given);
  for (const auto* field : given) {
    if (field->number() <= v1::Frame::RigidWall::kDisplacementMmFieldNumber) continue;  // of every kind of wall
    const std::string name(field->name());
    if (field->cpp_type() == google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) {
      out.own[name] = reflection.GetDouble(in, field);
    } else if (field->message_type() == v1::Frame::TimeFunction::descriptor()) {
      const auto& function = static_cast<const v1::Frame::TimeFunction&>(reflection.GetMessage(in, field));
      if (auto points = read(name, function); !points.empty()) out.functions[name] = std::move(points);
    }
  }
  return out;
}

}  // namespace

std::vector<LoadsSpec::RigidWall> read_rigid_walls(const v1::Loading& in, Problems& problems) {
  std::unordered_map<std::string, int> positions;
  std::vector<LoadsSpec::RigidWall> out;
  for (int i = 0; i < in.rigid_walls_size(); ++i) {
    const std::string path = "loading.rigid_walls[" + std::to_string(i) + "]";
    read_id(path + ".id", "rigid wall", in.rigid_walls(i).id(), i, positions, problems);
    for (const char* id : kSideWallIds) {
      if (in.sides().kind() == v1::Loading::Sides::RIGID && in.rigid_walls(i).id() == id)
        problems.push_back({path + ".id", id, "is the name of a side wall.", "Give the rigid wall another name."});
    }
    out.push_back(read_rigid_wall(in.rigid_walls(i), path, problems));
  }
  return out;
}

std::vector<LoadsSpec::Grip> read_gripped_edges(const v1::Loading& in, Problems& problems) {
  std::unordered_map<std::string, int> positions;
  std::vector<LoadsSpec::Grip> out;
  for (int i = 0; i < in.grips_size(); ++i) {
    const v1::Loading::Grip& grip = in.grips(i);
    const std::string path = "loading.grips[" + std::to_string(i) + "]";
    read_id(path + ".id", "grip", grip.id(), i, positions, problems);
    LoadsSpec::Grip& added = out.emplace_back();
    if (grip.has_line_mm()) added.line_mm = grip.line_mm();
    const auto read = [&](const char* name, bool is_given, const v1::Frame::TimeFunction& function) {
      if (!is_given) return LoadsSpec::TimeFunction();
      if (function.points().empty()) problems.push_back(missing(path + name + ".points"));
      return read_function(path + name, function, problems);
    };
    added.x_points = read(".displacement_x_mm", grip.has_displacement_x_mm(), grip.displacement_x_mm());
    added.y_points = read(".displacement_y_mm", grip.has_displacement_y_mm(), grip.displacement_y_mm());
  }
  return out;
}

}  // namespace cellcrush::translate
