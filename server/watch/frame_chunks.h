#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/v1/event.pb.h"

namespace cellcrush::watch {

/// Maximum size of the numbers in one part of a frame, so that every part passes gRPC's default limit of 4 MiB.
inline constexpr std::size_t kChunkBytes = 3'000'000;

/// The same for a frame whose first part carries a mesh of this size. A mesh of up to 4 MB fits.
std::size_t chunk_bytes_beside(std::size_t mesh_bytes);

/// A frame in parts: appending the arrays of all parts in order gives the frame. A small frame is one part.
std::vector<v1::FrameChunk> chunks_of(const v1::FieldFrame& frame, std::size_t chunk_bytes = kChunkBytes);

}  // namespace cellcrush::watch
