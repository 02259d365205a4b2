#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace cellcrush::load {

/// What some watchers of a job received, all together.
struct Received {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;  ///< with the headers of HTTP
  std::int64_t samples = 0;
  std::int64_t frames = 0;
  std::int64_t skipped_frames = 0;
  std::int64_t wrong_numbers = 0;  ///< states and samples that did not follow the one before
  int failed = 0;                  ///< watchers whose watch ended otherwise than with the job
};

/// How the watchers ask.
struct HttpWatch {
  int port = 0;     ///< of 127.0.0.1
  std::string job;  ///< "jobs/{job}"
  int watchers = 0;
  enum class Form { packed, numbers, json } form = Form::packed;  ///< of the frames; JSON has numbers
};

/// Watches the job and its frames over HTTP by WatchJobs, each watcher on a connection of its own. One thread serves
/// them all; it returns once the job has ended for each. Of JSON it counts messages and bytes only.
Received watch_over_http(const HttpWatch& watch);

}  // namespace cellcrush::load
