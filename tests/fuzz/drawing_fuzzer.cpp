// Any bytes as a drawing of any format: nothing may crash or hang, and what is read is a network of its own joints.
#include <array>
#include <cstdint>
#include <cstdlib>

#include "drawing/drawing.h"
#include "drawing/import_lattice.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcrush;
  constexpr std::array kNames = {"a.csv", "a.json", "a.dxf", "a.svg", "a.inp", "a.msh"};
  if (size == 0) return 0;
  v1::ImportLatticeRequest request;
  auto& file = *request.add_files();
  file.set_name(kNames[data[0] % kNames.size()]);
  file.set_content(data + 1, size - 1);
  request.set_unit("mm");
  request.set_thickness_mm(0.1);
  try {
    const auto drawn = drawing::import_lattice(request);
    const auto& network = drawn.network();
    if (network.walls().empty() || network.walls_size() % 2 != 0) std::abort();
    for (const int joint : network.walls()) {
      if (joint < 0 || 2 * joint + 1 >= network.joints_mm_size()) std::abort();
    }
  } catch (const drawing::DrawingError&) {
  }
  return 0;
}
