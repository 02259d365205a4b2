#include "store/change_count.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <sstream>

#include "error.h"
#include "store/durable_file.h"
#include "store/journal_schema.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kLongestLine = 200;

// One line of fixed length, written at once and in place: it needs no room on a full disk.
std::string line_of(const std::string& epoch, std::int64_t count) {
  const std::string out = fmt::format("{} {:020}", epoch, count);
  const auto crc = crc32_z(0, reinterpret_cast<const unsigned char*>(out.data()), out.size());
  return fmt::format("{} {:08x}\n", out, crc);
}

// The numbers of deleted ones count too.
std::int64_t changes_of(Database& journal) {
  return Statement(journal,
                   "SELECT MAX(COALESCE((SELECT seq FROM sqlite_sequence WHERE name = 'changes'), 0), "
                   "COALESCE((SELECT MAX(number) FROM changes), 0))")
      .number();
}

}  // namespace

ChangeCount::ChangeCount(const std::filesystem::path& data_folder) : path_(data_folder / "journal.changes") {
  std::string line(kLongestLine, '\0');
  const OpenFile file = try_open_own(path_, O_RDONLY);
  line.resize(file ? read_at(file, path_, line.data(), line.size(), 0) : 0);
  line.resize(std::min(line.find('\n'), line.size()));
  std::istringstream words(line);
  if (words >> epoch_ >> count_ && line + "\n" == line_of(epoch_, count_)) return;
  epoch_.clear();
  count_ = 0;
}

std::int64_t ChangeCount::lost(Database& journal) const {
  const std::int64_t count = changes_of(journal);
  // A journal that has lost everything is a new one, of another epoch.
  return epoch_ == read_epoch(journal).id || count == 0 ? std::max<std::int64_t>(count_ - count, 0) : 0;
}

void ChangeCount::note(Database& journal) {
  try {
    const std::int64_t count = changes_of(journal);
    if (file_ && count == count_) return;
    if (!file_) {
      epoch_ = read_epoch(journal).id;
      file_ = open_own(path_, O_WRONLY | O_CREAT);
    }
    const std::string line = line_of(epoch_, count);
    if (pwrite(file_.get(), line.data(), line.size(), 0) == static_cast<ssize_t>(line.size())) count_ = count;
  } catch (const ServiceError&) {
    return;
  }
}

}  // namespace cellcrush::store
