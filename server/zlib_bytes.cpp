#include "zlib_bytes.h"

#include <zlib.h>

#include <new>

namespace cellcrush {
namespace {

constexpr int kLargestWindow = 15;
constexpr int kGzip = 16;  // added to the window
constexpr int kMemory = 8;

std::string deflated(std::string_view bytes, int level, int window) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, window, kMemory, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);  // the room suffices
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

}  // namespace

std::string zlib_of(std::string_view bytes) { return deflated(bytes, Z_DEFAULT_COMPRESSION, kLargestWindow); }

std::string gzip_of(std::string_view bytes) { return deflated(bytes, Z_BEST_COMPRESSION, kLargestWindow + kGzip); }

}  // namespace cellcrush
