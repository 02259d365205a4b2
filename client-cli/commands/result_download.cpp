#include "commands/result_download.h"

#include <fmt/format.h>
#include <zlib.h>

#include <chrono>
#include <thread>
#include <utility>

namespace cellcrush::client {
namespace {

class ResultDownload {
 public:
  ResultDownload(Connection& connection, const std::string& name, OutputFile& file)
      : connection_(connection), file_(file) {
    request_.set_name(name);
    file_.read_back([this](std::string_view part) { add(part); });
    has_earlier_part_ = request_.offset() > 0;
  }

  void run() {
    for (std::size_t attempt = 0;; ++attempt) {
      const std::int64_t before = request_.offset();
      const grpc::Status status = receive();
      if (status.ok() && total_ > 0 && request_.offset() == total_) return;
      // What an earlier command has left may be of another file.
      const bool is_foreign =
          status.error_code() == grpc::StatusCode::OUT_OF_RANGE || status.error_code() == grpc::StatusCode::DATA_LOSS;
      if (is_foreign && std::exchange(has_earlier_part_, false)) {
        restart();
        continue;
      }
      const ExitCode code = status.ok() ? ExitCode::cut_off : exit_code_of(status.error_code());
      if (code == ExitCode::refused || code == ExitCode::not_found ||
          status.error_code() == grpc::StatusCode::DATA_LOSS) {
        restart();
        throw error_of(status);
      }
      if (request_.offset() > before) attempt = 0;
      if (attempt == kPauses.size()) give_up(status.ok() ? "the stream ended early" : status.error_message());
      std::this_thread::sleep_for(kPauses[attempt]);
    }
  }

 private:
  void add(std::string_view bytes) {
    crc_ = crc32_z(crc_, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    request_.set_offset(request_.offset() + static_cast<std::int64_t>(bytes.size()));
  }

  void restart() {
    file_.restart();
    request_.set_offset(0);
    crc_ = 0;
  }

  // Appends chunks to the file. Those before a chunk with another sum are not whole.
  grpc::Status receive() {
    bool is_whole = true;
    const auto take = [&](const v1::DownloadResultResponse& chunk) {
      is_whole = is_whole && chunk.offset() == request_.offset();
      if (!is_whole) return false;
      file_.write(chunk.data());
      add(chunk.data());
      total_ = chunk.total_size();
      is_whole = !chunk.has_crc32() || chunk.crc32() == crc_;
      return is_whole;
    };
    const v1::DownloadResultRequest from = request_;
    grpc::Status status =
        connection_.read(connection_.jobs(), &v1::Jobs::Stub::DownloadResult, from, std::chrono::minutes(10), take);
    if (is_whole) return status;
    return {grpc::StatusCode::DATA_LOSS,
            fmt::format("result.h5 was damaged on its way, before byte {}; fetch it again", request_.offset())};
  }

  [[noreturn]] void give_up(const std::string& reason) {
    throw CommandError(ExitCode::cut_off,
                       fmt::format("the download of result.h5 broke off at byte {} of {}: {}; the same command "
                                   "continues it there",
                                   request_.offset(), total_, reason));
  }

  Connection& connection_;
  OutputFile& file_;
  v1::DownloadResultRequest request_;
  std::int64_t total_ = 0;
  std::uint64_t crc_ = 0;
  bool has_earlier_part_ = false;
};

}  // namespace

void download_result(Connection& connection, const std::string& name, OutputFile& file) {
  ResultDownload(connection, name, file).run();
}

}  // namespace cellcrush::client
