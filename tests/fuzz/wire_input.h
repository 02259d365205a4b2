#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace cellcrush::fuzz {

/// A call that a client may make.
struct Method {
  const google::protobuf::MethodDescriptor* descriptor;

  /// "/cellcrush.v1.Jobs/GetJob".
  [[nodiscard]] std::string path() const;
  [[nodiscard]] bool is_watch() const { return descriptor->name().starts_with("Watch"); }
  [[nodiscard]] std::unique_ptr<google::protobuf::Message> new_request() const;
  [[nodiscard]] std::unique_ptr<google::protobuf::Message> new_response() const;
};

/// All calls of all services, as the protos have them.
const std::vector<Method>& methods();

/// One call: a method's position in methods(), and the bytes that are its message or none.
struct WireCall {
  std::size_t method = 0;
  std::string bytes;
};

/// An input of the fuzzer: calls one after another, each as a byte for the method, two for the length (the most
/// significant first) and the message. Any bytes are an input.
std::vector<WireCall> parse_calls(const std::uint8_t* data, std::size_t size);
std::string bytes_of(const std::vector<WireCall>& calls);

/// A sound call of a method drawn by chance, of what prepare_folder has left.
WireCall draw_call(std::mt19937& random);

/// Changes one field somewhere in the message: sets, clears, adds, removes or repeats it. Strings stay ASCII, since
/// what is no UTF-8 is refused before the daemon sees it. What bytes alone may do to a message is left to libFuzzer.
void mutate(google::protobuf::Message& message, std::mt19937& random);

}  // namespace cellcrush::fuzz
