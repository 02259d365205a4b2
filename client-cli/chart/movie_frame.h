#pragma once

#include <string>

#include "chart/lattice_drawing.h"

namespace cellcrush::client {

/// A frame of a movie as PNG: the lattice inside `box` with strain and time above it. All frames of one box have the
/// same size, with even numbers of pixels, as video encoders require.
std::string render_movie_frame(const MeshFrame& stage, const Box& box);

}  // namespace cellcrush::client
