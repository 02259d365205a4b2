#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace cellcrush::client {

/// A file that appears under its name only when complete. It is written beside it under a temporary name, flushed to
/// disk by finish() and renamed by commit(); without commit() it is deleted. Throws CommandError (refused) if it cannot
/// be written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// Afterwards commit() needs no more room on the disk. Nothing can be written after it.
  void finish();
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  std::string temporary_;
  std::FILE* file_ = nullptr;
};

/// Writes a whole file of that kind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Creates a folder and those that it is in. Throws CommandError (refused) if it cannot.
void make_folder(const std::filesystem::path& folder);

/// Whether `path` is a regular file that begins with one of `signatures`.
bool begins_with_one_of(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

/// Whether a file holds this text and nothing else.
bool holds_text(const std::filesystem::path& path, const std::string& text);

/// Throws CommandError (refused) if `path` exists and does not begin with one of `signatures`, so that no foreign file
/// is overwritten.
void check_may_overwrite(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

}  // namespace cellcrush::client
