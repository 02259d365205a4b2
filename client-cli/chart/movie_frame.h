#pragma once

#include <string>

#include "chart/lattice_drawing.h"

namespace cellcrush::client {

/// A frame of a movie as PNG: the lattice inside `box` with strain and time above it. All frames of one box have one
/// size, an even number of pixels either way, as video encoders need it.
std::string render_movie_frame(const MeshFrame& stage, const Box& box);

}  // namespace cellcrush::client
