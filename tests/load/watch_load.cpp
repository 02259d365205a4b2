// Measures what pages (HTTP) and watchers (gRPC) of one crush cost the daemon, on this machine. Prints a figure a line;
// asserts nothing.
// usage: watch_load [PAGES [WATCHERS [ROUNDS [packed|numbers|json]]]]
#include <fmt/core.h>
#include <grpcpp/grpcpp.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "cellcrush/v1/jobs_service.pb.h"
#include "http/connect_protocol.h"
#include "load/figures.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/http/http_socket.h"

namespace cellcrush::load {
namespace {

using testing::Client;

/// What some watchers of a job received, all together.
struct Received {
  std::int64_t messages = 0;
  std::int64_t bytes = 0;  ///< with the headers of HTTP
  std::int64_t samples = 0;
  std::int64_t frames = 0;
  std::int64_t skipped_frames = 0;
  std::int64_t wrong_numbers = 0;  ///< states and samples that did not follow the one before
  int failed = 0;                  ///< watchers whose watch ended otherwise than with the job

  void add(const Received& other) {
    messages += other.messages;
    bytes += other.bytes;
    samples += other.samples;
    frames += other.frames;
    skipped_frames += other.skipped_frames;
    wrong_numbers += other.wrong_numbers;
    failed += other.failed;
  }

  // `sequence`: of the watcher's last state or sample.
  void count(const v1::JobEvent& event, std::int64_t& sequence) {
    samples += event.has_sample();
    if (event.has_frame() && event.frame().part() == 0) {
      ++frames;
      skipped_frames += event.frame().skipped();
    }
    if (event.has_sample() || event.has_state()) wrong_numbers += event.sequence() != ++sequence;
  }

  void print(const char* who, double watchers) const {
    if (watchers == 0.0) return;
    fmt::print("  each {} {:.1f} messages, {:.0f} kB, {:.1f} samples, {:.1f} frames, {:.1f} frames skipped\n", who,
               static_cast<double>(messages) / watchers, 1e-3 * static_cast<double>(bytes) / watchers,
               static_cast<double>(samples) / watchers, static_cast<double>(frames) / watchers,
               static_cast<double>(skipped_frames) / watchers);
    if (failed > 0 || wrong_numbers > 0)
      fmt::print("  {} watches failed, {} events out of order\n", failed, wrong_numbers);
  }
};

/// How the watchers ask.
struct HttpWatch {
  int port = 0;     ///< of 127.0.0.1
  std::string job;  ///< "jobs/{job}"
  int watchers = 0;
  enum class Form { packed, numbers, json } form = Form::packed;  ///< of the frames; JSON has numbers
};

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

// Reads the answer to one streaming call of the Connect protocol over HTTP/1.1, piece by piece as it comes.
class StreamParser {
 public:
  // `on_message` gets each message in order, without its prefix, but not the last envelope.
  explicit StreamParser(std::function<void(std::string_view message)> on_message)
      : on_message_(std::move(on_message)) {}

  void add(std::string_view bytes) {
    while (!bytes.empty()) {
      if (chunk_left_ > 0) {
        const auto piece = bytes.substr(0, chunk_left_);
        chunk_left_ -= piece.size();
        bytes.remove_prefix(piece.size());
        add_body(piece);
        continue;
      }
      line_ += bytes.front();
      bytes.remove_prefix(1);
      if (!line_.ends_with(in_body_ ? "\r\n" : "\r\n\r\n")) continue;
      if (in_body_ && line_.size() > 2) chunk_left_ = std::stoul(line_, nullptr, 16);
      in_body_ = true;
      line_.clear();
    }
  }

  // Whether the last envelope came.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  void add_body(std::string_view bytes) {
    constexpr std::size_t kPrefix = 5;
    body_ += bytes;
    std::size_t at = 0;
    while (body_.size() - at >= kPrefix) {
      std::size_t size = 0;
      for (std::size_t i = 1; i < kPrefix; ++i) size = size << 8U | static_cast<unsigned char>(body_[at + i]);
      if (body_.size() - at < kPrefix + size) break;
      if (body_[at] == static_cast<char>(http::kEndOfStream)) {
        ended_ = true;
      } else {
        on_message_(std::string_view(body_).substr(at + kPrefix, size));
      }
      at += kPrefix + size;
    }
    body_.erase(0, at);
  }

  std::function<void(std::string_view)> on_message_;
  std::string line_;            // headers, or the size of a chunk, so far
  bool in_body_ = false;        // the headers are complete
  std::size_t chunk_left_ = 0;  // bytes of the chunk that follow
  std::string body_;            // without a complete envelope
  bool ended_ = false;
};

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
    if (parser_.ended()) end(false);
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
    received_.count(message_.watched().event(), sequence_);
  }

  const bool is_json_;
  Received& received_;
  testing::HttpSocket socket_;
  StreamParser parser_;
  v1::WatchJobsResponse message_;
  std::int64_t sequence_ = 0;
  bool ended_ = false;
};

