#include "store/result_seal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "mutex.h"
#include "store/durable_file.h"
#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kPart = 65536;
constexpr std::int64_t kSettled = 2;                   // seconds
constexpr std::string_view kUnsealed = "\x89HDF\r\n";  // an HDF5 file without a user block

// The seal that these bytes should have.
std::string seal_of(const OpenFile& file, const std::filesystem::path& path) {
  std::vector<unsigned char> part(kPart);
  std::uint64_t crc = 0;
  std::uint64_t size = 0;
  while (const std::size_t count = read_at(file, path, part.data(), part.size(), kSealBytes + size)) {
    crc = crc32_z(crc, part.data(), count);
    size += count;
  }
  std::string out = "CELLCRUSH RESULT 1 " + std::to_string(crc) + " " + std::to_string(size) + "\n";
  out.resize(kSealBytes, '\0');
  return out;
}

std::string stored_seal(const OpenFile& file, const std::filesystem::path& path) {
  std::string out(kSealBytes, '\0');
  out.resize(read_at(file, path, out.data(), out.size(), 0));
  return out;
}

FileIdentity identity_of(const OpenFile& file, const std::filesystem::path& path) {
  struct stat status {};
  if (fstat(file.get(), &status) != 0) throw_file_error(path, "read", errno);
  return {static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino), status.st_size,
          status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
}

// Whether the last write is old enough that a later change would alter its identity.
bool is_settled(const FileIdentity& file) { return std::time(nullptr) - file[3] >= kSettled; }

// The most recent files found whole.
class WholeFiles {
 public:
  bool contains(const FileIdentity& file) {
    const MutexLock lock(mutex_);
    return std::find(files_.begin(), files_.end(), file) != files_.end();
  }

  void add(const FileIdentity& file) {
    const MutexLock lock(mutex_);
    files_.push_back(file);
    if (files_.size() > kMost) files_.pop_front();
  }

 private:
  static constexpr std::size_t kMost = 64;

  Mutex mutex_;
  std::deque<FileIdentity> files_ CELLCRUSH_GUARDED_BY(mutex_);
};

void throw_if_broken(Seal seal) {
  if (seal == Seal::broken) throw damaged_result("its contents do not match its checksum");
}

}  // namespace

void seal_result(const std::filesystem::path& path) {
  const OpenFile file = open_own(path, O_RDWR, "used");
  write_all(file, path, seal_of(file, path));
}

Seal read_seal(const std::filesystem::path& path, std::optional<FileIdentity>* whole) {
  static WholeFiles found_whole;
  const OpenFile file = open_to_read(path, ServiceError::Kind::internal, LastLink::of_owner);
  const auto identity = identity_of(file, path);
  if (!found_whole.contains(identity)) {
    const std::string stored = stored_seal(file, path);
    if (stored.starts_with(kUnsealed)) return Seal::missing;
    if (stored != seal_of(file, path)) return Seal::broken;
    if (!is_settled(identity)) return Seal::whole;
    found_whole.add(identity);
  }
  if (whole != nullptr) *whole = identity;
  return Seal::whole;
}

std::optional<FileIdentity> check_seal(const std::filesystem::path& path) {
  std::optional<FileIdentity> whole;
  const Seal seal = read_seal(path, &whole);
  if (seal == Seal::missing) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "An earlier version wrote this result without a checksum, so the daemon does not read frames "
                       "from it. Download the file; it is regular HDF5.");
  }
  throw_if_broken(seal);
  return whole;
}

void check_seal_if_any(const std::filesystem::path& path) { throw_if_broken(read_seal(path)); }

}  // namespace cellcrush::store
