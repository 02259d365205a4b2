#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <string_view>

namespace cellcrush::web {

/// The pieces of an exported page: one HTML file with the bundle of the web page inline and, as data, messages of the
/// daemon, from which the page answers its own calls. head, blocks, then end; the file grows as it is sent. The content
/// policy in the head permits the bundle's script and style by their hashes, and no request.

/// The head, with the bundle. `title` is text.
std::string exported_head(std::string_view title);

/// Whether a block is compressed. Packed frames are already.
enum class Compression { none, zlib };

/// A message as the answer of `call`, such as "GetJob", in base64. Several blocks of a call are the messages of its
/// stream, or its pages. Throws std::bad_alloc.
std::string exported_block(std::string_view call, const google::protobuf::Message& message, Compression compression);

std::string_view exported_end();

}  // namespace cellcrush::web
