#include "rpc/stream_reactor.h"

#include <grpc/slice.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace cellcrush::rpc {
namespace {

constexpr std::size_t kWorthSharing = 4096;  // smaller ones are copied sooner than counted

grpc::Slice slice_of(const watch::SharedBytes& shared) {
  const auto release = [](void* held) { delete static_cast<watch::SharedBytes*>(held); };
  return {const_cast<char*>(shared->data()), shared->size(), release, new watch::SharedBytes(shared)};
}

}  // namespace

grpc::ByteBuffer wire_of(const watch::SentMessage& message) {
  if (message.shared && message.shared->size() >= kWorthSharing) {
    const std::array slices = {grpc::Slice(message.before), slice_of(message.shared), grpc::Slice(message.after)};
    return {slices.data(), slices.size()};
  }
  grpc_slice raw = grpc_slice_malloc(message.size());
  std::uint8_t* to = GRPC_SLICE_START_PTR(raw);
  const auto put = [&to](const std::string& bytes) { to = std::ranges::copy(bytes, to).out; };
  put(message.before);
  if (message.shared) put(*message.shared);
  put(message.after);
  const grpc::Slice whole(raw, grpc::Slice::STEAL_REF);
  return {&whole, 1};
}

grpc::ByteBuffer wire_of(const google::protobuf::Message& message) {
  grpc_slice raw = grpc_slice_malloc(message.ByteSizeLong());
  message.SerializeWithCachedSizesToArray(GRPC_SLICE_START_PTR(raw));
  const grpc::Slice whole(raw, grpc::Slice::STEAL_REF);
  return {&whole, 1};
}

}  // namespace cellcrush::rpc
