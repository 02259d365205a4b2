#include "store/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "error.h"

namespace cellcrush::store {

namespace {

void synchronize(const std::filesystem::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) throw_file_error(path, "written", errno);
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  if (error != 0) throw_file_error(path, "written", error);
}

}  // namespace

void throw_file_error(const std::filesystem::path& path, std::string_view used, int error) {
  const std::string message =
      path.string() + " cannot be " + std::string(used) + ": " + std::generic_category().message(error) + ".";
  if (const Shortage shortage = shortage_of_errno(error); shortage != Shortage::none)
    throw ServiceError(shortage, message);
  throw ServiceError(ServiceError::Kind::internal, message);
}

int open_to_read(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) throw_file_error(path, "read", errno);
  struct stat status {};
  if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) return file;
  close(file);
  throw ServiceError(ServiceError::Kind::internal,
                     path.string() + " cannot be read: it is not a regular file. Move it away.");
}

bool synchronize_file(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0 && shortage_of_errno(errno) != Shortage::descriptors) return false;
  const int error = file >= 0 && fdatasync(file) == 0 ? 0 : errno;
  if (file >= 0) close(file);
  if (error != 0) throw_file_error(path, "written", error);
  return true;
}

void publish_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  synchronize(from, O_RDONLY);
  std::error_code error;
  std::filesystem::rename(from, to, error);
  if (error) throw_file_error(to, "written", error.value());
  synchronize(to.parent_path(), O_RDONLY | O_DIRECTORY);
}

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
