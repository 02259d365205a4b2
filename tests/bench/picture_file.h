#pragma once

#include <fstream>
#include <functional>
#include <stdexcept>
#include <string>

#include "chart/canvas.h"

namespace cellcrush::bench {

/// Draws a picture into a file whose name ends in .svg or .png. Throws std::invalid_argument on another name,
/// std::runtime_error when it cannot be written.
inline void write_picture(const std::string& file, double width, double height,
                          const std::function<void(cairo_t*)>& draw) {
  const std::string picture = client::render_picture(client::picture_format(file), width, height, draw);
  std::ofstream stream(file, std::ios::binary);
  stream << picture << std::flush;
  if (!stream) throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
}

}  // namespace cellcrush::bench
