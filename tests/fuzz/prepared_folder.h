#pragma once

#include <filesystem>
#include <string>

namespace cellcrush::fuzz {

/// Writes a data folder in which there is something of everything that a call can name:
///   jobs/1  PENDING
///   jobs/2  SUCCEEDED, with a history and a result
///   jobs/3  FAILED
///   sweeps/1 of jobs/4 FAILED, jobs/5 CANCELLED and jobs/6 SUSPENDED
/// No job runs: without workers it would for ever.
void prepare_folder(const std::filesystem::path& folder);

/// A small but whole result: 3 particles, 2 elements, 5 samples and 3 frames.
void write_result(const std::filesystem::path& path);

/// Replaces a file by these bytes.
void write_file(const std::filesystem::path& path, const std::string& bytes);

}  // namespace cellcrush::fuzz
