#include "bench/picture_file.h"

#include <fstream>
#include <stdexcept>

namespace cellcrush::bench {

void write_picture(const std::string& file, double width, double height, const std::function<void(cairo_t*)>& draw) {
  const std::string picture = client::render_picture(client::picture_format(file), width, height, draw);
  std::ofstream stream(file, std::ios::binary);
  stream << picture;
  stream.flush();
  if (!stream) throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
}

}  // namespace cellcrush::bench
