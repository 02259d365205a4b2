#include "store/result_seal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
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
constexpr std::int64_t kSettled = 2;  // seconds
constexpr std::size_t kSealBytes = 64;
constexpr std::size_t kBlockBytes = 512;  // the user block with the seal of versions before
constexpr std::string_view kHdf5 = "\x89HDF\r\n\x1a\n";
constexpr std::string_view kTitle = "CELLCRUSH RESULT 2 ";
constexpr std::size_t kMarkAt = 16;  // of a superblock of version 0: half the entries of a group's leaf

std::string bytes_at(const OpenFile& file, const std::filesystem::path& path, std::uint64_t offset, std::size_t size) {
  std::string out(size, '\0');
  out.resize(read_at(file, path, out.data(), out.size(), offset));
  return out;
}

// Where the seal is, and the bytes that it is of.
struct Place {
  int version = 2;
  std::uint64_t seal = 0;
  std::size_t seal_size = kSealBytes;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// Nothing for an HDF5 file that has none and need have none.
std::optional<Place> find_seal(const OpenFile& file, const std::filesystem::path& path, std::uint64_t size) {
  const std::string start = bytes_at(file, path, 0, kMarkAt + 1);
  if (!start.starts_with(kHdf5))
    return Place{1, 0, kBlockBytes, kBlockBytes, std::max<std::uint64_t>(size, kBlockBytes)};
  const std::uint64_t end = size - std::min<std::uint64_t>(size, kSealBytes);
  const bool is_marked = start.size() > kMarkAt && start[kMarkAt] == kSealedLeaf;
  if (!is_marked && !bytes_at(file, path, end, kSealBytes).starts_with(kTitle)) return std::nullopt;
  return Place{2, end, kSealBytes, 0, end};
}

// The seal that these bytes should have.
std::string seal_of(const OpenFile& file, const std::filesystem::path& path, const Place& place,
                    const std::function<void()>& go_on = {}) {
  std::vector<unsigned char> part(kPart);
  std::uint64_t crc = 0;
  for (std::uint64_t at = place.begin; at < place.end;) {
    if (go_on) go_on();
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(part.size(), place.end - at));
    const std::size_t count = read_at(file, path, part.data(), wanted, at);
    if (count == 0) return "";
    crc = crc32_z(crc, part.data(), count);
    at += count;
  }
  std::string out = fmt::format("CELLCRUSH RESULT {} {} {}\n", place.version, crc, place.end - place.begin);
  out.resize(place.seal_size, '\0');
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
  const auto size = static_cast<std::uint64_t>(identity_of(file, path)[2]);
  Place place = find_seal(file, path, size).value_or(Place{});
  const bool is_sealed = bytes_at(file, path, place.seal, kSealBytes).starts_with(kTitle);
  if (!is_sealed) place = {2, size, kSealBytes, 0, size};
  const std::string seal = seal_of(file, path, place);
  if (lseek(file.get(), static_cast<off_t>(place.seal), SEEK_SET) < 0) throw_file_error(path, "written", errno);
  write_all(file, path, seal);
}

Seal read_seal(const std::filesystem::path& path, std::optional<FileIdentity>* whole,
               const std::function<void()>& go_on) {
  static WholeFiles found_whole;
  const OpenFile file = open_to_read(path, ServiceError::Kind::internal, LastLink::of_owner);
  const auto identity = identity_of(file, path);
  if (!found_whole.contains(identity)) {
    const auto place = find_seal(file, path, static_cast<std::uint64_t>(identity[2]));
    if (!place) return Seal::missing;
    if (bytes_at(file, path, place->seal, place->seal_size) != seal_of(file, path, *place, go_on)) return Seal::broken;
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

void check_seal_if_any(const std::filesystem::path& path, const std::function<void()>& go_on) {
  throw_if_broken(read_seal(path, nullptr, go_on));
}

}  // namespace cellcrush::store
