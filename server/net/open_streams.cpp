#include "net/open_streams.h"

#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <grpc/grpc.h>
#include <grpc/support/alloc.h>

#include <cstdint>
#include <cstdlib>

namespace cellcrush::net {
namespace {

using google::protobuf::Struct;

// Owns and reads an answer of channelz.
Struct read_json(char* text) {
  Struct out;
  if (text == nullptr) return out;
  (void)google::protobuf::util::JsonStringToMessage(text, &out);
  gpr_free(text);
  return out;
}

const Struct& part_of(const Struct& whole, const char* name) {
  const auto found = whole.fields().find(name);
  return found == whole.fields().end() ? Struct::default_instance() : found->second.struct_value();
}

std::string text_of(const Struct& whole, const char* name) {
  const auto found = whole.fields().find(name);
  return found == whole.fields().end() ? "" : found->second.string_value();
}

// Numbers of 64 bits are strings in JSON.
std::int64_t number_of(const Struct& whole, const char* name) { return std::atoll(text_of(whole, name).c_str()); }

// Calls `take` with each entry of a list that comes in pages; `page` returns the one from an id on.
template <class Page, class Take>
void for_each_entry(const Page& page, const char* list, const char* id, const Take& take) {
  for (std::int64_t first = 0;;) {
    const Struct answer = read_json(page(first));
    const auto found = answer.fields().find(list);
    if (found == answer.fields().end()) return;
    for (const auto& entry : found->second.list_value().values()) {
      const Struct& each = entry.struct_value();
      first = number_of(each.fields().contains("ref") ? part_of(each, "ref") : each, id);
      take(first++);
    }
    if (answer.fields().contains("end")) return;
  }
}

}  // namespace

std::map<std::string, std::size_t> count_open_streams() {
  std::map<std::string, std::size_t> out;
  const auto count = [&out](std::int64_t id) {
    const Struct socket = part_of(read_json(grpc_channelz_get_socket(id)), "socket");
    const Struct& data = part_of(socket, "data");
    const std::string name = text_of(part_of(socket, "ref"), "name");  // "chttp2 ipv4:127.0.0.1:40312"
    const auto open = number_of(data, "streamsStarted") - number_of(data, "streamsSucceeded") -
                      number_of(data, "streamsFailed");
    if (open > 0) out[name.substr(name.find(' ') + 1)] += static_cast<std::size_t>(open);
  };
  for_each_entry(&grpc_channelz_get_servers, "server", "serverId", [&](std::int64_t server) {
    for_each_entry([server](std::int64_t first) { return grpc_channelz_get_server_sockets(server, first, 0); },
                   "socketRef", "socketId", count);
  });
  return out;
}

}  // namespace cellcrush::net
