#include "store/durable_file.h"

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace cellcrush::store {
namespace {

void synchronize(const std::filesystem::path& path, int flags) {
  const OpenFile file = open_own(path, flags);
  if (fsync(file.get()) != 0) throw_file_error(path, "written", errno);
}

std::string reason_of(int error) {
  if (error == ELOOP) return "it is a symbolic link, or lies behind one. Put what the link names in its place";
  if (error == kNotRegular) return "it is not a regular file. Move it away";
  return std::generic_category().message(error);
}

}  // namespace

void throw_file_error(const std::filesystem::path& path, std::string_view used, int error) {
  const std::string message = path.string() + " cannot be " + std::string(used) + ": " + reason_of(error) + ".";
  if (const Shortage shortage = shortage_of_errno(error); shortage != Shortage::none)
    throw ServiceError(shortage, message);
  throw ServiceError(ServiceError::Kind::internal, message);
}

OpenFile open_file(const std::filesystem::path& path, int flags, std::string_view used) {
  OpenFile file(open(path.c_str(), flags | O_CLOEXEC, 0600));
  if (!file) throw_file_error(path, used, errno);
  return file;
}

OpenFile open_own(const std::filesystem::path& path, int flags, std::string_view used) {
  OpenFile file = try_open_own(path, flags);
  if (!file) throw_file_error(path, used, errno);
  return file;
}

OpenFile open_to_read(const std::filesystem::path& path, ServiceError::Kind otherwise, LastLink link) {
  OpenFile file = try_open_own(path, O_RDONLY, link);
  if (file) return file;
  if (errno != ELOOP && errno != kNotRegular) throw_file_error(path, "read", errno);
  throw ServiceError(otherwise, path.string() + " cannot be read: " + reason_of(errno) + ".");
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

void require_size(const std::filesystem::path& path, std::uint64_t size, std::uint64_t most) {
  constexpr std::uint64_t kMebibyte = 1024 * 1024;
  if (size <= most) return;
  throw ServiceError(ServiceError::Kind::exhausted, path.string() + " has " + std::to_string(size / kMebibyte) +
                                                        " MiB; at most " + std::to_string(most / kMebibyte) +
                                                        " MiB were expected.");
}

void copy_own(const std::filesystem::path& from, const std::filesystem::path& to, std::uint64_t most) {
  constexpr std::size_t kPart = std::size_t{1} << 20;
  const OpenFile source = open_to_read(from);
  require_size(from, static_cast<std::uint64_t>(lseek(source.get(), 0, SEEK_END)), most);
  OpenFile copy = open_own(to, O_WRONLY | O_CREAT | O_TRUNC);
  std::string part(kPart, '\0');
  std::uint64_t offset = 0;
  while (const std::size_t size = read_at(source, from, part.data(), part.size(), offset)) {
    offset += size;
    require_size(from, offset, most);
    write_all(copy, to, {part.data(), size});
  }
  if (!copy.close()) throw_file_error(to, "written", errno);
}

bool synchronize_file(const std::filesystem::path& path) {
  const OpenFile file = try_open_own(path, O_RDONLY);
  if (!file && shortage_of_errno(errno) != Shortage::descriptors) return false;
  if (!file || fdatasync(file.get()) != 0) throw_file_error(path, "written", errno);
  return true;
}

void publish_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  synchronize(from, O_RDONLY);
  if (const int error = rename_own(from, to); error != 0) throw_file_error(to, "written", error);
  synchronize(to.parent_path(), O_RDONLY | O_DIRECTORY);
}

InputFile::InputFile(const std::filesystem::path& path, LastLink link)
    : path_(path),
      file_(open_to_read(path, ServiceError::Kind::data_loss, link)),
      size_(lseek(file_.get(), 0, SEEK_END)) {}

std::string InputFile::read(std::int64_t offset, std::size_t most) const {
  std::string out(std::min(most, static_cast<std::size_t>(size_ - offset)), '\0');
  if (read_at(file_, path_, out.data(), out.size(), static_cast<std::uint64_t>(offset)) < out.size())
    throw ServiceError(ServiceError::Kind::data_loss, path_.string() + " was truncated while being read.");
  return out;
}

}  // namespace cellcrush::store
