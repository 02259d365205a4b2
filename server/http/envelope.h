#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cellcrush::http {

// Messages of Connect streams: a byte of flags, the length as four bytes (big endian), the message.

inline constexpr std::uint8_t kCompressed = 1;
inline constexpr std::uint8_t kEndOfStream = 2;

/// A message with its prefix.
std::string envelope(std::uint8_t flags, std::string_view message);

/// Appends a message of `size` bytes, except for its bytes.
void begin_envelope(std::uint8_t flags, std::size_t size, std::string& to);

/// The only message in the body of a request. Throws ServiceError (invalid) if it is not exactly one.
/// Sets `compressed` if its flag says so.
std::string_view read_envelope(std::string_view body, bool& compressed);

}  // namespace cellcrush::http
