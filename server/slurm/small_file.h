#pragma once

#include <google/protobuf/message_lite.h>

#include <cstdint>
#include <filesystem>
#include <limits>
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

/// Copies a file of at most `most` bytes durably under its final name. Throws ServiceError.
void copy_durably(const std::filesystem::path& from, const std::filesystem::path& to,
                  std::uint64_t most = std::numeric_limits<std::uint64_t>::max());

/// Size limit of a small file, and that of an order, which holds a case.
inline constexpr std::uint64_t kSmall = std::uint64_t{1} << 20;
inline constexpr std::uint64_t kOrder = std::uint64_t{64} << 20;

/// Nothing if the file is absent. A link, a FIFO and a file of more than `most` bytes are treated as absent. Throws
/// ServiceError if it cannot be read for another reason.
std::optional<std::string> read_small_file(const std::filesystem::path& path, std::uint64_t most = kSmall);

/// A message in such a file. A file that is not this message is treated as absent.
template <typename Message>
std::optional<Message> read_message(const std::filesystem::path& path, std::uint64_t most = kSmall) {
  const auto content = read_small_file(path, most);
  Message out;
  if (!content || !out.ParseFromString(*content)) return std::nullopt;
  return out;
}

}  // namespace cellcrush::slurm
