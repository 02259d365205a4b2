#include "terminal/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

#include "command_error.h"

namespace cellcrush::client {

namespace {

constexpr mode_t kReadableFile = 0666;

mode_t find_umask() {
  const mode_t mask = umask(0);
  umask(mask);
  return mask;
}

}  // namespace

OutputFile::OutputFile(std::filesystem::path path, std::string temporary, int descriptor)
    : path_(std::move(path)), temporary_(std::move(temporary)), file_(fdopen(descriptor, "a+b")), keeps_part_(true) {}

std::unique_ptr<OutputFile> OutputFile::continued(const std::filesystem::path& path) {
  const std::string part = path.string() + ".part";
  const int descriptor =
      open(part.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, kReadableFile);
  if (descriptor < 0) refuse(part + ": cannot be written: " + std::strerror(errno));
  std::unique_ptr<OutputFile> file(new OutputFile(path, part, descriptor));
  struct stat status {};
  const bool is_regular = fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  // A file system without locks has one command at a time, by the user's care.
  const bool is_locked = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  struct stat named {};
  const bool is_taken = is_locked || lstat(part.c_str(), &named) != 0 || named.st_ino != status.st_ino;
  if (is_regular && !is_taken) return file;
  file->temporary_.clear();
  refuse(part + (is_taken ? ": another command is writing it; wait for its end, or name another folder"
                          : ": is not a file; move it away or name another folder"));
}

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)), temporary_(path_.string() + ".XXXXXX") {
  const int descriptor = mkostemp(temporary_.data(), O_CLOEXEC);
  if (descriptor < 0) {
    refuse(path_.string() + ": cannot be written: " + std::strerror(errno));
  }
  // mkostemp makes files for their owner alone.
  fchmod(descriptor, kReadableFile & ~find_umask());
  file_ = fdopen(descriptor, "wb");
}

OutputFile::~OutputFile() {
  const bool has_part =
      keeps_part_ && std::fflush(file_) == 0 && std::fseek(file_, 0, SEEK_END) == 0 && std::ftell(file_) > 0;
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty() && !has_part) unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("cannot be written");
}

void OutputFile::read_back(const std::function<void(std::string_view part)>& take) {
  std::vector<char> buffer(1 << 16);
  std::rewind(file_);
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file_)) take({buffer.data(), count});
  if (std::ferror(file_) != 0) fail("cannot be read");
  std::fseek(file_, 0, SEEK_END);
}

void OutputFile::restart() {
  if (std::fflush(file_) != 0 || ftruncate(fileno(file_), 0) != 0) fail("cannot be written");
}

void OutputFile::finish() {
  if (file_ == nullptr) return;
  if (std::fflush(file_) != 0 || fsync(fileno(file_)) != 0) fail("cannot be written");
  keeps_part_ = false;
  const int closed = std::fclose(std::exchange(file_, nullptr));
  if (closed != 0) fail("cannot be written");
}

void OutputFile::commit() {
  finish();
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be renamed into place");
  temporary_.clear();
}

void OutputFile::fail(const char* what) {
  keeps_part_ = false;
  refuse(path_.string() + ": " + what + ": " + std::strerror(errno));
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

OutputFolder::OutputFolder(const std::filesystem::path& folder) {
  std::error_code error;
  for (auto path = folder; !path.empty() && !std::filesystem::exists(path, error); path = path.parent_path()) {
    created_.push_back(path);
  }
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error)) {
    refuse(folder.string() + ": cannot create this folder: " + error.message());
  }
}

OutputFolder::~OutputFolder() {
  std::error_code not_empty;
  for (const auto& path : created_) std::filesystem::remove(path, not_empty);
}

void check_ending(const std::filesystem::path& file, const std::vector<std::string>& endings) {
  std::string ending = file.extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (std::ranges::find(endings, ending) != endings.end()) return;
  std::string known = endings.front();
  for (std::size_t i = 1; i < endings.size(); ++i) known += (i + 1 < endings.size() ? ", " : " or ") + endings[i];
  refuse(file.string() + ": not a format of this command; give -o a name that ends in " + known);
}

bool begins_with_one_of(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(path, error);
  std::size_t longest = 0;
  for (const std::string_view signature : signatures) longest = std::max(longest, signature.size());
  std::string begin(std::filesystem::is_regular_file(status) ? longest : 0, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return std::ranges::any_of(signatures, [&](std::string_view signature) { return begin.starts_with(signature); });
}

bool holds_text(const std::filesystem::path& path, const std::string& text) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) != text.size() || error) return false;
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {}) == text;
}

void check_may_overwrite(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(path, error);
  if (status.type() == std::filesystem::file_type::not_found || begins_with_one_of(path, signatures)) return;
  refuse(path.string() + ": exists and was not written by cellcrush; move it away or name another folder");
}

}  // namespace cellcrush::client
