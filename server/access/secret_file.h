#pragma once

#include <filesystem>
#include <string>

namespace cellcrush::access {

/// Whom a file may be open to, beside its owner and, for reading, its group.
enum class Secrecy { open, secret };

/// All of a file that an option names, at most 1 MiB. Throws ServiceError (invalid), which begins with the option and
/// the file, when it cannot be read or is no file; when it is secret, also when others can read it, or the group or
/// others can write it.
std::string read_named_file(const std::string& option, const std::filesystem::path& path, Secrecy secrecy);

/// Throws that error.
[[noreturn]] void refuse_file(const std::string& option, const std::filesystem::path& path, const std::string& why);

}  // namespace cellcrush::access
