#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace cellcrush {

/// Receives bytes in pieces of any size.
using ByteSink = std::function<void(std::string_view)>;

/// Appends to `bytes`, which must outlive it.
inline ByteSink append_to(std::string& bytes) {
  return [&bytes](std::string_view more) { bytes += more; };
}

/// Passes values to a sink in their memory representation, for a reader of the same build. A list is preceded by its
/// length.
class ByteWriter {
 public:
  explicit ByteWriter(ByteSink sink) : sink_(std::move(sink)) {}

  template <class T>
  void put(const T& value) {
    if constexpr (requires { value.data(); }) {
      const std::uint64_t count = value.size();
      write(&count, sizeof(count));
      write(value.data(), count * sizeof(value[0]));
    } else {
      write(&value, sizeof(value));
    }
  }

 private:
  void write(const void* from, std::size_t size) { sink_({static_cast<const char*>(from), size}); }

  ByteSink sink_;
};

/// A known number of bytes, read in pieces. `read` writes the next bytes to a place, all or none; false if it cannot.
struct ByteSource {
  std::uint64_t size = 0;
  std::function<bool(char* to, std::size_t size)> read;
};

/// Of `bytes`, which must outlive it.
inline ByteSource source_of(std::string_view bytes) {
  return {bytes.size(), [bytes](char* to, std::size_t size) mutable {
            std::memcpy(to, bytes.data(), size);
            bytes.remove_prefix(size);
            return true;
          }};
}

/// Reads the values that a ByteWriter has written, in the same order.
class ByteReader {
 public:
  explicit ByteReader(ByteSource source) : source_(std::move(source)) {}

  /// Leaves the value unchanged if the source does not hold one; every later read then fails too.
  template <class T>
  void take(T& value) {
    if constexpr (requires { value.data(); }) {
      std::uint64_t count = 0;
      take(count);
      sound_ = sound_ && count <= source_.size / sizeof(value[0]);
      if (!sound_) return;
      value.resize(count);
      extract(value.data(), count * sizeof(value[0]));
    } else {
      extract(&value, sizeof(value));
    }
  }

  /// Whether every read so far has succeeded.
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool at_end() const { return source_.size == 0; }

 private:
  void extract(void* to, std::size_t size) {
    sound_ = sound_ && size <= source_.size;
    if (!sound_ || size == 0) return;
    sound_ = source_.read(static_cast<char*>(to), size);
    source_.size -= size;
  }

  ByteSource source_;
  bool sound_ = true;
};

}  // namespace cellcrush
