#include "terminal/output_file.h"

#include <fcntl.h>
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
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail("cannot be written");
}

void OutputFile::finish() {
  if (file_ == nullptr) return;
  if (std::fflush(file_) != 0 || fsync(fileno(file_)) != 0) fail("cannot be written");
  const int closed = std::fclose(std::exchange(file_, nullptr));
  if (closed != 0) fail("cannot be written");
}

void OutputFile::commit() {
  finish();
  if (std::rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot be renamed into place");
  temporary_.clear();
}

void OutputFile::fail(const char* what) const { refuse(path_.string() + ": " + what + ": " + std::strerror(errno)); }

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
