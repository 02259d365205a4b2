#include <dxflib/dl_creationadapter.h>
#include <dxflib/dl_dxf.h>
#include <fmt/format.h>

#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>

#include "drawing/drawing.h"
#include "drawing/units.h"

namespace cellcrush::drawing {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// Takes LINE, LWPOLYLINE, POLYLINE, ARC and CIRCLE outside of blocks; counts all else.
class DxfReader : public DL_CreationAdapter {
 public:
  Drawing take() {
    close_polyline();
    for (const auto& [kind, count] : other_) drawing_.left_out.push_back(fmt::format("{} {}", count, kind));
    return std::move(drawing_);
  }

  void setVariableInt(const std::string& name, int value, int /*code*/) override {
    if (name == "$INSUNITS") drawing_.mm_per_unit = mm_in_dxf_unit(value);
  }
  void addBlock(const DL_BlockData& /*data*/) override { in_block_ = true; }
  void endBlock() override { in_block_ = false; }

  void addLine(const DL_LineData& data) override {
    if (counts("LINE")) drawing_.add({{data.x1, data.y1}, {data.x2, data.y2}, 0.0, {}, name("LINE")});
  }
  void addArc(const DL_ArcData& data) override {
    if (counts("ARC"))
      add(walls_of_arc({data.cx, data.cy}, data.radius, data.angle1 * kDegree, data.angle2 * kDegree, name("ARC")));
  }
  void addCircle(const DL_CircleData& data) override {
    if (counts("CIRCLE"))
      add(walls_of_arc({data.cx, data.cy}, data.radius, 0.0, 2.0 * std::numbers::pi, name("CIRCLE")));
  }
  void addPolyline(const DL_PolylineData& data) override {
    close_polyline();
    is_closed_ = (data.flags & 1) != 0;
    if (counts("POLYLINE")) name_ = name("POLYLINE");
  }
  void addVertex(const DL_VertexData& data) override {
    if (!in_block_) vertices_.push_back({{data.x, data.y}, data.bulge});
  }
  void endSequence() override { close_polyline(); }

  void addPoint(const DL_PointData& /*data*/) override { leave_out("POINT"); }
  void addText(const DL_TextData& /*data*/) override { leave_out("TEXT"); }
  void addMText(const DL_MTextData& /*data*/) override { leave_out("MTEXT"); }
  void addInsert(const DL_InsertData& /*data*/) override { leave_out("INSERT"); }
  void addEllipse(const DL_EllipseData& /*data*/) override { leave_out("ELLIPSE"); }
  void addSpline(const DL_SplineData& /*data*/) override { leave_out("SPLINE"); }

 private:
  struct Vertex {
    DrawnPlace place;
    double bulge;  ///< tangent of a quarter of the arc's angle to the next one; positive: counterclockwise
  };

  bool counts(const char* kind) {
    if (!in_block_) ++count_[kind];
    return !in_block_;
  }
  std::string name(const char* kind) { return fmt::format("{} {}", kind, count_[kind]); }
  void leave_out(const char* kind) {
    if (!in_block_) ++other_[kind];
  }
  void add(std::vector<DrawnWall> walls) {
    for (DrawnWall& wall : walls) drawing_.add(std::move(wall));
  }

  void close_polyline() {
    const std::size_t count = vertices_.size();
    const std::size_t walls = count < 2 ? 0 : is_closed_ ? count : count - 1;
    for (std::size_t i = 0; i < walls; ++i) {
      const Vertex& from = vertices_[i];
      const DrawnPlace& to = vertices_[(i + 1) % count].place;
      drawing_.add({from.place, to, -0.5 * from.bulge * distance(from.place, to), {}, name_});
    }
    vertices_.clear();
  }

  Drawing drawing_;
  bool in_block_ = false;
  bool is_closed_ = false;
  std::vector<Vertex> vertices_;
  std::string name_;
  std::map<std::string, int> count_;
  std::map<std::string, int> other_;
};

/// dxflib allocates as many vertices, knots and points as an entity says it has.
void check_dxf_counts(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  long number = 0;
  std::string entity;
  for (std::string code, value; std::getline(lines, code) && std::getline(lines, value);) {
    number += 2;
    const long group = std::strtol(code.c_str(), nullptr, 10);
    if (group == 0) {
      entity = value.substr(0, value.find_last_not_of(" \t\r") + 1);
      continue;
    }
    const bool has_counts = entity == "LWPOLYLINE" || entity == "SPLINE" || entity == "LEADER" || entity == "HATCH";
    const bool is_count = (group >= 72 && group <= 79) || (group >= 90 && group <= 99);
    if (!has_counts || !is_count) continue;
    // No entity has more parts than the file has bytes.
    const long count = std::strtol(value.c_str(), nullptr, 10);
    if (count < 0 || count > static_cast<long>(text.size())) {
      refuse(fmt::format("{}:{}: {} says that it has {} parts, more than the file. Save the drawing again.", file,
                         number, entity, count));
    }
  }
}

}  // namespace

Drawing read_dxf_drawing(const std::string& text, const std::string& file) {
  check_dxf_counts(text, file);
  std::stringstream stream(text);
  DxfReader reader;
  DL_Dxf dxf;
  if (!dxf.in(stream, &reader)) refuse(fmt::format("{}: is no DXF file.", file));
  return reader.take();
}

}  // namespace cellcrush::drawing
