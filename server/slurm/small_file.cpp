#include "slurm/small_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <random>

#include "store/durable_file.h"

namespace cellcrush::slurm {

void write_small_file(const std::filesystem::path& path, const std::string& content) {
  const std::filesystem::path partial =
      path.string() + ".partial." + std::to_string(getpid()) + "." + std::to_string(gettid());
  const int file = open(partial.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(path, "written", errno);
  const auto written = write(file, content.data(), content.size());
  const int error = written == static_cast<ssize_t>(content.size()) ? 0 : (written < 0 ? errno : ENOSPC);
  // NFS reports a full disk when the file is closed.
  const int close_error = close(file) == 0 ? 0 : errno;
  if (error != 0 || close_error != 0) {
    unlink(partial.c_str());
    store::throw_file_error(path, "written", error != 0 ? error : close_error);
  }
  try {
    store::publish_file(partial, path);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
}

void write_in_place(const std::filesystem::path& path, const std::string& content) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(path, "written", errno);
  const auto written = pwrite(file, content.data(), content.size(), 0);
  int error = written == static_cast<ssize_t>(content.size()) ? 0 : (written < 0 ? errno : ENOSPC);
  if (close(file) != 0 && error == 0) error = errno;
  if (error != 0) store::throw_file_error(path, "written", error);
}

std::string random_name() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

std::optional<std::string> read_small_file(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (file < 0 && (errno == ENOENT || errno == ENOTDIR || errno == ESTALE)) return std::nullopt;
  if (file < 0) store::throw_file_error(path, "read", errno);
  std::string out;
  std::array<char, 4096> part{};
  ssize_t count = 0;
  while ((count = read(file, part.data(), part.size())) != 0) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;
    out.append(part.data(), static_cast<std::size_t>(count));
  }
  const int error = errno;
  close(file);
  if (count < 0 && error == ESTALE) return std::nullopt;
  if (count < 0) store::throw_file_error(path, "read", error);
  return out;
}

}  // namespace cellcrush::slurm
