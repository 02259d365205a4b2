#pragma once

#include <filesystem>

namespace cellcrush::store {

// A result begins with a block that HDF5 leaves alone (its user block) and readers skip. It holds
// "CELLCRUSH RESULT 1 CRC-32 SIZE\n", of all bytes behind it, and zeros. HDF5 1.10 trusts what it reads and may crash
// over a damaged file; so no file is given to it before its bytes are known to be those that were written.

/// Size of the block.
inline constexpr int kSealBytes = 512;

/// Writes the seal of a file that HDF5 has closed. Throws ServiceError: storage_full or internal.
void seal_result(const std::filesystem::path& path);

enum class Seal {
  whole,    ///< that of the bytes behind it
  missing,  ///< an earlier version wrote the file without one
  broken,   ///< of other bytes
};

/// Reads the file and holds it to its seal. One that was found whole is not read again as long as it is not written to.
/// Throws ServiceError: internal when it cannot be read or is no regular file. Thread-safe.
Seal read_seal(const std::filesystem::path& path);

/// Throws ServiceError: failed_precondition when an earlier version wrote the file without one, data_loss unless the
/// seal is that of the bytes behind it, internal when they cannot be read. A file that was found whole is not read
/// again as long as it is not written to. Thread-safe.
void check_seal(const std::filesystem::path& path);

/// The same for whoever needs the bytes alone: a file without a seal passes.
void check_seal_if_any(const std::filesystem::path& path);

}  // namespace cellcrush::store
