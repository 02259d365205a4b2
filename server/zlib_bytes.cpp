#include "zlib_bytes.h"

#include <zlib.h>

#include <new>

namespace cellcrush {

std::string zlib_of(std::string_view bytes) {
  uLongf size = compressBound(bytes.size());
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), bytes.size(), Z_DEFAULT_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();  // its only failure, as the room suffices
  out.resize(size);
  return out;
}

}  // namespace cellcrush
