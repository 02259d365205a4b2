#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "mutex.h"

namespace cellcrush::access {

/// Which certificates their authority has issued for clients. TLS itself refuses those that are for something else
/// only; one without an extended key usage, as a server's may be, passes it. Remembers the last ones, since each call
/// asks. Thread-safe.
class ClientCertificates {
 public:
  /// Whether the first certificate of the text, in PEM, has clientAuth in its extended key usage.
  [[nodiscard]] bool has_client_use(std::string_view pem);

 private:
  Mutex mutex_;
  std::map<std::string, bool, std::less<>> known_ CELLCRUSH_GUARDED_BY(mutex_);  ///< by PEM
};

}  // namespace cellcrush::access
