#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

namespace cellcrush::store {

// A result starts with a block that HDF5 ignores (its user block). It holds "CELLCRUSH RESULT 1 CRC-32 SIZE
// " of all following bytes, padded with zeros. HDF5 1.10 trusts its input and may crash on a damaged file. Therefore it
// receives a file only after its bytes are known to be unchanged.

/// Size of the block.
inline constexpr int kSealBytes = 512;

/// Writes the seal of a file that HDF5 has closed. Throws ServiceError: storage_full or internal.
void seal_result(const std::filesystem::path& path);

enum class Seal {
  whole,    ///< matches the bytes that follow
  missing,  ///< written without one by an earlier version
  broken,   ///< does not match
};

/// Device, inode, size and time of change. Changes whenever the file does, unless two changes fall within one tick of
/// the file system's clock.
using FileIdentity = std::array<std::int64_t, 5>;

/// Reads the file and compares it with its seal. A file found whole is not read again until it is written to: `whole`
/// becomes its identity, once the last write is so old that another one would change it. Throws ServiceError: internal
/// if it cannot be read or is not a regular file. Thread-safe.
Seal read_seal(const std::filesystem::path& path, std::optional<FileIdentity>* whole = nullptr);

/// Returns that identity. Throws ServiceError: failed_precondition for a file without a seal, written by an earlier
/// version; data_loss unless the seal matches the bytes that follow; internal if they cannot be read. Thread-safe.
std::optional<FileIdentity> check_seal(const std::filesystem::path& path);

/// The same for callers that need the bytes only: a file without a seal passes.
void check_seal_if_any(const std::filesystem::path& path);

}  // namespace cellcrush::store
