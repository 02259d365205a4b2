#include "http/envelope.h"

#include "error.h"

namespace cellcrush::http {
namespace {

constexpr std::size_t kPrefix = 5;

}  // namespace

void begin_envelope(std::uint8_t flags, std::size_t size, std::string& to) {
  to += static_cast<char>(flags);
  for (const unsigned shift : {24U, 16U, 8U, 0U}) to += static_cast<char>((size >> shift) & 0xFFU);
}

std::string envelope(std::uint8_t flags, std::string_view message) {
  std::string out;
  out.reserve(kPrefix + message.size());
  begin_envelope(flags, message.size(), out);
  return out.append(message);
}

std::string_view read_envelope(std::string_view body, bool& compressed) {
  std::size_t size = 0;
  for (std::size_t i = 1; i < kPrefix && i < body.size(); ++i) size = size << 8U | static_cast<unsigned char>(body[i]);
  if (body.size() < kPrefix || size != body.size() - kPrefix) {
    throw ServiceError(ServiceError::Kind::invalid,
                       "The body of a streaming call must be one envelope: a byte of flags, the length of the message "
                       "as four bytes (big endian), and the message.");
  }
  compressed = (static_cast<std::uint8_t>(body.front()) & kCompressed) != 0;
  return body.substr(kPrefix);
}

}  // namespace cellcrush::http
