#include "slurm/mirror.h"

#include <sys/stat.h>

#include <system_error>

#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/report_log.h"

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
  copy_durably(from_.result(), to_.result());
  result_ = version;
  return true;
}

// The checkpoint before becomes checkpoint.previous.
void Mirror::put_checkpoint(worker::PieceReader& from) const {
  make_durable(to_.reports());
  std::error_code ignored;
  worker::PieceWriter partial(to_.partial_checkpoint());
  while (from.left() > 0) partial.write(from.next(from.left()));
  partial.close();
  std::filesystem::rename(to_.checkpoint(), to_.previous_checkpoint(), ignored);
  store::publish_file(to_.partial_checkpoint(), to_.checkpoint());
}

bool Mirror::pass() {
  // In this order: whatever stands in the reports read below was preceded by the result, and the checkpoint read here
  // was preceded by reports that are there now.
  bool is_new = false;
  const auto checkpoint_version = version_of(from_.checkpoint());
  // Open, it stays the same file when the worker puts a newer one in its place.
  std::optional<worker::PieceReader> checkpoint;
  if (checkpoint_version && checkpoint_version != checkpoint_) checkpoint.emplace(from_.checkpoint());
  if (!version_of(from_.reports())) return false;
  // Opened at each pass: NFS looks for what other machines wrote when a file is opened.
  store::ReportLogReader reader(from_.reports());
  reader.start_at(offset_);
  for (bool more = true; more;) {
    std::string records;
    while (records.size() < kPart && (more = reader.read_record(records))) continue;
    if (records.empty()) break;
    is_new |= put_result();
    write_in_place(to_.reports(), records, offset_);
    offset_ += records.size();
    is_new = true;
  }
  // Also without new reports: a network file system may show it after the report that announces it.
  is_new |= put_result();
  if (checkpoint) {
    put_checkpoint(*checkpoint);
    checkpoint_ = checkpoint_version;
    is_new = true;
  }
  return is_new;
}

void copy_run(const store::JobFolder& from, const store::JobFolder& to) {
  for (const auto& [own, copy] :
       {std::pair(from.reports(), to.reports()), std::pair(from.checkpoint(), to.checkpoint()),
        std::pair(from.previous_checkpoint(), to.previous_checkpoint())}) {
    if (std::filesystem::exists(own)) copy_durably(own, copy);
  }
}

std::uint64_t size_of(const std::filesystem::path& path) {
  std::error_code error;
  const auto out = std::filesystem::file_size(path, error);
  return error ? 0 : out;
}

}  // namespace cellcrush::slurm
