#include "watch/frame_chunks.h"

#include <algorithm>

namespace cellcrush::watch {
namespace {

// Takes the arrays of a message piece by piece: what is left of a part's room goes to the next array.
class Room {
 public:
  explicit Room(std::size_t bytes) : bytes_(bytes) {}

  // Moves what fits of `from`, from number `done` on, into `to`.
  template <class Number>
  void take(const google::protobuf::RepeatedField<Number>& from, int& done,
            google::protobuf::RepeatedField<Number>& to) {
    const int count = std::min(static_cast<int>(bytes_ / kBytesOfNumber), from.size() - done);
    to.Add(from.begin() + done, from.begin() + done + count);
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

std::vector<v1::FrameChunk> chunks_of(const v1::FieldFrame& frame, std::size_t chunk_bytes) {
  std::vector<v1::FrameChunk> out;
  int positions = 0;
  int fractions = 0;
  std::size_t packed = 0;
  do {
    Room room(std::max<std::size_t>(chunk_bytes, sizeof(float)));
    v1::FieldFrame& part = *out.emplace_back().mutable_frame();
    part.set_index(frame.index());
    part.set_time_s(frame.time_s());
    part.set_strain(frame.strain());
    room.take(frame.position_mm(), positions, *part.mutable_position_mm());
    room.take(frame.plastic_fraction(), fractions, *part.mutable_plastic_fraction());
    if (!frame.has_packed()) continue;
    part.mutable_packed()->set_quantum_mm(frame.packed().quantum_mm());
    part.mutable_packed()->set_particle_count(frame.packed().particle_count());
    part.mutable_packed()->set_element_count(frame.packed().element_count());
    part.mutable_packed()->set_predicted_by_elements(frame.packed().predicted_by_elements());
    room.take(frame.packed().data(), packed, *part.mutable_packed()->mutable_data());
  } while (positions < frame.position_mm_size() || fractions < frame.plastic_fraction_size() ||
           packed < frame.packed().data().size());
  number_parts(out);
  return out;
}

std::vector<v1::MeshChunk> chunks_of(const v1::Mesh& mesh, std::size_t chunk_bytes) {
  v1::Mesh head;
  head.set_particle_count(mesh.particle_count());
  head.set_length_mm(mesh.length_mm());
  head.set_width_mm(mesh.width_mm());
  head.set_impact_plate_mm(mesh.impact_plate_mm());
  head.set_support_plate_mm(mesh.support_plate_mm());
  head.set_along_y(mesh.along_y());
  std::vector<v1::MeshChunk> out;
  int nodes = 0;
  int thicknesses = 0;
  int positions = 0;
  do {
    Room room(std::max<std::size_t>(chunk_bytes, sizeof(float)));
    v1::Mesh& part = *out.emplace_back().mutable_mesh();
    part = head;
    room.take(mesh.element_nodes(), nodes, *part.mutable_element_nodes());
    room.take(mesh.thickness_mm(), thicknesses, *part.mutable_thickness_mm());
    room.take(mesh.position_mm(), positions, *part.mutable_position_mm());
  } while (nodes < mesh.element_nodes_size() || thicknesses < mesh.thickness_mm_size() ||
           positions < mesh.position_mm_size());
  number_parts(out);
  return out;
}

}  // namespace cellcrush::watch
