#include "slurm/attempt_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <system_error>

#include "slurm/small_file.h"
#include "store/durable_file.h"

namespace cellcrush::slurm {
namespace {

constexpr const char* kClaim = "claim";
constexpr const char* kBeat = "heartbeat";
constexpr const char* kRequest = "request";
constexpr const char* kEnded = "ended";
constexpr std::size_t kBeatSize = 20;

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
  const auto own = file((std::string(kClaim) + "." + random_name()).c_str());
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

}  // namespace cellcrush::slurm
