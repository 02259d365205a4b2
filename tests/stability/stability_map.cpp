// Crushes small specimens over steps, penalties and speeds and draws which of them are stable.
//   stability_map FOLDER [hexagon | square | triangle]      writes FOLDER/stability_map_LATTICE.csv, .svg, .png

#include "stability/stability_map.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace {

using namespace cellcrush;

void write(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file << bytes << std::flush;
  if (!file) throw std::runtime_error(path.string() + ": cannot be written; give a folder that exists.");
}

void draw(const std::filesystem::path& folder, const std::string& lattice) {
  const stability::Grid grid;
  const auto tell = [](const stability::Result& result) {
    std::fprintf(stderr, "%g m/s, penalty %g, step %g: %s\n", result.point.speed, result.point.penalty,
                 result.point.step, name_of(result.outcome).c_str());
  };
  const auto results = stability::crush_all(lattice, grid, tell);
  const auto defaults = stability::crush_defaults(lattice, grid, tell);
  std::vector<stability::Result> all = results;
  all.insert(all.end(), defaults.begin(), defaults.end());
  const std::string base = "stability_map_" + lattice;
  const std::string title = "12 x 6 " + lattice + "s crushed to 60 %: where the method holds";
  write(folder / (base + ".csv"), stability::as_csv(all));
  for (const char* extension : {".svg", ".png"}) {
    const std::filesystem::path file = folder / (base + extension);
    write(file, draw_map(client::picture_format(file), grid, results, defaults, title));
  }
}

}  // namespace

int main(int count, char** words) {
  const std::string lattice = count > 2 ? words[2] : "hexagon";
  if (count < 2 || count > 3 || (lattice != "hexagon" && lattice != "square" && lattice != "triangle")) {
    std::fputs("stability_map FOLDER [hexagon | square | triangle]\n", stderr);
    return 2;
  }
  try {
    draw(words[1], lattice);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
