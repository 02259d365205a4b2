#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "rpc/parse_error.h"
#include "rpc/source_stream.h"

namespace cellcrush::rpc {

/// The methods that return a stream, for callers that are not gRPC. Thread-safe once it is complete.
class StreamTable {
 public:
  /// `pump`: advances the streams; outlives the table and them.
  explicit StreamTable(watch::Pump& pump) : pump_(pump) {}

  struct Call {
    std::string path;     ///< "/cellcrush.v1.Jobs/WatchJob"
    std::string message;  ///< the request, binary
    std::string caller;   ///< who calls
    MessageStream::Encode encode;
  };

  /// `parts`: of the stream, except for its pump. `make`: opens the source for a request on a thread of the pump; what
  /// it throws ends the stream.
  template <class Source, class Request>
  void add(const std::string& path, const StreamParts& parts,
           std::function<std::unique_ptr<Source>(const Request& request)> make) {
    openers_[path] = [parts = StreamParts{pump_, parts.metrics, parts.limits, parts.times},
                      make = std::move(make)](Call call) -> std::shared_ptr<MessageStream> {
      auto request = std::make_shared<Request>();
      const bool is_sound = request->ParseFromString(call.message);
      auto out = std::make_shared<SourceStream<Source>>(parts, std::move(call.caller), std::move(call.encode),
                                                        [make, request] { return make(*request); });
      if (!is_sound) out->refuse(parse_error(call.path));
      return out;
    };
  }

  /// The stream of a call that may be made; null if there is no such method.
  [[nodiscard]] std::shared_ptr<MessageStream> open(Call call) const {
    const auto found = openers_.find(call.path);
    return found == openers_.end() ? nullptr : found->second(std::move(call));
  }

 private:
  watch::Pump& pump_;
  std::map<std::string, std::function<std::shared_ptr<MessageStream>(Call call)>> openers_;
};

}  // namespace cellcrush::rpc
