#include "slurm/attempt_folder.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <set>
#include <system_error>

#include "error.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/resource_name.h"

namespace cellcrush::slurm {
namespace {

namespace fs = std::filesystem;

constexpr const char* kClaim = "claim";
constexpr const char* kBeat = "heartbeat";
constexpr const char* kRequest = "request";
constexpr const char* kEnded = "ended";
constexpr std::size_t kBeatSize = 20;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) store::throw_file_error(folder, "used", error.value());
}

[[noreturn]] void refuse_folder(const std::string& why) {
  throw ServiceError(ServiceError::Kind::failed_precondition, why);
}

// The ids of the attempts that jobs name.
std::set<std::string> named_attempts(const fs::path& data_folder) {
  std::set<std::string> out;
  std::error_code error;
  for (fs::directory_iterator entry(data_folder / "jobs", error), end; !error && entry != end; entry.increment(error)) {
    if (const auto attempt = read_attempt(store::JobFolder(entry->path()))) out.insert(attempt->id());
  }
  // Attempts are not to be taken for left ones because their jobs could not be read.
  if (error && error != std::errc::no_such_file_or_directory)
    store::throw_file_error(data_folder / "jobs", "read", error.value());
  return out;
}

template <typename IsUsed>
void remove_unused(const fs::path& folder, const IsUsed& is_used) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (is_used(entry->path())) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
    spdlog::info("{} was left by an earlier daemon and is removed", entry->path().string());
  }
}

}  // namespace

bool AttemptFolder::exists() const {
  struct stat status {};
  if (stat(root_.c_str(), &status) == 0) return S_ISDIR(status.st_mode);
  const int error = errno;
  // Without the folder around it, something else is missing.
  if (error != ENOENT || stat(root_.parent_path().parent_path().append(kMarker).c_str(), &status) != 0)
    store::throw_file_error(root_, "read", error == ENOENT ? ENODEV : error);
  return false;
}

void AttemptFolder::look_again() const {
  const int folder = open(root_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder >= 0) close(folder);
}

// A hard link is created by one caller only, on NFS too, where exclusive creation of a file may be repeated by the
// client. If the answer of the server was lost, the number of links tells whether it was made.
bool AttemptFolder::claim(const Claim& claim) const {
  const auto own = file((std::string(kClaim) + "." + store::random_name()).c_str());
  if (!exists()) return false;
  try {
    write_small_file(own, claim.SerializeAsString());
  } catch (...) {
    if (!exists()) return false;
    throw;
  }
  const int error = link(own.c_str(), file(kClaim).c_str()) == 0 ? 0 : errno;
  struct stat status {};
  const bool is_mine = error == 0 || (stat(own.c_str(), &status) == 0 && status.st_nlink == 2);
  unlink(own.c_str());
  if (is_mine) return true;
  if (error != 0 && error != EEXIST && error != ENOENT && error != ESTALE)
    store::throw_file_error(file(kClaim), "written", error);
  return false;
}

std::optional<Claim> AttemptFolder::find_claim() const { return read_message<Claim>(file(kClaim)); }

void AttemptFolder::beat(std::uint64_t number) const {
  std::array<char, kBeatSize> text{};
  text.fill(' ');
  std::to_chars(text.data(), text.data() + text.size(), number);
  write_in_place(file(kBeat), {text.data(), text.size()});
}

std::optional<std::uint64_t> AttemptFolder::last_beat() const {
  const auto text = read_small_file(file(kBeat));
  std::uint64_t out = 0;
  if (!text || std::from_chars(text->data(), text->data() + text->size(), out).ec != std::errc()) return std::nullopt;
  return out;
}

void AttemptFolder::request(Request::Kind kind) const {
  Request request;
  request.set_kind(kind);
  write_in_place(file(kRequest), request.SerializeAsString());
}

Request::Kind AttemptFolder::requested() const {
  look_again();
  if (const auto found = read_message<Request>(file(kRequest))) return found->kind();
  return exists() ? Request::NONE : Request::ABANDON;
}

void AttemptFolder::end(const Ended& ended) const { write_small_file(file(kEnded), ended.SerializeAsString()); }

std::optional<Ended> AttemptFolder::find_ended() const { return read_message<Ended>(file(kEnded)); }

// Renamed first: a task that claims the attempt meanwhile finds either the whole folder or none.
void AttemptFolder::remove() const {
  std::error_code ignored;
  const std::filesystem::path removed = root_.string() + ".removed";
  std::filesystem::rename(root_, removed, ignored);
  std::filesystem::remove_all(removed, ignored);
}

void require_marker(const fs::path& folder) {
  if (read_small_file(folder / kMarker)) return;
  store::throw_file_error(folder, "used", ENODEV);
}

void prepare_shared_folder(const ClusterOptions& options, const fs::path& data_folder) {
  const fs::path own = data_folder / "slurm" / options.name / "identity";
  const auto marker = options.folder / kMarker;
  const auto expected = read_small_file(own);
  const auto found = read_small_file(marker);
  const std::string name = "--slurm " + options.name + ": " + options.folder.string();
  if (expected && !found)
    refuse_folder(name + " lacks the file " + kMarker +
                  " that this daemon wrote. Mount its file system; if you emptied "
                  "the folder, delete " +
                  own.string() + ".");
  if (found && found != expected)
    refuse_folder(name +
                  " belongs to a daemon with another data folder. Give each daemon a folder of its own; if that "
                  "daemon is no more, delete " +
                  marker.string() + ".");
  make_folder(own.parent_path());
  make_folder(options.folder / "attempts");
  make_folder(options.folder / "batches");
  if (!found) {
    const std::string identity = store::random_name();
    write_small_file(own, identity);
    write_small_file(marker, identity);
  }
  const auto named = named_attempts(data_folder);
  remove_unused(options.folder / "attempts", [&](const fs::path& path) { return named.contains(path.filename()); });
  remove_unused(options.folder / "batches", [&](const fs::path& path) {
    const auto batch = read_message<Batch>(path / "tasks");
    if (!batch) return false;
    for (const auto& task : batch->tasks()) {
      for (const auto& id : task.attempts()) {
        if (named.contains(id)) return true;
      }
    }
    return false;
  });
}

void write_attempt(const store::JobFolder& job, const Attempt& attempt) {
  write_small_file(job.attempt(), attempt.SerializeAsString());
}

std::optional<Attempt> read_attempt(const store::JobFolder& job) { return read_message<Attempt>(job.attempt()); }

}  // namespace cellcrush::slurm
