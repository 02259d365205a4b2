#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <pugixml.hpp>
#include <string_view>

#include "drawing/drawing.h"
#include "drawing/svg_path.h"
#include "drawing/units.h"

// Lines of an SVG: line, polyline, polygon, rect, circle and path, with the transforms of their groups. y is turned up.
namespace cellcrush::drawing {
namespace {

/// x' = a x + c y + e, y' = b x + d y + f.
struct Transform {
  double a = 1.0, b = 0.0, c = 0.0, d = 1.0, e = 0.0, f = 0.0;

  [[nodiscard]] DrawnPlace operator()(const DrawnPlace& p) const {
    return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
  }
  [[nodiscard]] Transform operator*(const Transform& in) const {
    return {a * in.a + c * in.b, b * in.a + d * in.b,     a * in.c + c * in.d,
            b * in.c + d * in.d, a * in.e + c * in.f + e, b * in.e + d * in.f + f};
  }
  /// Lengths times this, if all directions are stretched alike.
  [[nodiscard]] double scale() const { return std::sqrt(std::abs(a * d - b * c)); }
};

Transform transform_of(const std::string& kind, const std::vector<double>& n) {
  const auto at = [&](std::size_t i, double otherwise) { return i < n.size() ? n[i] : otherwise; };
  if (kind == "translate") return {1.0, 0.0, 0.0, 1.0, at(0, 0.0), at(1, 0.0)};
  if (kind == "scale") return {at(0, 1.0), 0.0, 0.0, at(1, at(0, 1.0)), 0.0, 0.0};
  if (kind == "matrix" && n.size() == 6) return {n[0], n[1], n[2], n[3], n[4], n[5]};
  const double angle = at(0, 0.0) * std::numbers::pi / 180.0;
  if (kind == "skewX") return {1.0, 0.0, std::tan(angle), 1.0, 0.0, 0.0};
  if (kind == "skewY") return {1.0, std::tan(angle), 0.0, 1.0, 0.0, 0.0};
  if (kind != "rotate") refuse(fmt::format("{}: is no transform of SVG.", kind));
  const Transform turn = {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0.0, 0.0};
  const Transform there = {1.0, 0.0, 0.0, 1.0, at(1, 0.0), at(2, 0.0)};
  const Transform back = {1.0, 0.0, 0.0, 1.0, -at(1, 0.0), -at(2, 0.0)};
  return there * turn * back;
}

/// "translate(1 2) rotate(30)": the last one acts first.
Transform read_transforms(std::string_view text) {
  Transform all;
  while (true) {
    const auto open = text.find('(');
    const auto close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return all;
    std::string kind(text.substr(0, open));
    std::erase_if(kind, [](char letter) { return letter == ' ' || letter == ',' || letter == '\n'; });
    all = all * transform_of(kind, svg_numbers(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

/// "120mm": number and unit. px without one.
std::optional<double> mm_of_length(std::string_view text) {
  const std::vector<double> numbers = svg_numbers(text.substr(0, text.find_first_of("abcdefghijklmnopqrstuvwxyz%")));
  const auto letter = text.find_first_of("abcdefghijklmnopqrstuvwxyz%");
  const std::string unit = letter == std::string_view::npos ? "px" : std::string(text.substr(letter));
  const auto mm = mm_in(unit);
  if (numbers.empty() || !mm) return std::nullopt;
  return numbers.front() * *mm;
}

class SvgReader {
 public:
  Drawing read(const pugi::xml_node& root) {
    read_units(root);
    read_children(root, {1.0, 0.0, 0.0, -1.0, 0.0, 0.0}, {});
    for (const auto& [kind, count] : other_) drawing_.left_out.push_back(fmt::format("{} {}", count, kind));
    return std::move(drawing_);
  }

 private:
  /// A file whose size has a unit other than px tells how long a unit of its view box is.
  void read_units(const pugi::xml_node& root) {
    const std::string width = root.attribute("width").value();
    const bool has_unit = width.find_first_of("cmit") != std::string::npos;
    const auto mm = mm_of_length(width);
    const std::vector<double> box = svg_numbers(root.attribute("viewBox").value());
    if (has_unit && mm && box.size() == 4 && box[2] > 0.0) drawing_.mm_per_unit = *mm / box[2];
  }

  void read_children(const pugi::xml_node& parent, const Transform& outer, std::optional<double> stroke) {
    constexpr int kDeepest = 100;
    if (++depth_ > kDeepest) refuse(fmt::format("The groups of the SVG file are nested more than {} deep.", kDeepest));
    for (const pugi::xml_node& node : parent.children()) {
      if (node.type() != pugi::node_element) continue;
      const Transform transform = outer * read_transforms(node.attribute("transform").value());
      if (const auto width = node.attribute("stroke-width")) stroke = width.as_double();
      read_element(node, transform, stroke);
    }
    --depth_;
  }

  void read_element(const pugi::xml_node& node, const Transform& transform, std::optional<double> stroke) {
    const std::string kind = node.name();
    const auto number = [&](const char* name) { return node.attribute(name).as_double(); };
    if (kind == "g" || kind == "svg" || kind == "a") return read_children(node, transform, stroke);
    if (kind == "line") {
      return add({{{number("x1"), number("y1")}, {number("x2"), number("y2")}}}, kind, transform, stroke);
    }
    if (kind == "polyline" || kind == "polygon") {
      std::vector<DrawnPlace> points = places_of(svg_numbers(node.attribute("points").value()));
      if (kind == "polygon" && !points.empty()) points.push_back(points.front());
      return add({points}, kind, transform, stroke);
    }
    if (kind == "rect") {
      const double x = number("x"), y = number("y"), right = x + number("width"), top = y + number("height");
      return add({{{x, y}, {right, y}, {right, top}, {x, top}, {x, y}}}, kind, transform, stroke);
    }
    if (kind == "circle") return add_circle({number("cx"), number("cy")}, number("r"), transform, stroke);
    if (kind == "path") return add(flatten_svg_path(node.attribute("d").value()), kind, transform, stroke);
    if (kind == "text" || kind == "image" || kind == "use" || kind == "ellipse") ++other_[kind];
  }

  static std::vector<DrawnPlace> places_of(const std::vector<double>& numbers) {
    std::vector<DrawnPlace> places;
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) places.push_back({numbers[i], numbers[i + 1]});
    return places;
  }

  std::string name_of(const std::string& kind) { return fmt::format("{} {}", kind, ++count_[kind]); }

  void add(const std::vector<std::vector<DrawnPlace>>& chains, const std::string& kind, const Transform& transform,
           std::optional<double> stroke) {
    const std::string name = name_of(kind);
    if (stroke) *stroke *= transform.scale();
    for (const std::vector<DrawnPlace>& chain : chains) {
      for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        drawing_.add({transform(chain[i]), transform(chain[i + 1]), 0.0, stroke, name});
      }
    }
  }

  void add_circle(const DrawnPlace& centre, double radius, const Transform& transform, std::optional<double> stroke) {
    const std::string name = name_of("circle");
    if (stroke) *stroke *= transform.scale();
    for (DrawnWall& wall :
         walls_of_arc(transform(centre), radius * transform.scale(), 0.0, 2.0 * std::numbers::pi, name)) {
      wall.thickness = stroke;
      drawing_.add(std::move(wall));
    }
  }

  Drawing drawing_;
  std::map<std::string, int> count_;
  std::map<std::string, int> other_;
  int depth_ = 0;  ///< of groups
};

}  // namespace

Drawing read_svg_drawing(const std::string& text, const std::string& file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  const pugi::xml_node root = document.child("svg");
  if (!parsed || !root) {
    refuse(fmt::format("{}: is no SVG file: {}.", file, parsed ? "it has no svg element" : parsed.description()));
  }
  return SvgReader().read(root);
}

}  // namespace cellcrush::drawing
