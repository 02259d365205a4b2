#include "slurm/small_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

// Calls `use` with the file open for writing, and throws the errno that it returns, for the file `shown`.
template <typename Use>
void with_file(const std::filesystem::path& path, const std::filesystem::path& shown, const Use& use) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(shown, "written", errno);
  int error = use(file);
  // NFS reports a full disk when the file is closed.
  if (close(file) != 0 && error == 0) error = errno;
  if (error != 0) store::throw_file_error(shown, "written", error);
}

int write_at(int file, std::uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto written = pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    offset += static_cast<std::uint64_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

}  // namespace

void write_small_file(const std::filesystem::path& path, const std::string& content) {
  const std::filesystem::path partial =
      path.string() + ".partial." + std::to_string(getpid()) + "." + std::to_string(gettid());
  unlink(partial.c_str());
  try {
    with_file(partial, path, [&](int file) { return write_at(file, 0, content); });
    store::publish_file(partial, path);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
}

void write_in_place(const std::filesystem::path& path, const std::string& content, std::uint64_t offset) {
  with_file(path, path, [&](int file) { return write_at(file, offset, content); });
}

void make_durable(const std::filesystem::path& path) {
  with_file(path, path, [](int file) { return fdatasync(file) == 0 ? 0 : errno; });
}

void copy_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  const std::filesystem::path partial = to.string() + ".partial";
  std::error_code error;
  std::filesystem::copy_file(from, partial, std::filesystem::copy_options::overwrite_existing, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    store::throw_file_error(to, "written", error.value());
  }
  store::publish_file(partial, to);
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
