#pragma once

#include <google/protobuf/message_lite.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace cellcrush::slurm {

/// Writes a small file as a whole: readers on any machine see the old content or the new one, and it survives a power
/// loss. Throws ServiceError, with the shortage if there is one.
void write_small_file(const std::filesystem::path& path, const std::string& content);

/// Writes bytes over those of a file from `offset` on, or into a new one. Needs no room if the file had as many. Throws
/// ServiceError.
void write_in_place(const std::filesystem::path& path, const std::string& content, std::uint64_t offset = 0);

/// Returns once what was written in place is durable. Throws ServiceError.
void make_durable(const std::filesystem::path& path);

/// Copies a file durably under its final name. Throws ServiceError.
void copy_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Nothing if the file is absent. Throws ServiceError if it cannot be read for another reason.
std::optional<std::string> read_small_file(const std::filesystem::path& path);

/// A message in such a file. A file that is not this message is treated as absent.
template <typename Message>
std::optional<Message> read_message(const std::filesystem::path& path) {
  const auto content = read_small_file(path);
  Message out;
  if (!content || !out.ParseFromString(*content)) return std::nullopt;
  return out;
}

}  // namespace cellcrush::slurm