// Watches the job and its frames by WatchJob until it has ended, on a connection of its own.
void watch_over_grpc(const std::string& address, const std::string& job, Received& received) {
  grpc::ChannelArguments own;
  own.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  const Client client(address, own);
  auto request = testing::named<v1::WatchJobRequest>(job);
  request.set_frames(true);
  const auto context = testing::bounded_context(std::chrono::minutes(4));
  const auto reader = client.jobs->WatchJob(context.get(), request);
  std::int64_t sequence = 0;
  v1::JobEvent event;
  while (reader->Read(&event)) {
    ++received.messages;
    received.bytes += static_cast<std::int64_t>(event.ByteSizeLong());
    received.count(event, sequence);
  }
  received.failed += !reader->Finish().ok();
}

// Watches the job and its frames over HTTP by WatchJobs, each watcher on a connection of its own. One thread serves
// them all; it returns once the job has ended for each. Of JSON it counts messages and bytes only.
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

// A crush of Type I by default, at a speed that takes seconds.
v1::Case crush(Client& client) {
  v1::Case out = client.preset("type-i");
  out.mutable_loading()->set_speed_m_per_s(100.0);
  return out;
}

int free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  bind(socket, reinterpret_cast<const sockaddr*>(&address), size);
  getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  close(socket);
  return ntohs(address.sin_port);
}

// Processor time of the daemon from before the first watcher to the end of the job, s.
double measure_crush(const std::string& address, int daemon, HttpWatch pages, int watchers) {
  Client client(address);
  const double before = processor_time_of(daemon);
  const auto start = std::chrono::steady_clock::now();
  pages.job = client.create(crush(client));
  std::vector<Received> of_watchers(static_cast<std::size_t>(watchers));
  std::vector<std::jthread> threads;
  threads.reserve(of_watchers.size());
  for (auto& received : of_watchers)
    threads.emplace_back([&address, &pages, &received] { watch_over_grpc(address, pages.job, received); });
  const Received of_pages = watch_over_http(pages);
  threads.clear();
  client.wait_for_state(pages.job, v1::Job::SUCCEEDED);
  const double used = processor_time_of(daemon) - before;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  fmt::print("{} pages, {} watchers: {:.2f} s of the daemon, {:.2f} s of the solver, {:.1f} s on the clock\n",
             pages.watchers, watchers, used, client.get(pages.job).summary().solver_seconds(), taken.count());
  of_pages.print("page", pages.watchers);
  Received sum;
  for (const auto& each : of_watchers) sum.add(each);
  sum.print("watcher", watchers);
  fmt::print("  the daemon's memory: {:.0f} MiB\n", memory_of(daemon));
  return used;
}

int measure(const std::filesystem::path& folder, HttpWatch pages, int watchers, int rounds) {
  const std::string address = "unix:" + (folder / "socket").string();
  pages.port = free_port();
  testing::DaemonProcess daemon({"--data", (folder / "data").string(), "--listen", address, "--http",
                                 "127.0.0.1:" + std::to_string(pages.port), "--workers", "1"});
  if (daemon.wait_for_addresses(1).empty()) {
    fmt::print("the daemon does not start\n");
    return 1;
  }
  std::vector<double> used;
  for (int i = 0; i < rounds; ++i) used.push_back(measure_crush(address, daemon.number(), pages, watchers));
  std::sort(used.begin(), used.end());
  double load = 0.0;
  static_cast<void>(getloadavg(&load, 1));
  fmt::print("the daemon's processor time, as a row of tests/load/figures.csv:\n");
  const char* form = pages.form == HttpWatch::Form::packed    ? "packed"
                     : pages.form == HttpWatch::Form::numbers ? "numbers"
                                                              : "json";
  fmt::print("watchers,s,{:.2f},{:.2f},{:.2f},watch_load {} {} {} {},{:.0f}\n", used[used.size() / 2], used.front(),
             used.back(), pages.watchers, watchers, rounds, form, load);
  return 0;
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  using cellcrush::load::HttpWatch;
  HttpWatch pages;
  pages.watchers = count > 1 ? std::atoi(words[1]) : 200;
  const int watchers = count > 2 ? std::atoi(words[2]) : 200;
  const int rounds = count > 3 ? std::max(1, std::atoi(words[3])) : 3;
  const std::string form = count > 4 ? words[4] : "packed";
  if (form == "numbers") pages.form = HttpWatch::Form::numbers;
  if (form == "json") pages.form = HttpWatch::Form::json;
  const cellcrush::testing::TemporaryFolder folder;
  const int result = cellcrush::load::measure(folder.path(), pages, watchers, rounds);
  cellcrush::testing::kill_workers(folder.path() / "data");
  return result;
}
