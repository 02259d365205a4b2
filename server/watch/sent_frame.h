#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/v1/event.pb.h"

namespace cellcrush::watch {

/// The frame with its numbers packed (FieldFrame.Packed). `mesh` is the one that receivers have; null: they have none.
/// Without positions in it the displacements are the positions.
v1::FieldFrame pack(const v1::FieldFrame& frame, const v1::Mesh* mesh);

/// Maximum size of the numbers in one part of a frame or mesh, so that every part passes gRPC's default limit of 4 MiB.
inline constexpr std::size_t kChunkBytes = 3'000'000;

/// A frame in parts: appending the arrays, or the packed data, of all parts in order gives the frame. A small frame is
/// one part.
std::vector<v1::FrameChunk> chunks_of(const v1::FieldFrame& frame, std::size_t chunk_bytes = kChunkBytes);

/// The same of a mesh.
std::vector<v1::MeshChunk> chunks_of(const v1::Mesh& mesh, std::size_t chunk_bytes = kChunkBytes);

}  // namespace cellcrush::watch
