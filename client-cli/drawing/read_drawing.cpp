#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <utility>

#include "drawing/drawing.h"

namespace cellcrush::drawing {
namespace {

using Read = Drawing (*)(const std::string& text, const std::string& file);

const std::pair<const char*, Read> kReaders[] = {
    {".csv", read_csv_drawing}, {".json", read_json_drawing},  {".dxf", read_dxf_drawing},
    {".svg", read_svg_drawing}, {".inp", read_abaqus_drawing}, {".msh", read_gmsh_drawing},
};

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return ending;
}

const auto* reader_of(const std::string& ending) {
  const auto* reader = std::ranges::find_if(kReaders, [&](const auto& candidate) { return candidate.first == ending; });
  return reader == std::end(kReaders) ? nullptr : reader;
}

}  // namespace

void refuse(const std::string& message) { throw DrawingError(message); }

void Drawing::add(DrawnWall wall) {
  if (walls.size() == kMostLines) refuse(fmt::format("The drawing has more than {} lines. Divide it.", kMostLines));
  walls.push_back(std::move(wall));
}

std::vector<DrawnWall> walls_of_arc(const DrawnPlace& centre, double radius, double from, double to,
                                    const std::string& name) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kQuarter = 0.25 * kTurn;
  if (!std::isfinite(from) || !std::isfinite(to)) refuse(fmt::format("{} has no finite angles.", name));
  double all = std::fmod(to - from, kTurn);
  if (all <= 0.0) all += kTurn;
  const int pieces = std::max(1, static_cast<int>(std::ceil(all / kQuarter - 1e-9)));
  const double turn = all / pieces;
  const auto place_at = [&](int i) {
    const double angle = from + turn * i;
    return DrawnPlace{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
  };
  std::vector<DrawnWall> walls;
  for (int i = 0; i < pieces; ++i) {
    // Counterclockwise, an arc lies to the right of its chord.
    walls.push_back({place_at(i), place_at(i + 1), -radius * (1.0 - std::cos(0.5 * turn)), {}, name});
  }
  return walls;
}

bool names_drawing(const std::string& file) {
  const std::string ending = ending_of(file);
  return ending != ".json" && reader_of(ending) != nullptr;
}

Drawing read_drawing(const std::vector<NamedText>& files) {
  if (files.size() == 2 && ending_of(files[0].name) == ".csv" && ending_of(files[1].name) == ".csv") {
    return read_csv_drawing(files[0].text, files[0].name, files[1].text, files[1].name);
  }
  if (files.size() != 1) refuse("Give one file, or two .csv files: the nodes, then the edges.");
  const NamedText& file = files.front();
  const auto* reader = reader_of(ending_of(file.name));
  if (reader == nullptr) {
    refuse(fmt::format("{}: is no drawing that can be read. Give a .csv, .json, .dxf, .svg, .inp or .msh file.",
                       file.name));
  }
  Drawing drawing = reader->second(file.text, file.name);
  if (drawing.walls.empty()) refuse(fmt::format("{}: has no lines that could be walls.", file.name));
  return drawing;
}

}  // namespace cellcrush::drawing
