#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "access/token_file.h"
#include "mutex.h"

namespace cellcrush::access {

/// Browsers that callers have let in: a code, valid once and for minutes, becomes a session for a day. Holds hashes
/// only, of at most 100 codes and sessions each of a caller; a further one takes the place of the oldest. Thread-safe.
class Sessions {
 public:
  using Clock = std::chrono::system_clock;
  static constexpr std::chrono::minutes kCodeLasts{5};
  static constexpr std::chrono::hours kSessionLasts{24};

  explicit Sessions(std::function<Clock::time_point()> now = Clock::now) : now_(std::move(now)) {}

  /// Where the web page is served: "http://HOST:PORT". Links begin with it.
  void serve_at(const std::string& url);

  struct Link {
    std::string url;  ///< with a code
    Clock::time_point end;
  };
  /// A link for a browser of the caller, to "", "jobs/N" or "sweeps/N". Throws ServiceError: failed_precondition if no
  /// web page is served, internal if no random bytes are available.
  Link make_link(const Caller& caller, const std::string& page);

  /// The session that the code gives; nothing if it was used, is too old or is unknown. `user`: the Unix user of the
  /// browser's connection, as far as the kernel says.
  std::optional<std::string> redeem(const std::string& code, std::optional<uid_t> user);

  /// The caller of a session that has not ended, on a connection of the user to whom it was given: a browser sends its
  /// cookies to every port of a machine, also to those of other users.
  std::optional<Caller> find(const std::string& session, std::optional<uid_t> user);

  void end_all();

 private:
  struct Entry {
    Caller caller;
    Clock::time_point end;
    std::optional<uid_t> user = std::nullopt;  ///< of a session
  };
  using Entries = std::map<std::string, Entry>;  ///< by SHA-256

  static std::string add(Entries& entries, Entry entry);
  Entries::iterator find_live(Entries& entries, const std::string& word) CELLCRUSH_REQUIRES(mutex_);

  std::function<Clock::time_point()> now_;
  Mutex mutex_;
  std::string url_ CELLCRUSH_GUARDED_BY(mutex_);
  Entries codes_ CELLCRUSH_GUARDED_BY(mutex_);
  Entries sessions_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::access
