#include "watch/packed_frame.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace cellcrush::watch {
namespace {

constexpr double kLargest = 32767.0;

// Displacements of all particles along both directions, mm: first all along x, then all along y.
std::vector<double> displacements(const v1::FieldFrame& frame, const v1::Mesh* mesh) {
  const int particles = frame.position_mm_size() / 2;
  const bool is_known = mesh != nullptr && mesh->position_mm_size() == 2 * particles;
  std::vector<double> out;
  out.reserve(2 * static_cast<std::size_t>(particles));
  for (int axis = 0; axis < 2; ++axis) {
    for (int i = axis; i < 2 * particles; i += 2) {
      const double moved = static_cast<double>(frame.position_mm(i)) - (is_known ? mesh->position_mm(i) : 0.0);
      out.push_back(std::isfinite(moved) ? moved : 0.0);
    }
  }
  return out;
}

// The differences of the rounded numbers, their low bytes first.
std::string bytes_of(const std::vector<double>& moved, double quantum, int particles) {
  const std::size_t count = moved.size();
  std::string out(2 * count, '\0');
  std::uint16_t before = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == static_cast<std::size_t>(particles)) before = 0;
    const auto rounded = static_cast<std::uint16_t>(quantum > 0.0 ? std::lround(moved[i] / quantum) : 0);
    const auto difference = static_cast<std::uint16_t>(rounded - before);
    out[i] = static_cast<char>(difference & 0xFFU);
    out[count + i] = static_cast<char>(difference >> 8U);
    before = rounded;
  }
  return out;
}

std::string compressed(const std::string& bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();  // its only failure, as the room suffices
  out.resize(size);
  return out;
}

}  // namespace

v1::FieldFrame pack(const v1::FieldFrame& frame, const v1::Mesh* mesh) {
  v1::FieldFrame out;
  out.set_index(frame.index());
  out.set_time_s(frame.time_s());
  out.set_strain(frame.strain());
  auto& packed = *out.mutable_packed();
  const int particles = frame.position_mm_size() / 2;
  packed.set_particle_count(particles);
  packed.set_element_count(frame.plastic_fraction_size());
  const auto moved = displacements(frame, mesh);
  double largest = 0.0;
  for (const double value : moved) largest = std::max(largest, std::abs(value));
  packed.set_quantum_mm(largest / kLargest);
  std::string bytes = bytes_of(moved, packed.quantum_mm(), particles);
  for (const float fraction : frame.plastic_fraction())
    bytes.push_back(static_cast<char>(std::lround(255.0F * std::clamp(fraction, 0.0F, 1.0F))));
  packed.set_data(compressed(bytes));
  return out;
}

}  // namespace cellcrush::watch
