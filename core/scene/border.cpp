#include "scene/border.h"

#include <algorithm>

#include "scene/bands.h"

namespace cellcrush {
namespace {

int last_band_at(const Scene& scene, int particle) {
  const int last = scene.incidence[scene.incidence_offset[particle + 1] - 1];  // incidence is ascending
  const auto behind =
      std::upper_bound(scene.bands.begin(), scene.bands.end(), last,
                       [&](int element, const LatticeBand& band) { return element < first_element_of(scene, band); });
  return static_cast<int>(behind - scene.bands.begin()) - 1;
}

}  // namespace

std::vector<BorderParticle> find_border(const Scene& scene) {
  std::vector<BorderParticle> border;
  for (std::size_t b = 0; b < scene.bands.size(); ++b) {
    const FacesOfBand& faces = scene.faces.bands[b];
    for (int k = faces.offset[faces.count() - 1]; k < faces.offset[faces.count()]; ++k) {
      const int particle = faces.particle[k];
      if (scene.bands[b].owns(particle)) {
        border.push_back({particle, static_cast<int>(b), last_band_at(scene, particle)});
      }
    }
  }
  return border;
}

}  // namespace cellcrush
