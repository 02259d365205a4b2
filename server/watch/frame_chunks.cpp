#include "watch/frame_chunks.h"

#include <algorithm>

namespace cellcrush::watch {
namespace {

// Moves up to `room` numbers of `from`, starting at `done`, into `to`; returns how many.
int copy_some(const google::protobuf::RepeatedField<float>& from, int done, int room,
              google::protobuf::RepeatedField<float>& to) {
  const int count = std::min(room, from.size() - done);
  to.Add(from.begin() + done, from.begin() + done + count);
  return count;
}

}  // namespace

std::size_t chunk_bytes_beside(std::size_t mesh_bytes) {
  constexpr std::size_t kLeast = 100'000;
  return kChunkBytes - std::min(mesh_bytes, kChunkBytes - kLeast);
}

std::vector<v1::FrameChunk> chunks_of(const v1::FieldFrame& frame, std::size_t chunk_bytes) {
  const int per_chunk = std::max(1, static_cast<int>(chunk_bytes / sizeof(float)));
  std::vector<v1::FrameChunk> out;
  int positions = 0;
  int fractions = 0;
  do {
    v1::FrameChunk& chunk = out.emplace_back();
    chunk.set_part(static_cast<int>(out.size()) - 1);
    v1::FieldFrame& part = *chunk.mutable_frame();
    part.set_index(frame.index());
    part.set_time_s(frame.time_s());
    part.set_strain(frame.strain());
    const int copied = copy_some(frame.position_mm(), positions, per_chunk, *part.mutable_position_mm());
    positions += copied;
    fractions += copy_some(frame.plastic_fraction(), fractions, per_chunk - copied, *part.mutable_plastic_fraction());
  } while (positions < frame.position_mm_size() || fractions < frame.plastic_fraction_size());
  for (auto& chunk : out) chunk.set_part_count(static_cast<int>(out.size()));
  return out;
}

}  // namespace cellcrush::watch
