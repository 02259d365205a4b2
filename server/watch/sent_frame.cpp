#include "watch/sent_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "zlib_bytes.h"

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

/// The particles of lower indices whose motion tells what to expect of a particle's; kNone: the one before it.
using Guides = std::array<int, 2>;
constexpr int kNone = -1;

std::vector<Guides> guides_of(const v1::Mesh& mesh, int particles) {
  std::vector<Guides> guides(static_cast<std::size_t>(particles), {kNone, kNone});
  for (int e = 0; e + 1 < mesh.element_nodes_size(); e += 2) {
    const auto [low, high] = std::minmax({mesh.element_nodes(e), mesh.element_nodes(e + 1)});
    if (low < 0 || high >= particles) continue;
    auto& [first, second] = guides[high];
    if (first == kNone) {
      first = low;
    } else if (second == kNone) {
      second = low;
    }
  }
  return guides;
}

/// Differences of rounded numbers from what is expected. `guides` is empty, or has those of each particle.
class Differences {
 public:
  Differences(const std::vector<double>& moved, double quantum, int particles, std::vector<Guides> guides)
      : guides_(std::move(guides)), particles_(static_cast<std::size_t>(particles)), rounded_(moved.size()) {
    std::ranges::transform(moved, rounded_.begin(), [quantum](double value) {
      return static_cast<int>(quantum > 0.0 ? std::lround(value / quantum) : 0);
    });
  }

  /// The low bytes, then the high ones.
  [[nodiscard]] std::string bytes() const {
    const std::size_t count = rounded_.size();
    std::string out(2 * count, '\0');
    for (std::size_t i = 0; i < count; ++i) {
      const auto difference = static_cast<std::uint16_t>(rounded_[i] - expected(i));
      out[i] = static_cast<char>(difference & 0xFFU);
      out[count + i] = static_cast<char>(difference >> 8U);
    }
    return out;
  }

 private:
  [[nodiscard]] int expected(std::size_t i) const {
    const std::size_t begin = i < particles_ ? 0 : particles_;
    const Guides guides = guides_.empty() ? Guides{kNone, kNone} : guides_[i - begin];
    if (guides[0] == kNone) return i == begin ? 0 : rounded_[i - 1];
    const int first = rounded_[begin + guides[0]];
    return guides[1] == kNone ? first : (first + rounded_[begin + guides[1]]) >> 1;
  }

  std::vector<Guides> guides_;
  std::size_t particles_;
  std::vector<int> rounded_;
};

/// Finer than the thinnest wall can be seen.
double finest_quantum(const v1::Mesh* mesh) {
  constexpr double kOfThickness = 1.0 / 16.0;
  if (mesh == nullptr || mesh->thickness_mm().empty()) return 0.0;
  return kOfThickness * *std::ranges::min_element(mesh->thickness_mm());
}

/// Rounded to as many levels as the pictures have colours.
char byte_of(float plastic_fraction) {
  constexpr float kLevels = 63.0F;
  const float rounded = std::round(kLevels * std::clamp(plastic_fraction, 0.0F, 1.0F)) / kLevels;
  return static_cast<char>(std::lround(255.0F * rounded));
}

// Takes the arrays of a message piece by piece: what is left of a part's room goes to the next array.
class Room {
 public:
  explicit Room(std::size_t bytes) : bytes_(bytes) {}

  // Moves what fits of `from`, from number `done` on, into `to`.
  template <class Number>
  void take(const google::protobuf::RepeatedField<Number>& from, int& done,
            google::protobuf::RepeatedField<Number>& to) {
    const int count = std::min(static_cast<int>(bytes_ / kBytesOfNumber), from.size() - done);
    // By pointers, which copy as blocks; the iterators of a repeated field do not.
    to.Add(from.data() + done, from.data() + done + count);
    done += count;
    bytes_ -= static_cast<std::size_t>(count) * kBytesOfNumber;
  }
  void take(const std::string& from, std::size_t& done, std::string& to) {
    const std::size_t count = std::min(bytes_, from.size() - done);
    to = from.substr(done, count);
    done += count;
    bytes_ -= count;
  }

 private:
  static constexpr std::size_t kBytesOfNumber = 4;  // a float, or a node's number below 2^28
  std::size_t bytes_;
};

template <class Chunk>
void number_parts(std::vector<Chunk>& chunks) {
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    chunks[i].set_part(static_cast<int>(i));
    chunks[i].set_part_count(static_cast<int>(chunks.size()));
  }
}

}  // namespace

