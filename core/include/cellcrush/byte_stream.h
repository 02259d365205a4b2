#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace cellcrush {

/// Appends values to a byte string in their memory representation, for a reader of the same build. A list is preceded
/// by its length.
class ByteWriter {
 public:
  explicit ByteWriter(std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void put(const T& value) {
    if constexpr (requires { value.data(); }) {
      const std::uint64_t count = value.size();
      append(&count, sizeof(count));
      append(value.data(), count * sizeof(value[0]));
    } else {
      append(&value, sizeof(value));
    }
  }

 private:
  void append(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }

  std::string& bytes_;
};

/// Reads the values that a ByteWriter has written, in the same order.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

  /// Leaves the value unchanged if the bytes do not hold one; every later read then fails too.
  template <class T>
  void take(T& value) {
    if constexpr (requires { value.data(); }) {
      std::uint64_t count = 0;
      take(count);
      sound_ = sound_ && count <= bytes_.size() / sizeof(value[0]);
      if (!sound_) return;
      value.resize(count);
      extract(value.data(), count * sizeof(value[0]));
    } else {
      extract(&value, sizeof(value));
    }
  }

  /// Whether every read so far has succeeded.
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] bool at_end() const { return bytes_.empty(); }

 private:
  void extract(void* to, std::size_t size) {
    sound_ = sound_ && size <= bytes_.size();
    if (!sound_ || size == 0) return;
    std::memcpy(to, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
  bool sound_ = true;
};

}  // namespace cellcrush
