#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "mutex.h"

namespace cellcrush::testing {

/// An HTTP server on a free port of 127.0.0.1 that keeps what is posted to it. One request at a time.
class HttpReceiver {
 public:
  struct Request {
    std::string path;
    std::map<std::string, std::string> headers;  ///< by name, in lower case
    std::string body;
  };
  /// The code of the answer; 0: none, the connection is closed.
  using Answer = std::function<int(const Request&)>;

  explicit HttpReceiver(Answer answer = [](const Request&) { return 200; });
  ~HttpReceiver();
  HttpReceiver(const HttpReceiver&) = delete;
  HttpReceiver& operator=(const HttpReceiver&) = delete;

  /// "http://127.0.0.1:PORT" and the path.
  [[nodiscard]] std::string url(const std::string& path = "/") const;
  [[nodiscard]] std::vector<Request> requests();
  /// Those that there are once there are so many, or after 30 s.
  std::vector<Request> wait_for(std::size_t count);

 private:
  void serve();

  Answer answer_;
  int listener_ = -1;
  int port_ = 0;
  Mutex mutex_;
  std::vector<Request> requests_ CELLCRUSH_GUARDED_BY(mutex_);
  std::thread thread_;
};

}  // namespace cellcrush::testing
