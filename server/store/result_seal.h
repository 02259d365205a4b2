#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

namespace cellcrush::store {

// A result ends with 64 bytes behind HDF5's end of file, which readers leave alone: "CELLCRUSH RESULT 2 CRC-32 SIZE"
// and a line feed, of all bytes before, padded with zeros. Versions before put the seal in a user block of 512 bytes at
// the start, as "CELLCRUSH RESULT 1 ..." of the bytes behind it; such files are read too. HDF5 1.10 trusts its input
// and may crash on a damaged file. Therefore it receives a file only after its bytes are known to be unchanged.

/// A mark in the superblock that such an end must follow, so that a file cut short is not one without a seal: half the
/// entries of a leaf of a group (H5Pset_sym_k); HDF5's own choice is 4.
inline constexpr unsigned kSealedLeaf = 5;

/// Seals a file that HDF5 has closed, or seals it again. Throws ServiceError: storage_full or internal.
void seal_result(const std::filesystem::path& path);

enum class Seal {
  whole,    ///< matches the bytes
  missing,  ///< written without one by an earlier version
  broken,   ///< does not match
};

/// Device, inode, size and time of change. Changes whenever the file does, unless two changes fall within one tick of
/// the file system's clock.
using FileIdentity = std::array<std::int64_t, 5>;

/// Reads the file and compares it with its seal. A file found whole is not read again until it is written to: `whole`
/// becomes its identity, once the last write is so old that another one would change it. `go_on`, if given: called now
/// and then meanwhile; what it throws ends the reading. Throws ServiceError: internal if it cannot be read or is not a
/// regular file. Thread-safe.
Seal read_seal(const std::filesystem::path& path, std::optional<FileIdentity>* whole = nullptr,
               const std::function<void()>& go_on = {});

/// Returns that identity. Throws ServiceError: failed_precondition for a file without a seal, written by an earlier
/// version; data_loss unless the seal matches the bytes; internal if they cannot be read. Thread-safe.
std::optional<FileIdentity> check_seal(const std::filesystem::path& path);

/// The same for callers that need the bytes only: a file without a seal passes. `go_on` as above.
void check_seal_if_any(const std::filesystem::path& path, const std::function<void()>& go_on);

}  // namespace cellcrush::store
