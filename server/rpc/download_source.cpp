#include "rpc/download_source.h"

#include "error.h"
#include "store/result_seal.h"

namespace cellcrush::rpc {
namespace {

// Memory held by an unread download.
constexpr std::size_t kDownloadChunk = 128 * 1024;

}  // namespace

DownloadSource::DownloadSource(const std::filesystem::path& path, std::int64_t offset)
    : path_(path), file_(path), offset_(offset) {
  if (offset < 0) throw InvalidField("offset", "is negative.", "Use 0 for the whole file.");
  if (offset > file_.size()) {
    throw ServiceError(ServiceError::Kind::out_of_range, "offset is " + std::to_string(offset) + ", but the file has " +
                                                             std::to_string(file_.size()) + " bytes.");
  }
}

std::optional<DownloadSource::Message> DownloadSource::next() {
  if (ended()) return std::nullopt;
  if (!sent_) store::check_seal_if_any(path_);
  Message out;
  out.set_offset(offset_);
  out.set_total_size(file_.size());
  out.set_data(file_.read(offset_, kDownloadChunk));
  offset_ += static_cast<std::int64_t>(out.data().size());
  sent_ = true;
  return out;
}

}  // namespace cellcrush::rpc
