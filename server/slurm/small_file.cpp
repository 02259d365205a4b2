#include "slurm/small_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

// Calls `use` with the file open for writing, and throws the errno that it returns, for the file `shown`.
template <typename Use>
void with_file(const std::filesystem::path& path, const std::filesystem::path& shown, const Use& use) {
  OpenFile file = store::try_open_own(path, O_WRONLY | O_CREAT);
  if (!file) store::throw_file_error(shown, "written", errno);
  int error = use(file.get());
  if (!file.close() && error == 0) error = errno;
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
  static_cast<void>(store::remove_own(partial));
  try {
    with_file(partial, path, [&](int file) { return write_at(file, 0, content); });
    store::publish_file(partial, path);
  } catch (...) {
    static_cast<void>(store::remove_own(partial));
    throw;
  }
}

void write_in_place(const std::filesystem::path& path, const std::string& content, std::uint64_t offset) {
  with_file(path, path, [&](int file) { return write_at(file, offset, content); });
}

void make_durable(const std::filesystem::path& path) {
  with_file(path, path, [](int file) { return fdatasync(file) == 0 ? 0 : errno; });
}

void copy_durably(const std::filesystem::path& from, const std::filesystem::path& to, std::uint64_t most) {
  const std::filesystem::path partial = to.string() + ".partial";
  try {
    store::copy_own(from, partial, most);
  } catch (...) {
    static_cast<void>(store::remove_own(partial));
    throw;
  }
  store::publish_file(partial, to);
}

std::optional<std::string> read_small_file(const std::filesystem::path& path, std::uint64_t most) {
  const OpenFile file = store::try_open_own(path, O_RDONLY);
  if (!file) {
    for (const int absent : {ENOENT, ENOTDIR, ESTALE, ELOOP, store::kNotRegular}) {
      if (errno == absent) return std::nullopt;
    }
    store::throw_file_error(path, "read", errno);
  }
  struct stat status {};
  if (fstat(file.get(), &status) != 0 || static_cast<std::uint64_t>(status.st_size) > most) return std::nullopt;
  std::string out(static_cast<std::size_t>(status.st_size), '\0');
  out.resize(store::read_at(file, path, out.data(), out.size(), 0));
  return out;
}

}  // namespace cellcrush::slurm
