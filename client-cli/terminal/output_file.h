#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush::client {

/// A file that appears under its name only when complete. It is written beside it under a temporary name, flushed to
/// disk by finish() and renamed by commit(); without commit() it is deleted. Throws CommandError (refused) if it cannot
/// be written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  /// One that continues what an earlier one has left under the name of `path` and ".part". Without commit() its bytes
  /// stay there, unless the disk refuses some.
  static std::unique_ptr<OutputFile> continued(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// What is written so far, in parts.
  void read_back(const std::function<void(std::string_view part)>& take);
  /// Deletes what is written so far.
  void restart();
  /// Afterwards commit() needs no more room on the disk. Nothing can be written after it.
  void finish();
  void commit();

 private:
  OutputFile(std::filesystem::path path, std::string temporary, int descriptor);
  [[noreturn]] void fail(const char* what);

  std::filesystem::path path_;
  std::string temporary_;
  std::FILE* file_ = nullptr;
  bool keeps_part_ = false;  ///< true only while file_ is open
};

/// Writes a whole file of that kind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A folder with those that it is in. Creates the missing ones, and deletes these again with the object if they are
/// still empty. Throws CommandError (refused) if it cannot create them.
class OutputFolder {
 public:
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

 private:
  std::vector<std::filesystem::path> created_;  ///< the innermost first
};

/// Throws CommandError (refused) unless the name of `file` ends in one of `endings`, such as ".html", in any case.
void check_ending(const std::filesystem::path& file, const std::vector<std::string>& endings);

/// Whether `path` is a regular file that begins with one of `signatures`.
bool begins_with_one_of(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

/// Whether a file holds this text and nothing else.
bool holds_text(const std::filesystem::path& path, const std::string& text);

/// Throws CommandError (refused) if `path` exists and does not begin with one of `signatures`, so that no foreign file
/// is overwritten.
void check_may_overwrite(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

}  // namespace cellcrush::client
