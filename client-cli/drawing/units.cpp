#include "drawing/units.h"

#include <fmt/format.h>

#include <map>

#include "drawing/drawing.h"

namespace cellcrush::drawing {
namespace {

constexpr double kInch = 25.4;

const std::map<std::string, double> kUnits = {{"mm", 1.0},          {"cm", 10.0},        {"m", 1000.0},
                                              {"um", 1e-3},         {"in", kInch},       {"ft", 12.0 * kInch},
                                              {"pt", kInch / 72.0}, {"px", kInch / 96.0}};

// As the DXF reference numbers them.
const std::map<int, double> kDxfUnits = {{1, kInch},  {2, 12.0 * kInch}, {4, 1.0},  {5, 10.0},
                                         {6, 1000.0}, {9, 1e-3 * kInch}, {13, 1e-3}};

}  // namespace

std::optional<double> mm_in(const std::string& unit) {
  const auto found = kUnits.find(unit);
  return found == kUnits.end() ? std::nullopt : std::optional(found->second);
}

double mm_per(const std::string& unit) {
  if (const auto found = mm_in(unit)) return *found;
  refuse(fmt::format("{}: is no unit of length that is known. Give mm, cm, m, um, in, ft, pt or px.", unit));
}

std::optional<double> mm_in_dxf_unit(int number) {
  const auto found = kDxfUnits.find(number);
  return found == kDxfUnits.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace cellcrush::drawing
