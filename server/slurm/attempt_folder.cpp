#include "slurm/attempt_folder.h"

#include <absl/strings/ascii.h>
#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <set>
#include <system_error>

#include "error.h"
#include "slurm/small_file.h"
#include "store/durable_file.h"
#include "store/lattice_file.h"
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
  const auto jobs = data_folder / "jobs";
  if (!store::find_own(jobs) && errno == ENOENT) return out;
  // Attempts are not to be taken for left ones because their jobs could not be read.
  for (const auto& name : store::names_in(jobs)) {
    if (const auto attempt = read_attempt(store::JobFolder(jobs / name))) out.insert(attempt->id());
  }
  return out;
}

// Whether an entry has the name of an attempt or a batch, perhaps with a suffix, and is a folder of this user.
bool is_of_daemon(const fs::path& path) {
  const std::string id = path.stem().string();
  const auto found = store::find_own(path);
  return id.size() == store::random_name().size() && std::ranges::all_of(id, absl::ascii_isxdigit) && found &&
         S_ISDIR(found->st_mode) && found->st_uid == geteuid();
}

template <typename IsUsed>
void remove_unused(const fs::path& folder, const IsUsed& is_used) {
  for (const auto& name : store::names_in(folder)) {
    const auto path = folder / name;
    if (is_used(path)) continue;
    if (!is_of_daemon(path)) {
      spdlog::warn("{} is not of cellcrushd and is left alone", path.string());
    } else if (const int error = store::remove_own(path); error == 0) {
      spdlog::info("{} was left by an earlier daemon and is removed", path.string());
    } else {
      spdlog::warn("{} was left by an earlier daemon and cannot be removed: {}", path.string(),
                   std::generic_category().message(error));
    }
  }
}

}  // namespace

AttemptFolder::AttemptFolder(const fs::path& shared, const std::string& id) : root_(shared / "attempts" / id) {
  if (id.empty() || id.front() == '.' || id.find('/') != std::string::npos)
    throw ServiceError(ServiceError::Kind::data_loss, "\"" + id + "\" is no attempt of " + shared.string() + ".");
}

bool AttemptFolder::exists() const {
  if (const auto found = store::find_own(root_)) return S_ISDIR(found->st_mode);
  const int error = errno;
  // Without the folder around it, something else is missing.
  if (error != ENOENT || !store::find_own(root_.parent_path().parent_path().append(kMarker)))
    store::throw_file_error(root_, "read", error == ENOENT ? ENODEV : error);
  return false;
}

void AttemptFolder::look_again() const { store::try_open_own(root_, O_RDONLY | O_DIRECTORY); }

// A hard link is created by one caller only, on NFS too, where exclusive creation of a file may be repeated by the
// client. If the answer of the server was lost, the number of links tells whether it was made.
bool AttemptFolder::claim(const Claim& claim) const {
  const std::string own = std::string(kClaim) + "." + store::random_name();
  if (!exists()) return false;
  try {
    write_small_file(file(own.c_str()), claim.SerializeAsString());
  } catch (...) {
    if (!exists()) return false;
    throw;
  }
  const OpenFile folder = store::try_open_own(root_, O_RDONLY | O_DIRECTORY);
  const int error = folder && linkat(folder.get(), own.c_str(), folder.get(), kClaim, 0) == 0 ? 0 : errno;
  const auto found = store::find_own(file(own.c_str()));
  const bool is_mine = error == 0 || (found && found->st_nlink == 2);
  static_cast<void>(store::remove_own(file(own.c_str())));
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
  const fs::path removed = root_.string() + ".removed";
  static_cast<void>(store::rename_own(root_, removed));
  static_cast<void>(store::remove_own(removed));
}

void require_marker(const fs::path& folder) {
  if (read_small_file(folder / kMarker)) return;
  store::throw_file_error(folder, "used", ENODEV);
}

void prepare_shared_folder(const ClusterOptions& options, const fs::path& data_folder) {
  const fs::path own = data_folder / "slurm" / options.name / "identity";
  auto folder = store::canonical_of(options.folder);
  const auto marker = folder / kMarker;
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
  make_folder(folder);
  folder = store::canonical_of(folder);
  store::require_own_folder(folder, name);
  for (const char* each : {"attempts", "batches"}) {
    if (const int error = store::make_own_folder(folder / each); error != 0 && error != EEXIST)
      store::throw_file_error(folder / each, "used", error);
    store::require_own_folder(folder / each, "--slurm " + options.name + ": " + (folder / each).string());
  }
  if (!found) {
    const std::string identity = store::random_name();
    write_small_file(own, identity);
    write_small_file(folder / kMarker, identity);
  }
  const auto named = named_attempts(data_folder);
  remove_unused(folder / "attempts", [&](const fs::path& path) { return named.contains(path.filename()); });
  store::remove_unused_lattices(folder / "lattices");
  remove_unused(folder / "batches", [&](const fs::path& path) {
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
