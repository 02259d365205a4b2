#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "mutex.h"

namespace cellcrush::access {

/// Checks that a certificate was issued for clients. TLS refuses a certificate whose extended key usage excludes
/// clients, but accepts one without that extension, as a server's may be. Caches the last answers, since every call
/// asks. Thread-safe.
class ClientCertificates {
 public:
  /// Whether the first certificate of the PEM text has clientAuth in its extended key usage.
  [[nodiscard]] bool has_client_use(std::string_view pem);

 private:
  Mutex mutex_;
  std::map<std::string, bool, std::less<>> known_ CELLCRUSH_GUARDED_BY(mutex_);  ///< keyed by PEM
};

}  // namespace cellcrush::access
