#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cellcrush::notices {

/// Something that happened, as receivers are told.
struct Notice {
  std::string id;        ///< the same if it is told again
  std::string type;      ///< of kTypes
  std::string resource;  ///< "jobs/3", "sweeps/2"; the executor of a queue
  std::string body;      ///< JSON: {"type", "timestamp", "data"}
  std::int64_t job = 0;  ///< that has ended; 0: none
};

/// What receivers are told; monitor.md says when.
inline constexpr std::array kTypes = {"job.succeeded", "job.failed", "job.cancelled",
                                      "sweep.ended",   "queue.held", "queue.released"};

/// Whom to tell, as the daemon's options say.
struct Options {
  std::vector<std::string> webhooks;               ///< URLs
  std::filesystem::path webhook_secret;            ///< file of the key that signs what they get
  std::filesystem::path command;                   ///< program that is run for each notice; empty: none
  std::vector<std::string> types;                  ///< of kTypes, for webhooks and the command; empty: all
  std::string traces;                              ///< URL that takes OTLP over HTTP; empty: none
  std::chrono::milliseconds pause{1'000};          ///< before a notice is sent again; doubles up to five minutes
  std::chrono::milliseconds longest{86'400'000};   ///< that one is sent again
  std::chrono::milliseconds answer_limit{20'000};  ///< of a receiver
};

/// Throws ServiceError (invalid), naming the option, for a URL, secret or program that cannot be used.
void check(const Options& options);

}  // namespace cellcrush::notices
