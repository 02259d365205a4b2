#pragma once

#include <unistd.h>

#include <utility>

namespace cellcrush {

/// An open file, closed on destruction.
class OpenFile {
 public:
  /// Takes over a file descriptor; -1: none.
  explicit OpenFile(int number = -1) : number_(number) {}
  ~OpenFile() { static_cast<void>(close()); }
  OpenFile(OpenFile&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }

  [[nodiscard]] int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

  /// Leaves it open, to the caller.
  [[nodiscard]] int release() { return std::exchange(number_, -1); }

  /// Closes it now. False, with errno, if bytes may be lost: NFS reports a full disk here.
  [[nodiscard]] bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

}  // namespace cellcrush
