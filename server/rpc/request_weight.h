#pragma once

#include <google/protobuf/message.h>

#include <cstdint>
#include <string_view>

namespace cellcrush::rpc {

/// Most bytes of memory that a request may take once it is parsed: an empty message of two bytes takes fifty times as
/// much.
inline constexpr std::int64_t kHeaviestRequest = 32 << 20;

/// Bytes of a request that cannot be that heavy: an empty message takes two, and less than 1 kB when parsed.
inline constexpr std::int64_t kLightRequest = 32 << 10;

/// Upper bound of the memory that a request takes while it is parsed and answered, by its bytes alone.
std::int64_t heaviest_request_of(std::size_t bytes);

/// Parses a message. Adds up first what its parts will take in memory, without making them. False if the bytes cannot
/// be parsed. Throws InvalidField, naming the field, if it would be heavier than kHeaviestRequest.
bool parse_within_limits(std::string_view bytes, google::protobuf::Message& message);

}  // namespace cellcrush::rpc
