#include "rpc/request_weight.h"

#include <fmt/format.h>
#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <map>
#include <string>

#include "error.h"

namespace cellcrush::rpc {
namespace {

namespace protobuf = google::protobuf;
using protobuf::Descriptor;
using protobuf::FieldDescriptor;
using protobuf::internal::WireFormatLite;

constexpr int kDeepest = 100;  // as in protobuf
// A parsed string or unknown field, a pointer to it, and what the heap adds.
constexpr std::int64_t kOfAString = 64;
constexpr std::int64_t kOfAMessage = 24;  // a pointer to it, and what the heap adds
constexpr std::int64_t kOfAScalar = 8;

/// Adds up the parts of one message. Not thread-safe.
class Scale {
 public:
  explicit Scale(std::string_view bytes)
      : size_(bytes.size()), in_(reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<int>(bytes.size())) {}

  /// False if the bytes are not a message.
  bool add(const Descriptor& type, const std::string& path) {
    if (++depth_ > kDeepest) return false;
    const FieldDescriptor* field = nullptr;
    std::string name;  // of the field
    int count = 0;     // of its values
    while (const auto tag = in_.ReadTag()) {
      const int number = WireFormatLite::GetTagFieldNumber(tag);
      if (field == nullptr || field->number() != number) {
        field = type.FindFieldByNumber(number);
        name = field == nullptr ? path : path.empty() ? field->name() : path + "." + field->name();
        count = 0;
      }
      if (!add_value(tag, field, name)) return false;
      ++count;
      if (weight_ <= kHeaviestRequest) continue;
      throw InvalidField(
          name.empty() ? "request" : name,
          fmt::format("takes too much memory: {} of its values in the {} bytes of the request exceed {} MiB.", count,
                      size_, kHeaviestRequest >> 20),
          "Send fewer values, or split the request.");
    }
    --depth_;
    return in_.ConsumedEntireMessage() || in_.BytesUntilLimit() == 0;
  }

 private:
  bool add_value(std::uint32_t tag, const FieldDescriptor* field, const std::string& name) {
    if (WireFormatLite::GetTagWireType(tag) != WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      weight_ += field == nullptr ? kOfAString : kOfAScalar;
      return WireFormatLite::SkipField(&in_, tag);
    }
    int size = 0;
    if (!in_.ReadVarintSizeAsInt(&size)) return false;
    if (field == nullptr || field->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
      weight_ += kOfAString + size;
      return in_.Skip(size);
    }
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      weight_ += kOfAScalar * size;  // packed, at least a byte each
      return in_.Skip(size);
    }
    weight_ += size_of(*field->message_type());
    const auto limit = in_.PushLimit(size);
    const bool is_well_formed = add(*field->message_type(), name);
    in_.PopLimit(limit);
    return is_well_formed;
  }

  std::int64_t size_of(const Descriptor& type) {
    auto& out = sizes_[&type];
    if (out == 0) {
      const auto* prototype = protobuf::MessageFactory::generated_factory()->GetPrototype(&type);
      out = kOfAMessage + static_cast<std::int64_t>(prototype->SpaceUsedLong());
    }
    return out;
  }

  std::size_t size_;
  protobuf::io::CodedInputStream in_;
  std::int64_t weight_ = 0;
  int depth_ = 0;
  std::map<const Descriptor*, std::int64_t> sizes_;  ///< of an empty message in memory
};

}  // namespace

std::int64_t heaviest_request_of(std::size_t bytes) {
  constexpr std::int64_t kMostGrowth = 50;
  return std::min(kHeaviestRequest, kMostGrowth * static_cast<std::int64_t>(bytes));
}

bool parse_within_limits(std::string_view bytes, protobuf::Message& message) {
  const bool is_light = static_cast<std::int64_t>(bytes.size()) <= kLightRequest;
  return (is_light || Scale(bytes).add(*message.GetDescriptor(), "")) &&
         message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()));
}

}  // namespace cellcrush::rpc
