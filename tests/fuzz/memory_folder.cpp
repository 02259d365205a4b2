#include "fuzz/memory_folder.h"

#include <cstdlib>
#include <filesystem>

namespace cellcrush::fuzz {

void use_memory_folder() {
  if (std::filesystem::exists("/dev/shm")) setenv("TMPDIR", "/dev/shm", 0);
}

}  // namespace cellcrush::fuzz
