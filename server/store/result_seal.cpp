#include "store/result_seal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <ctime>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"
#include "mutex.h"
#include "store/durable_file.h"
#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

constexpr std::size_t kPart = 65536;
constexpr std::int64_t kSettled = 2;                   // seconds
constexpr std::string_view kUnsealed = "\x89HDF\r\n";  // an HDF5 file without a user block

// An open file that closes itself. Failures throw ServiceError.
class SealedFile {
 public:
  SealedFile(int descriptor, const std::filesystem::path& path) : path_(path), descriptor_(descriptor) {
    if (descriptor_ < 0) throw_file_error(path_, "used", errno);
  }
  ~SealedFile() { close(descriptor_); }
  SealedFile(const SealedFile&) = delete;
  SealedFile& operator=(const SealedFile&) = delete;

  // The seal that these bytes should have.
  [[nodiscard]] std::string seal() const {
    std::vector<unsigned char> part(kPart);
    std::uint64_t crc = 0;
    std::uint64_t size = 0;
    while (const std::size_t count = read(part.data(), part.size(), kSealBytes + size)) {
      crc = crc32_z(crc, part.data(), count);
      size += count;
    }
    std::string out = "CELLCRUSH RESULT 1 " + std::to_string(crc) + " " + std::to_string(size) + "\n";
    out.resize(kSealBytes, '\0');
    return out;
  }

  [[nodiscard]] std::string stored_seal() const {
    std::string out(kSealBytes, '\0');
    out.resize(read(out.data(), out.size(), 0));
    return out;
  }

  void write_seal(const std::string& seal) const {
    ssize_t count = 0;
    do count = pwrite(descriptor_, seal.data(), seal.size(), 0);
    while (count < 0 && errno == EINTR);
    if (count != static_cast<ssize_t>(seal.size())) throw_file_error(path_, "written", count < 0 ? errno : EIO);
  }

  // Changes whenever the file does, unless two changes fall within one tick of the file system's clock.
  using Identity = std::array<std::int64_t, 5>;
  [[nodiscard]] Identity identity() const {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) throw_file_error(path_, "read", errno);
    return {static_cast<std::int64_t>(status.st_dev), static_cast<std::int64_t>(status.st_ino), status.st_size,
            status.st_ctim.tv_sec, status.st_ctim.tv_nsec};
  }

 private:
  std::size_t read(void* to, std::size_t most, std::uint64_t offset) const {
    ssize_t count = 0;
    do count = pread(descriptor_, to, most, static_cast<off_t>(offset));
    while (count < 0 && errno == EINTR);
    if (count < 0) throw_file_error(path_, "read", errno);
    return static_cast<std::size_t>(count);
  }

  std::filesystem::path path_;
  int descriptor_;
};

// Whether the last write is old enough that a later change would alter its identity.
bool is_settled(const SealedFile::Identity& file) { return std::time(nullptr) - file[3] >= kSettled; }

// The most recent files found whole.
class WholeFiles {
 public:
  bool contains(const SealedFile::Identity& file) {
    const MutexLock lock(mutex_);
    return std::find(files_.begin(), files_.end(), file) != files_.end();
  }

  void add(const SealedFile::Identity& file) {
    const MutexLock lock(mutex_);
    files_.push_back(file);
    if (files_.size() > kMost) files_.pop_front();
  }

 private:
  static constexpr std::size_t kMost = 64;

  Mutex mutex_;
  std::deque<SealedFile::Identity> files_ CELLCRUSH_GUARDED_BY(mutex_);
};

void throw_if_broken(Seal seal) {
  if (seal == Seal::broken) throw damaged_result("its contents do not match its checksum");
}

}  // namespace

void seal_result(const std::filesystem::path& path) {
  const SealedFile file(open(path.c_str(), O_RDWR | O_CLOEXEC), path);
  file.write_seal(file.seal());
}

Seal read_seal(const std::filesystem::path& path) {
  static WholeFiles whole;
  const SealedFile file(open_to_read(path), path);
  const auto identity = file.identity();
  if (whole.contains(identity)) return Seal::whole;
  const std::string stored = file.stored_seal();
  if (stored.starts_with(kUnsealed)) return Seal::missing;
  if (stored != file.seal()) return Seal::broken;
  if (is_settled(identity)) whole.add(identity);
  return Seal::whole;
}

void check_seal(const std::filesystem::path& path) {
  const Seal seal = read_seal(path);
  if (seal == Seal::missing) {
    throw ServiceError(ServiceError::Kind::failed_precondition,
                       "An earlier version wrote this result without a checksum, so the daemon does not read frames "
                       "from it. Download the file; it is regular HDF5.");
  }
  throw_if_broken(seal);
}

void check_seal_if_any(const std::filesystem::path& path) { throw_if_broken(read_seal(path)); }

}  // namespace cellcrush::store
