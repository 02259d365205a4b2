#include "store/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "error.h"
#include "store/durable_file.h"

namespace cellcrush::store {

InputFile::InputFile(const std::filesystem::path& path)
    : path_(path), descriptor_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0) throw_file_error(path_, "read", errno);
  struct stat status {};
  const int error = fstat(descriptor_, &status) == 0 ? 0 : errno;
  if (error == 0 && S_ISREG(status.st_mode)) {
    size_ = status.st_size;
    return;
  }
  close(descriptor_);
  if (error != 0) throw_file_error(path_, "read", error);
  throw ServiceError(ServiceError::Kind::data_loss, path_.string() + " cannot be read: it is not a regular file.");
}

InputFile::~InputFile() { close(descriptor_); }

std::string InputFile::read(std::int64_t offset, std::size_t most) const {
  std::string out(std::min(most, static_cast<std::size_t>(size_ - offset)), '\0');
  std::size_t done = 0;
  while (done < out.size()) {
    const auto count =
        pread(descriptor_, out.data() + done, out.size() - done, offset + static_cast<std::int64_t>(done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_file_error(path_, "read", errno);
    if (count == 0)
      throw ServiceError(ServiceError::Kind::data_loss, path_.string() + " was truncated while being read.");
    done += static_cast<std::size_t>(count);
  }
  return out;
}

}  // namespace cellcrush::store
