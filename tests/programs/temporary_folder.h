#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace cellcrush::testing {

/// A new folder that goes away with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// All of a file.
std::string text_of_file(const std::filesystem::path& path);

/// Changes bits of the byte at `offset`, as a bad disk would.
void flip_bits(const std::filesystem::path& path, std::uintmax_t offset, unsigned bits = 1);

}  // namespace cellcrush::testing
