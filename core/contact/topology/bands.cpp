#include "contact/topology/bands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cellcrush {
namespace {

int whole_chunks(int count) {
  return (count + kParticlesMovedTogether - 1) / kParticlesMovedTogether * kParticlesMovedTogether;
}

/// End of the particles inside the walls of a chunk.
int end_of_inner(const Walls& walls, int chunk) {
  const WallBlock& last = walls.blocks[walls.chunk_offset[chunk + 1] - 1];
  return last.first_inner + last.walls * (last.elements - 1);
}

std::vector<LatticeBand> cut(const Scene& scene, int chunks) {
  const int all_chunks = scene.walls.chunk_count();
  const int joints = scene.joint_count;
  const auto particles = static_cast<int>(scene.particle_count());
  std::vector<LatticeBand> bands;
  LatticeBand band = {0, 0, 0, 0, joints, joints};
  while (band.end_chunk < all_chunks) {
    band.first_chunk = band.end_chunk;
    band.first_joint = band.end_joint;
    band.first_inner = band.end_inner;
    // A remainder that is too small for a band is added to the last one.
    const bool is_last = band.first_chunk + 2 * chunks > all_chunks;
    band.end_chunk = is_last ? all_chunks : band.first_chunk + chunks;
    // A joint that has a wall in the band belongs to it or to an earlier band.
    band.end_joint = is_last ? joints : std::min(joints, whole_chunks(scene.walls.first_joint[band.end_chunk]));
    band.end_inner =
        is_last ? particles
                : std::min(particles, joints + whole_chunks(end_of_inner(scene.walls, band.end_chunk - 1) - joints));
    bands.push_back(band);
  }
  return bands;
}

/// Whether each band interacts with its neighbours only.
bool are_apart(const Scene& scene, const std::vector<FaceLoop>& loops, const std::vector<LatticeBand>& bands) {
  const std::vector<int> of_particle = bands_of_particles(scene, bands);
  const std::vector<int> of_element = bands_of_elements(scene, bands);
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    for (const int particle : {scene.elements[e].start, scene.elements[e].end}) {
      if (of_particle[particle] > of_element[e] || of_particle[particle] < of_element[e] - 1) {
        return false;
      }
    }
  }
  std::vector<bool> has_border(bands.size(), false);
  for (const FaceLoop& loop : loops) {
    if (loop.is_outer()) {
      for (const int particle : loop.particle) {
        has_border[of_particle[particle]] = true;
      }
      continue;
    }
    const auto by_band = [&](int a, int b) { return of_particle[a] < of_particle[b]; };
    const auto [low, high] = std::minmax_element(loop.particle.begin(), loop.particle.end(), by_band);
    const int first = of_particle[*low];
    const int last = of_particle[*high];
    if (last > first + 1) {
      return false;
    }
    for (const int particle : loop.particle) {
      for (int k = scene.incidence_offset[particle]; k < scene.incidence_offset[particle + 1]; ++k) {
        const int band = of_element[scene.incidence[k]];
        if (band < last - 1 || band > first + 1) {
          return false;
        }
      }
    }
  }
  return std::find(has_border.begin(), has_border.end(), false) == has_border.end();
}

/// Whether bands that are not adjacent stay apart as the lattice is crushed: the band between them is pressed together
/// only if the bands follow each other along the crush. Its walls alone then keep them apart by their area over its
/// width.
bool stay_apart(const Scene& scene, const std::vector<LatticeBand>& bands) {
  if (!scene.plates.present) return true;
  const int axis = scene.plates.axis;
  const Vector2 from_first = scene.position[bands.back().first_joint] - scene.position[bands.front().first_joint];
  if (std::abs(from_first[axis]) <= std::abs(from_first[1 - axis])) return true;
  const double solid_depth = scene.solid_area / scene.width / static_cast<double>(bands.size());
  return solid_depth >= kSolidDepthOfBand * std::ranges::max(scene.walls.undeformed_length);
}

}  // namespace

std::size_t bytes_of_band(const Scene& scene) { return kBytesOfElement * scene.element_count() / scene.bands.size(); }

LatticeBand whole_band(const Scene& scene) {
  return {
      0, scene.walls.chunk_count(), 0, scene.joint_count, scene.joint_count, static_cast<int>(scene.particle_count())};
}

std::vector<LatticeBand> cut_into_bands(const Scene& scene, const std::vector<FaceLoop>& loops) {
  const bool may_be_cut = scene.element_count() >= kLeastElementsOfBands && scene.rigid.count() == 0 &&
                          scene.supports.empty() && !scene.is_loaded() && scene.contact.friction == 0.0 &&
                          scene.rigid_walls.empty() && scene.start_overlaps.empty() && !scene.contact.bends;
  const int all_chunks = scene.walls.chunk_count();
  // Whether the caches hold the bands of two steps, for bands of so many chunks.
  const auto are_small = [&](std::size_t chunks) {
    return 2 * kBandsBehind * (kBytesOfElement * scene.element_count() * chunks / all_chunks) <= kCacheOfBands;
  };
  std::vector<LatticeBand> smallest = {whole_band(scene)};
  for (int chunks = kLeastChunksOfBand; may_be_cut && are_small(chunks) && chunks * kLeastBands <= all_chunks;
       chunks += kMoreChunksOfBand) {
    std::vector<LatticeBand> bands = cut(scene, chunks);
    if (!are_apart(scene, loops, bands)) continue;
    if (stay_apart(scene, bands)) return bands;
    if (smallest.size() == 1) smallest = std::move(bands);
  }
  return smallest;
}

std::vector<int> bands_of_particles(const Scene& scene, const std::vector<LatticeBand>& bands) {
  std::vector<int> band_of(scene.particle_count());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    std::fill(band_of.begin() + bands[b].first_joint, band_of.begin() + bands[b].end_joint, static_cast<int>(b));
    std::fill(band_of.begin() + bands[b].first_inner, band_of.begin() + bands[b].end_inner, static_cast<int>(b));
  }
  return band_of;
}

std::vector<int> bands_of_elements(const Scene& scene, const std::vector<LatticeBand>& bands) {
  std::vector<int> band_of(scene.element_count());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    const WallBlock& first = scene.walls.blocks[scene.walls.chunk_offset[bands[b].first_chunk]];
    const WallBlock& last = scene.walls.blocks[scene.walls.chunk_offset[bands[b].end_chunk] - 1];
    std::fill(band_of.begin() + first.first_element, band_of.begin() + last.first_element + last.walls * last.elements,
              static_cast<int>(b));
  }
  return band_of;
}

}  // namespace cellcrush
