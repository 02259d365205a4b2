#include "access/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "error.h"
#include "open_file.h"

namespace cellcrush::access {
namespace {

constexpr std::size_t kLargestNamedFile = 1024 * 1024;

std::string reason() { return "cannot be read: " + std::generic_category().message(errno) + "."; }

}  // namespace

void refuse_file(const std::string& option, const std::filesystem::path& path, const std::string& why) {
  throw ServiceError(ServiceError::Kind::invalid, option + " " + path.string() + ": " + why);
}

std::string read_named_file(const std::string& option, const std::filesystem::path& path, Secrecy secrecy) {
  const OpenFile file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  // Checked on the open descriptor, so that the file cannot be replaced in between.
  if (!file || fstat(file.get(), &status) != 0) refuse_file(option, path, reason());
  if (!S_ISREG(status.st_mode)) refuse_file(option, path, "is not a regular file.");
  if (secrecy == Secrecy::secret && (status.st_mode & S_IROTH) != 0)
    refuse_file(option, path, "is readable by other users. Run chmod 600 " + path.string());
  if (secrecy == Secrecy::secret && (status.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    refuse_file(option, path, "is writable by users other than its owner. Run chmod 600 " + path.string());
  std::string text;
  std::array<char, 65536> buffer{};
  ssize_t count = 0;
  while ((count = read(file.get(), buffer.data(), buffer.size())) > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(count));
    if (text.size() > kLargestNamedFile) refuse_file(option, path, "is larger than 1 MiB. Is it the right file?");
  }
  if (count < 0) refuse_file(option, path, reason());
  return text;
}

}  // namespace cellcrush::access