v1::FieldFrame pack(const v1::FieldFrame& frame, const v1::Mesh* mesh) {
  v1::FieldFrame out;
  out.set_index(frame.index());
  out.set_time_s(frame.time_s());
  out.set_strain(frame.strain());
  *out.mutable_broken_end() = frame.broken_end();
  *out.mutable_end_position_mm() = frame.end_position_mm();
  auto& packed = *out.mutable_packed();
  const int particles = frame.position_mm_size() / 2;
  packed.set_particle_count(particles);
  packed.set_element_count(frame.plastic_fraction_size());
  const auto moved = displacements(frame, mesh);
  double largest = 0.0;
  for (const double value : moved) largest = std::max(largest, std::abs(value));
  packed.set_quantum_mm(std::max(largest / kLargest, finest_quantum(mesh)));
  packed.set_predicted_by_elements(mesh != nullptr);
  std::vector<Guides> guides = mesh == nullptr ? std::vector<Guides>() : guides_of(*mesh, particles);
  std::string bytes = Differences(moved, packed.quantum_mm(), particles, std::move(guides)).bytes();
  std::ranges::transform(frame.plastic_fraction(), std::back_inserter(bytes), byte_of);
  packed.set_data(zlib_of(bytes));
  return out;
}

std::vector<v1::FrameChunk> chunks_of(const v1::FieldFrame& frame, std::size_t chunk_bytes) {
  std::vector<v1::FrameChunk> out;
  int positions = 0;
  int fractions = 0;
  int strains = 0;
  int local_strains = 0;
  int broken_ends = 0;
  int end_positions = 0;
  std::size_t packed = 0;
  do {
    Room room(std::max<std::size_t>(chunk_bytes, sizeof(float)));
    v1::FieldFrame& part = *out.emplace_back().mutable_frame();
    part.set_index(frame.index());
    part.set_time_s(frame.time_s());
    part.set_strain(frame.strain());
    room.take(frame.broken_end(), broken_ends, *part.mutable_broken_end());
    room.take(frame.end_position_mm(), end_positions, *part.mutable_end_position_mm());
    room.take(frame.position_mm(), positions, *part.mutable_position_mm());
    room.take(frame.plastic_fraction(), fractions, *part.mutable_plastic_fraction());
    room.take(frame.fibre_strain(), strains, *part.mutable_fibre_strain());
    room.take(frame.local_strain(), local_strains, *part.mutable_local_strain());
    if (!frame.has_packed()) continue;
    part.mutable_packed()->set_quantum_mm(frame.packed().quantum_mm());
    part.mutable_packed()->set_particle_count(frame.packed().particle_count());
    part.mutable_packed()->set_element_count(frame.packed().element_count());
    part.mutable_packed()->set_predicted_by_elements(frame.packed().predicted_by_elements());
    room.take(frame.packed().data(), packed, *part.mutable_packed()->mutable_data());
  } while (positions < frame.position_mm_size() || fractions < frame.plastic_fraction_size() ||
           broken_ends < frame.broken_end_size() || end_positions < frame.end_position_mm_size() ||
           strains < frame.fibre_strain_size() || local_strains < frame.local_strain_size() ||
           packed < frame.packed().data().size());
  number_parts(out);
  return out;
}

std::vector<v1::MeshChunk> chunks_of(const v1::Mesh& mesh, std::size_t chunk_bytes) {
  v1::Mesh head;
  head.set_particle_count(mesh.particle_count());
  head.set_rigid_element_count(mesh.rigid_element_count());
  head.set_length_mm(mesh.length_mm());
  head.set_width_mm(mesh.width_mm());
  head.set_impact_plate_mm(mesh.impact_plate_mm());
  head.set_support_plate_mm(mesh.support_plate_mm());
  head.set_along_y(mesh.along_y());
  head.set_side_low_mm(mesh.side_low_mm());
  head.set_side_high_mm(mesh.side_high_mm());
  std::vector<v1::MeshChunk> out;
  int nodes = 0;
  int thicknesses = 0;
  int positions = 0;
  int walls = 0;
  int overlaps = 0;
  int gripped = 0;
  do {
    Room room(std::max<std::size_t>(chunk_bytes, sizeof(float)));
    v1::Mesh& part = *out.emplace_back().mutable_mesh();
    part = head;
    room.take(mesh.element_nodes(), nodes, *part.mutable_element_nodes());
    room.take(mesh.thickness_mm(), thicknesses, *part.mutable_thickness_mm());
    room.take(mesh.position_mm(), positions, *part.mutable_position_mm());
    room.take(mesh.element_wall(), walls, *part.mutable_element_wall());
    room.take(mesh.overlap_particle(), overlaps, *part.mutable_overlap_particle());
    room.take(mesh.gripped(), gripped, *part.mutable_gripped());
  } while (nodes < mesh.element_nodes_size() || thicknesses < mesh.thickness_mm_size() ||
           positions < mesh.position_mm_size() || walls < mesh.element_wall_size() ||
           overlaps < mesh.overlap_particle_size() || gripped < mesh.gripped_size());
  number_parts(out);
  return out;
}

}  // namespace cellcrush::watch
