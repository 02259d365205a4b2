#pragma once

#include <google/protobuf/message.h>

#include <boost/beast/http.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace cellcrush::http {

/// A file that a GET of its path makes from the answers of one method, called once or page by page. Not thread-safe.
class Download {
 public:
  virtual ~Download() = default;

  std::string method;        ///< "/cellcrush.v1.Jobs/GetHistory"
  std::string content_type;  ///< of the file
  std::string file_name;     ///< under which a browser saves it

  /// Of a file whose size its first answer brings, and which can be sent from a byte on.
  bool has_ranges = false;
  std::int64_t first = 0;            ///< byte to begin at
  std::optional<std::int64_t> size;  ///< of the whole file

  /// Follows a Range header "bytes=N-", by which clients continue a download; any other is ignored.
  void begin_at(std::string_view range);

  /// Fills the request of the next call.
  virtual void ask(google::protobuf::Message& request) const = 0;
  /// Appends the part of the file that the answer brings.
  virtual void write(const google::protobuf::Message& answer, std::string& to) = 0;
  /// Whether another call must follow.
  [[nodiscard]] virtual bool has_more() const { return false; }
};

/// The headers of a file whose first answer is there.
void describe(const Download& file, boost::beast::http::response_header<>& to);

/// The file of the path "/jobs/7/history.csv", "/jobs/7/result.h5" or "/sweeps/3.csv", perhaps with "?decimal=comma";
/// null for another path. Throws ServiceError (invalid) for other parameters.
std::shared_ptr<Download> open_download(std::string_view target);

/// Whether a download may have this path; its parameters may be wrong.
bool is_download(std::string_view target);

}  // namespace cellcrush::http
