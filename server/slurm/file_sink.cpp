#include "slurm/file_sink.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "slurm/small_file.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

// Calls `use` with the open reports, and throws its errno.
template <typename Use>
void with_reports(const std::filesystem::path& path, const Use& use) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  if (file < 0) store::throw_file_error(path, "written", errno);
  int error = use(file);
  if (close(file) != 0 && error == 0) error = errno;
  if (error != 0) store::throw_file_error(path, "written", error);
}

}  // namespace

void FolderSink::write_reports(std::uint64_t offset, const std::string& bytes) {
  with_reports(folder_.reports(), [&](int file) {
    for (std::size_t done = 0; done < bytes.size();) {
      const auto written = pwrite(file, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return errno;
      done += static_cast<std::size_t>(written);
    }
    return 0;
  });
}

void FolderSink::put_checkpoint(const std::string& bytes) {
  with_reports(folder_.reports(), [](int file) { return fdatasync(file) == 0 ? 0 : errno; });
  std::error_code error;
  std::filesystem::rename(folder_.checkpoint(), folder_.previous_checkpoint(), error);
  write_small_file(folder_.checkpoint(), bytes);
}

void FolderSink::put_result(const std::filesystem::path& file) { copy_durably(file, folder_.result()); }

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

}  // namespace cellcrush::slurm
