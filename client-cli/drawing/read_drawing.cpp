#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <utility>

#include "case_file/case_source.h"
#include "command_error.h"
#include "drawing/drawing.h"

namespace cellcrush::client {
namespace {

using Read = Drawing (*)(const std::string& text, const std::string& file);

const std::pair<const char*, Read> kReaders[] = {
    {".csv", read_csv_drawing}, {".json", read_json_drawing},  {".dxf", read_dxf_drawing},
    {".svg", read_svg_drawing}, {".inp", read_abaqus_drawing}, {".msh", read_gmsh_drawing},
};

std::string text_of_file(const std::string& file) {
  std::ifstream stream;
  if (const std::string failure = open_failure(file, stream); !failure.empty()) refuse(failure);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return ending;
}

}  // namespace

std::vector<DrawnWall> walls_of_arc(const DrawnPlace& centre, double radius, double from, double to,
                                    const std::string& name) {
  constexpr double kQuarter = std::numbers::pi / 2.0;
  while (to <= from) to += 2.0 * std::numbers::pi;
  const int pieces = std::max(1, static_cast<int>(std::ceil((to - from) / kQuarter - 1e-9)));
  const double turn = (to - from) / pieces;
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

Drawing read_drawing(const std::vector<std::string>& files) {
  if (files.size() == 2 && ending_of(files[0]) == ".csv" && ending_of(files[1]) == ".csv") {
    return read_csv_drawing(text_of_file(files[0]), files[0], text_of_file(files[1]), files[1]);
  }
  if (files.size() != 1) refuse("Give one file, or two .csv files: the nodes, then the edges.");
  const std::string ending = ending_of(files[0]);
  const auto* reader = std::ranges::find_if(kReaders, [&](const auto& candidate) { return candidate.first == ending; });
  if (reader == std::end(kReaders)) {
    refuse(fmt::format("{}: is no drawing that can be read. Give a .csv, .json, .dxf, .svg, .inp or .msh file.",
                       files[0]));
  }
  Drawing drawing = reader->second(text_of_file(files[0]), files[0]);
  if (drawing.walls.empty()) refuse(fmt::format("{}: has no lines that could be walls.", files[0]));
  return drawing;
}

}  // namespace cellcrush::client
