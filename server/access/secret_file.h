#pragma once

#include <filesystem>
#include <string>

namespace cellcrush::access {

/// Who may access a file beside its owner, and its group for reading.
enum class Secrecy { open, secret };

/// Contents of a file that an option names, at most 1 MiB. Throws ServiceError (invalid), starting with the option and
/// the file, if it is unreadable or not a regular file. For a secret file it also throws if others can read it, or if
/// the group or others can write it.
std::string read_named_file(const std::string& option, const std::filesystem::path& path, Secrecy secrecy);

/// Throws this error.
[[noreturn]] void refuse_file(const std::string& option, const std::filesystem::path& path, const std::string& why);

}  // namespace cellcrush::access
