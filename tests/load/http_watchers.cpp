#include "load/http_watchers.h"

#include <poll.h>
#include <sys/socket.h>

#include <memory>
#include <vector>

#include "cellcrush/v1/jobs_service.pb.h"
#include "http/connect_protocol.h"
#include "load/stream_parser.h"
#include "server/http/http_socket.h"

namespace cellcrush::load {
namespace {

std::string request_text(const HttpWatch& watch) {
  v1::WatchJobsRequest request;
  auto& job = *request.add_jobs();
  job.set_name(watch.job);
  job.set_frames(true);
  if (watch.form == HttpWatch::Form::packed) job.set_encoding(v1::FieldFrame::PACKED);
  const bool json = watch.form == HttpWatch::Form::json;
  const std::string body = http::envelope(
      0, json ? R"({"jobs":[{"name":")" + watch.job + R"(","frames":true}]})" : request.SerializeAsString());
  return "POST /cellcrush.v1.Jobs/WatchJobs HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(watch.port) +
         "\r\nContent-Type: application/connect+" + (json ? "json" : "proto") +
         "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

class Watcher {
 public:
  Watcher(const HttpWatch& watch, Received& received)
      : is_json_(watch.form == HttpWatch::Form::json),
        received_(received),
        socket_(watch.port),
        parser_([this](std::string_view message) { count(message); }) {
    socket_.send(request_text(watch));
  }

  [[nodiscard]] int descriptor() const { return socket_.number(); }
  [[nodiscard]] bool ended() const { return ended_; }

  // Takes what has come.
  void read(std::vector<char>& room) {
    const auto count = recv(socket_.number(), room.data(), room.size(), 0);
    if (count <= 0) return end(false);
    received_.bytes += count;
    parser_.add({room.data(), static_cast<std::size_t>(count)});
    if (!parser_.end().empty()) end(false);
  }

 private:
  void end(bool with_the_job) {
    if (!ended_ && !with_the_job) ++received_.failed;
    ended_ = true;
  }

  void count(std::string_view bytes) {
    ++received_.messages;
    if (is_json_) {
      if (bytes.find("\"watchedEnd\"") != std::string_view::npos) end(true);
      return;
    }
    if (!message_.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return end(false);
    if (message_.has_watched_end()) return end(message_.watched_end().status().code() == 0);
    if (!message_.has_watched()) return;
    const auto& event = message_.watched().event();
    received_.samples += event.has_sample();
    if (event.has_frame()) {
      received_.frames += event.frame().part() == 0;
      received_.skipped_frames += event.frame().part() == 0 ? event.frame().skipped() : 0;
    }
    if (event.has_sample() || event.has_state()) received_.wrong_numbers += event.sequence() != ++sequence_;
  }

  const bool is_json_;
  Received& received_;
  testing::HttpSocket socket_;
  StreamParser parser_;
  v1::WatchJobsResponse message_;
  std::int64_t sequence_ = 0;
  bool ended_ = false;
};

}  // namespace

Received watch_over_http(const HttpWatch& watch) {
  Received out;
  std::vector<std::unique_ptr<Watcher>> watchers;
  for (int i = 0; i < watch.watchers; ++i) watchers.push_back(std::make_unique<Watcher>(watch, out));
  std::vector<char> room(256 * 1024);
  while (!watchers.empty()) {
    std::vector<pollfd> waiting;
    waiting.reserve(watchers.size());
    for (const auto& each : watchers) waiting.push_back({each->descriptor(), POLLIN, 0});
    poll(waiting.data(), waiting.size(), -1);
    for (std::size_t i = 0; i < waiting.size(); ++i)
      if (waiting[i].revents != 0) watchers[i]->read(room);
    std::erase_if(watchers, [](const auto& each) { return each->ended(); });
  }
  return out;
}

}  // namespace cellcrush::load
