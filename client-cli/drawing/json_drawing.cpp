#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "drawing/drawing.h"
#include "drawing/units.h"

// {"unit": "mm", "nodes": [[x, y], ...], "edges": [[start, end], ...], "thickness": t or one a wall}; or nodes with id,
// x, y and edges (or links) with start, end (or source, target), thickness, rise, as graph libraries write them.
namespace cellcrush::drawing {
namespace {

using nlohmann::json;

class JsonReader {
 public:
  JsonReader(const json& root, std::string file) : root_(root), file_(std::move(file)) {}

  Drawing read() {
    if (root_.contains("unit")) drawing_.mm_per_unit = mm_per(root_["unit"].get<std::string>());
    read_nodes();
    read_edges();
    return std::move(drawing_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { refuse(fmt::format("{}: {}", file_, what)); }

  const json& list(const char* name, const char* other) const {
    for (const char* key : {name, other}) {
      if (root_.contains(key) && root_[key].is_array()) return root_[key];
    }
    fail(fmt::format("has no list \"{}\". Give nodes, such as [[0, 0], [1, 0]], and edges, such as [[0, 1]].", name));
  }

  static std::string id_of(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

  void read_nodes() {
    int number = 0;
    for (const json& node : list("nodes", "joints")) {
      const bool is_pair = node.is_array() && node.size() >= 2 && node[0].is_number() && node[1].is_number();
      const bool is_object = node.is_object() && node.contains("x") && node.contains("y");
      if (!is_pair && !is_object) fail(fmt::format("nodes[{}] is no place. Give [x, y], or id, x and y.", number));
      const std::string id = is_object && node.contains("id") ? id_of(node["id"]) : std::to_string(number);
      nodes_[id] = is_pair ? DrawnPlace{node[0], node[1]} : DrawnPlace{node["x"], node["y"]};
      ++number;
    }
  }

  DrawnPlace place_of(const json& id, int edge) const {
    const auto found = nodes_.find(id_of(id));
    if (found == nodes_.end()) fail(fmt::format("edges[{}] names {}, which is no node.", edge, id.dump()));
    return found->second;
  }

  void read_edges() {
    const json thickness = root_.value("thickness", json());
    int number = 0;
    for (const json& edge : list("edges", "links")) {
      DrawnWall wall;
      wall.name = fmt::format("edges[{}]", number);
      if (edge.is_array() && edge.size() >= 2) {
        wall.start = place_of(edge[0], number);
        wall.end = place_of(edge[1], number);
      } else if (edge.is_object()) {
        const bool named = edge.contains("source");
        if (!edge.contains(named ? "target" : "start")) fail(wall.name + " has no start and end.");
        wall.start = place_of(edge[named ? "source" : "start"], number);
        wall.end = place_of(edge[named ? "target" : "end"], number);
        if (edge.contains("thickness")) wall.thickness = edge["thickness"].get<double>();
        wall.rise = edge.value("rise", 0.0);
      } else {
        fail(wall.name + " is no wall. Give [start, end], or start and end.");
      }
      if (!wall.thickness && thickness.is_number()) wall.thickness = thickness.get<double>();
      if (!wall.thickness && thickness.is_array()) wall.thickness = thickness.at(number).get<double>();
      drawing_.add(std::move(wall));
      ++number;
    }
  }

  const json& root_;
  std::string file_;
  std::map<std::string, DrawnPlace> nodes_;
  Drawing drawing_;
};

}  // namespace

Drawing read_json_drawing(const std::string& text, const std::string& file) {
  try {
    const json root = json::parse(text);
    return JsonReader(root, file).read();
  } catch (const json::exception& error) {
    refuse(fmt::format("{}: {}", file, error.what()));
  }
}

}  // namespace cellcrush::drawing
