#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace cellcrush::net {

/// The streams of HTTP/2 that are open on each connection of this process's gRPC servers, by gRPC's name of the
/// connection; those without a name of their own count together. Asks gRPC's channelz, which the servers have switched
/// on: a millisecond for ten connections.
std::map<std::string, std::size_t> count_open_streams();

}  // namespace cellcrush::net
