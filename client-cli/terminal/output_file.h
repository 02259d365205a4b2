#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace cellcrush::client {

/// A file that appears under its name only when it is complete: it is written beside it under a name of its own,
/// flushed to disk by finish() and renamed by commit(); without commit() it vanishes. Throws CommandError (refused)
/// when it cannot be written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  /// After it commit() needs no more room on the disk. Nothing is written any more.
  void finish();
  void commit();

 private:
  [[noreturn]] void fail(const char* what) const;

  std::filesystem::path path_;
  std::string temporary_;
  std::FILE* file_ = nullptr;
};

/// Whether `path` is a regular file that begins with one of `signatures`.
bool begins_with_one_of(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

/// Throws CommandError (refused) if `path` exists and is not a file that begins with one of `signatures`: what somebody
/// else wrote is not overwritten.
void check_may_overwrite(const std::filesystem::path& path, std::initializer_list<std::string_view> signatures);

}  // namespace cellcrush::client
