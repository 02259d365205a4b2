#pragma once

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "notices/notice.h"
#include "store/journal_reader.h"

namespace cellcrush::notices {

/// Who is told. A receiver is called by one thread.
class Receiver {
 public:
  /// What became of a notice.
  enum class Result {
    taken,
    failed,   ///< to be sent again
    refused,  ///< by a receiver that would refuse it again
  };

  virtual ~Receiver() = default;
  /// Returns within the limit of its options, or soon after a stop is requested. `why`: set unless it was taken, a
  /// sentence. Does not throw.
  virtual Result send(const Notice& notice, const std::stop_token& stop, std::string& why) = 0;
  /// In the log and the metrics: without what a URL may hold beside the host.
  [[nodiscard]] virtual std::string name() const = 0;
  /// By which the journal knows it.
  [[nodiscard]] virtual std::string key() const = 0;
  /// Whether it is told of this type.
  [[nodiscard]] virtual bool wants(const std::string& type) const = 0;
};

/// The receivers that the options name. `reader` outlives them. Throws what check(options) throws.
std::vector<std::unique_ptr<Receiver>> make_receivers(const Options& options, const std::string& epoch,
                                                      store::JournalReader& reader);

/// Posts JSON with curl, with these headers. Returns as Receiver::send.
Receiver::Result post(const std::string& url, const std::vector<std::string>& headers, const std::string& body,
                      std::chrono::milliseconds limit, const std::stop_token& stop, std::string& why);

/// Host and port of a URL.
std::string host_of(const std::string& url);

/// "webhook-signature" of Standard Webhooks: "v1," and in base64 the HMAC-SHA256 of "ID.TIMESTAMP.BODY". `key`: bytes.
std::string signature_of(const std::string& key, const std::string& id, const std::string& timestamp,
                         const std::string& body);

/// The key in the text of a secret: "whsec_" and base64. Empty if it is not one of 24 to 64 bytes.
std::string key_of(const std::string& secret);

/// Spans of a job's life in the JSON of OTLP: the job as a whole, and below it each time that it waited, ran or was
/// suspended, by its states in order. `epoch` and the job's name determine the ids.
std::string spans_of(const std::vector<v1::Job>& states, const std::string& epoch);

}  // namespace cellcrush::notices
