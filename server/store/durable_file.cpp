#include "store/durable_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace cellcrush::store {
namespace {

void synchronize(const std::filesystem::path& path, int flags) {
  const OpenFile file = open_file(path, flags);
  if (fsync(file.get()) != 0) throw_file_error(path, "written", errno);
}

}  // namespace

void throw_file_error(const std::filesystem::path& path, std::string_view used, int error) {
  const std::string message =
      path.string() + " cannot be " + std::string(used) + ": " + std::generic_category().message(error) + ".";
  if (const Shortage shortage = shortage_of_errno(error); shortage != Shortage::none)
    throw ServiceError(shortage, message);
  throw ServiceError(ServiceError::Kind::internal, message);
}

OpenFile open_file(const std::filesystem::path& path, int flags, std::string_view used) {
  OpenFile file(open(path.c_str(), flags | O_CLOEXEC, 0600));
  if (!file) throw_file_error(path, used, errno);
  return file;
}

OpenFile open_to_read(const std::filesystem::path& path, ServiceError::Kind otherwise) {
  OpenFile file = open_file(path, O_RDONLY | O_NONBLOCK, "read");
  struct stat status {};
  if (fstat(file.get(), &status) != 0) throw_file_error(path, "read", errno);
  if (S_ISREG(status.st_mode)) return file;
  throw ServiceError(otherwise, path.string() + " cannot be read: it is not a regular file. Move it away.");
}

std::size_t read_at(const OpenFile& file, const std::filesystem::path& path, void* to, std::size_t most,
                    std::uint64_t offset) {
  std::size_t done = 0;
  while (done < most) {
    const auto count = pread(file.get(), static_cast<char*>(to) + done, most - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_file_error(path, "read", errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

void write_all(const OpenFile& file, const std::filesystem::path& path, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto count = write(file.get(), bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw_file_error(path, "written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

bool synchronize_file(const std::filesystem::path& path) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
  if (!file && shortage_of_errno(errno) != Shortage::descriptors) return false;
  if (!file || fdatasync(file.get()) != 0) throw_file_error(path, "written", errno);
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
    : path_(path), file_(open_to_read(path, ServiceError::Kind::data_loss)), size_(lseek(file_.get(), 0, SEEK_END)) {}

std::string InputFile::read(std::int64_t offset, std::size_t most) const {
  std::string out(std::min(most, static_cast<std::size_t>(size_ - offset)), '\0');
  if (read_at(file_, path_, out.data(), out.size(), static_cast<std::uint64_t>(offset)) < out.size())
    throw ServiceError(ServiceError::Kind::data_loss, path_.string() + " was truncated while being read.");
  return out;
}

}  // namespace cellcrush::store
