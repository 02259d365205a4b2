#include "watch/sent_message.h"

#include <google/protobuf/io/coded_stream.h>

#include <array>
#include <cstdint>

namespace cellcrush::watch {

void SentMessage::append_to(std::string& to) const {
  to += before;
  if (shared) to += *shared;
  to += after;
}

SentMessage nest(std::string fields, int field, SentMessage message) {
  constexpr unsigned kBytes = 2;  // the type of a field on the wire
  std::array<std::uint8_t, 10> head{};
  using Stream = google::protobuf::io::CodedOutputStream;
  std::uint8_t* end = Stream::WriteTagToArray(static_cast<unsigned>(field) << 3U | kBytes, head.data());
  end = Stream::WriteVarint32ToArray(static_cast<unsigned>(message.size()), end);
  fields.append(head.data(), end);
  message.before.insert(0, fields);
  return message;
}

}  // namespace cellcrush::watch
