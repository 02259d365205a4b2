#include "slurm/mirror.h"

#include <sys/stat.h>

#include "error.h"
#include "slurm/small_file.h"

namespace cellcrush::slurm {
namespace {

// Reports are copied in parts of about this size.
constexpr std::size_t kPart = std::size_t{1} << 20;

}  // namespace

std::optional<Mirror::Version> Mirror::version_of(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return Version{status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

bool Mirror::put_result() {
  const auto version = version_of(from_.result());
  if (!version || version == result_) return false;
  to_.put_result(from_.result());
  result_ = version;
  return true;
}

bool Mirror::pass() {
  // In this order: whatever stands in the reports read below was preceded by the result, and the checkpoint read here
  // was preceded by reports that are there now.
  bool is_new = false;
  const auto checkpoint_version = version_of(from_.checkpoint());
  std::optional<std::string> checkpoint;
  if (checkpoint_version && checkpoint_version != checkpoint_) checkpoint = read_small_file(from_.checkpoint());
  if (!version_of(from_.reports())) return false;
  // Opened at each pass: NFS looks for what other machines wrote when a file is opened.
  store::ReportLogReader reader(from_.reports());
  reader.start_at(offset_);
  for (bool more = true; more;) {
    std::string records;
    while (records.size() < kPart && (more = reader.read_record(records))) continue;
    if (records.empty()) break;
    is_new |= put_result();
    to_.write_reports(offset_, records);
    offset_ += records.size();
    is_new = true;
  }
  // Also without new reports: a network file system may show it after the report that announces it.
  is_new |= put_result();
  if (checkpoint) {
    to_.put_checkpoint(*checkpoint);
    checkpoint_ = checkpoint_version;
    is_new = true;
  }
  return is_new;
}

}  // namespace cellcrush::slurm
