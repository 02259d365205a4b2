#include "store/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "error.h"

namespace cellcrush::store {

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

namespace {

void synchronize(const std::filesystem::path& path, int flags) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) throw_file_error(path, "written", errno);
  const int error = fsync(file) == 0 ? 0 : errno;
  close(file);
  if (error != 0) throw_file_error(path, "written", error);
}

}  // namespace

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

}  // namespace cellcrush::store
