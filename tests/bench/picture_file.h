#pragma once

#include <functional>
#include <string>

#include "chart/canvas.h"

namespace cellcrush::bench {

/// Draws a picture into a file whose name ends in .svg or .png. Throws std::invalid_argument on another name,
/// std::runtime_error when it cannot be written.
void write_picture(const std::string& file, double width, double height, const std::function<void(cairo_t*)>& draw);

}  // namespace cellcrush::bench
