#include "drawing/import_lattice.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "drawing/compact_network.h"
#include "drawing/drawing.h"
#include "drawing/join_walls.h"
#include "drawing/lattice_marks.h"
#include "drawing/units.h"

namespace cellcrush::drawing {
namespace {

/// As the field lattice.network.wall_thickness_mm.
constexpr double kLeastLength = 1e-6;
constexpr double kMostLength = 1e12;

double mm_of_unit(const v1::ImportLatticeRequest& request, const Drawing& drawing) {
  if (!request.unit().empty()) return mm_per(request.unit());
  if (drawing.mm_per_unit) return *drawing.mm_per_unit;
  refuse(
      fmt::format("{} does not tell its unit of length. Give the unit (--unit), such as mm.", request.files(0).name()));
}

void check_length(const std::string& what, bool is_given, double value) {
  if (!is_given || (value >= kLeastLength && value <= kMostLength)) return;
  refuse(fmt::format("The {} of {} mm is no length. Give 1e-6 to 1e12 mm.", what, value));
}

/// What was read and done, a line each.
std::vector<std::string> lines_of(const v1::ImportReport& report) {
  std::vector<std::string> lines = {fmt::format("{} walls between {} joints, 1 unit of the file = {:.6g} mm",
                                                report.walls(), report.joints(), report.mm_per_unit())};
  const auto tell = [&lines](bool is_so, const std::string& line) {
    if (is_so) lines.push_back(line);
  };
  tell(report.merged() > 0, fmt::format("{} ends merged within {:.3g} mm", report.merged(), report.tolerance_mm()));
  tell(report.divided() > 0, fmt::format("{} ends met a wall between its joints: joined there", report.divided()));
  tell(report.without_length() > 0, fmt::format("{} lines without length: left out", report.without_length()));
  for (const v1::LatticeMarks& marks : report.marks()) tell(true, marks_text(marks));
  for (const std::string& what : report.left_out()) tell(true, what + ": no walls, left out");
  return lines;
}

}  // namespace

v1::ImportLatticeResponse import_lattice(const v1::ImportLatticeRequest& request) {
  check_length("thickness", request.has_thickness_mm(), request.thickness_mm());
  check_length("tolerance", request.has_tolerance_mm(), request.tolerance_mm());
  if (request.has_bond() && !(request.bond() >= 0.0 && request.bond() <= 0.5)) {
    refuse(fmt::format("The bond of {} is no share. Give 0 to 0.5.", request.bond()));
  }
  std::vector<NamedText> files;
  for (const auto& file : request.files()) files.push_back({file.name(), file.content()});
  const Drawing drawing = read_drawing(files);
  JoinOptions options;
  options.mm_per_unit = mm_of_unit(request, drawing);
  if (request.has_bond()) options.bond = request.bond();
  options.joins_crossings = !request.keep_crossings();
  if (request.has_thickness_mm()) options.thickness_mm = request.thickness_mm();
  if (request.has_tolerance_mm()) options.tolerance_mm = request.tolerance_mm();
  JoinedWalls joined = join_walls(drawing, options);
  v1::ImportLatticeResponse out;
  v1::ImportReport& report = *out.mutable_report();
  report.set_walls(joined.network.walls_size() / 2);
  report.set_joints(joined.network.joints_mm_size() / 2);
  report.set_mm_per_unit(options.mm_per_unit);
  report.set_tolerance_mm(joined.tolerance_mm);
  report.set_merged(joined.merged);
  report.set_divided(joined.divided);
  report.set_without_length(joined.without_length);
  std::vector<DrawnPlace> bonds;
  for (const Bond& bond : joined.bonds) bonds.push_back(bond.middle);
  add_marks(v1::LatticeMarks::BOND, bonds, *report.mutable_marks());
  add_marks(v1::LatticeMarks::CROSSING, joined.crossings, *report.mutable_marks());
  add_marks(v1::LatticeMarks::DUPLICATE, joined.duplicates, *report.mutable_marks());
  add_marks(v1::LatticeMarks::COVERED, joined.covered, *report.mutable_marks());
  add_marks(v1::LatticeMarks::LOOSE_END, joined.loose, *report.mutable_marks());
  add_marks(v1::LatticeMarks::ISLAND, joined.islands, *report.mutable_marks());
  for (const std::string& what : drawing.left_out) report.add_left_out(what);
  for (const std::string& line : lines_of(report)) report.add_lines(line);
  if (joined.network.ByteSizeLong() > kLargestLists && make_compact(joined.network, Rounding::to_a_step)) {
    report.add_lines(
        fmt::format("lists in the compact form, in steps of {:.3g} mm", 1.0 / joined.network.compact().steps_per_mm()));
  }
  *out.mutable_network() = std::move(joined.network);
  return out;
}

}  // namespace cellcrush::drawing
