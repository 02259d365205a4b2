#include "slurm/mirror.h"

#include <sys/stat.h>

#include <algorithm>

#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/report_log.h"

namespace cellcrush::slurm {
namespace {

// Reports are copied in parts of about this size.
constexpr std::size_t kPart = std::size_t{1} << 20;
// Five small reports a second, whatever the size of the job.
constexpr std::uint64_t kProgressAnHour = std::uint64_t{4} << 20;

}  // namespace

// A run goes on while no daemon follows it.
Mirror::Mirror(store::JobFolder from, store::JobFolder to, std::uint64_t reports_from, std::uint64_t most)
    : from_(std::move(from)), to_(std::move(to)), start_(reports_from), most_(most), offset_(reports_from) {
  const auto copied = version_of(from_.reports()) ? version_of(to_.reports()) : std::nullopt;
  since_ = copied ? std::chrono::system_clock::from_time_t(copied->seconds) : std::chrono::system_clock::now();
}

std::optional<Mirror::Version> Mirror::version_of(const std::filesystem::path& path) {
  const auto status = store::find_own(path);
  if (!status || !S_ISREG(status->st_mode)) return std::nullopt;
  return Version{status->st_ino, status->st_size, status->st_mtim.tv_sec, status->st_mtim.tv_nsec};
}

bool Mirror::put_result() {
  const auto version = version_of(from_.result());
  if (!version || version == result_) return false;
  copy_durably(from_.result(), to_.result(), most_);
  result_ = version;
  return true;
}

// The checkpoint before becomes checkpoint.previous.
void Mirror::put_checkpoint() const {
  make_durable(to_.reports());
  static_cast<void>(store::rename_own(to_.checkpoint(), to_.previous_checkpoint()));
  store::publish_file(to_.partial_checkpoint(), to_.checkpoint());
}

// Of the reports before they are read: one of them may be as large as all.
void Mirror::require_room() const {
  if (most_ == std::numeric_limits<std::uint64_t>::max()) return;
  const auto hours = std::chrono::duration_cast<std::chrono::hours>(std::chrono::system_clock::now() - since_);
  const std::uint64_t size = size_of(from_.reports());
  store::require_size(from_.reports(), size - std::min(size, start_),
                      most_ + static_cast<std::uint64_t>(std::max<std::int64_t>(0, hours.count())) * kProgressAnHour);
}

bool Mirror::pass() {
  // In this order: whatever stands in the reports read below was preceded by the result, and the checkpoint read here
  // was preceded by reports that are there now.
  bool is_new = false;
  const auto checkpoint_version = version_of(from_.checkpoint());
  if (!version_of(from_.reports())) return false;
  const bool has_checkpoint = checkpoint_version && checkpoint_version != checkpoint_;
  if (has_checkpoint) store::copy_own(from_.checkpoint(), to_.partial_checkpoint(), most_);
  require_room();
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
  if (has_checkpoint) {
    put_checkpoint();
    checkpoint_ = checkpoint_version;
    is_new = true;
  }
  return is_new;
}

void copy_run(const store::JobFolder& from, const store::JobFolder& to) {
  for (const auto& [own, copy] :
       {std::pair(from.reports(), to.reports()), std::pair(from.checkpoint(), to.checkpoint()),
        std::pair(from.previous_checkpoint(), to.previous_checkpoint())}) {
    if (store::is_own_file(own)) copy_durably(own, copy);
  }
}

std::uint64_t size_of(const std::filesystem::path& path) {
  const auto found = store::find_own(path);
  return found ? static_cast<std::uint64_t>(found->st_size) : 0;
}

}  // namespace cellcrush::slurm
