// Measures what watchers over HTTP cost the daemon, on this machine. Prints a figure a line; asserts nothing.
// usage: watch_load [WATCHERS [ROUNDS [packed|numbers|json]]]
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include "load/figures.h"
#include "load/http_watchers.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"

namespace cellcrush::load {
namespace {

using testing::Client;

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
double measure_crush(Client& client, int daemon, HttpWatch watch) {
  const double before = processor_time_of(daemon);
  const auto start = std::chrono::steady_clock::now();
  watch.job = client.create(crush(client));
  const Received got = watch_over_http(watch);
  client.wait_for_state(watch.job, v1::Job::SUCCEEDED);
  const double used = processor_time_of(daemon) - before;
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  const double watchers = std::max(1, watch.watchers);
  fmt::print("{} watchers: {:.2f} s of the daemon, {:.2f} s of the solver, {:.1f} s on the clock\n", watch.watchers,
             used, client.get(watch.job).summary().solver_seconds(), taken.count());
  fmt::print("  each {:.1f} messages, {:.0f} kB, {:.1f} samples, {:.1f} frames, {:.1f} frames skipped\n",
             static_cast<double>(got.messages) / watchers, 1e-3 * static_cast<double>(got.bytes) / watchers,
             static_cast<double>(got.samples) / watchers, static_cast<double>(got.frames) / watchers,
             static_cast<double>(got.skipped_frames) / watchers);
  if (got.failed > 0 || got.wrong_numbers > 0)
    fmt::print("  {} watches failed, {} events out of order\n", got.failed, got.wrong_numbers);
  fmt::print("  the daemon's memory: {:.0f} MiB\n", memory_of(daemon));
  return used;
}

int measure(const std::filesystem::path& folder, HttpWatch watch, int rounds) {
  const std::string address = "unix:" + (folder / "socket").string();
  watch.port = free_port();
  testing::DaemonProcess daemon({"--data", (folder / "data").string(), "--listen", address, "--http",
                                 "127.0.0.1:" + std::to_string(watch.port), "--workers", "1"});
  if (daemon.wait_for_addresses(1).empty()) {
    fmt::print("the daemon does not start\n");
    return 1;
  }
  Client client(address);
  std::vector<double> used;
  for (int i = 0; i < rounds; ++i) used.push_back(measure_crush(client, daemon.number(), watch));
  std::sort(used.begin(), used.end());
  fmt::print("{} watchers: median {:.2f} s of the daemon's processor time ({:.2f} to {:.2f})\n", watch.watchers,
             used[used.size() / 2], used.front(), used.back());
  return 0;
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  using cellcrush::load::HttpWatch;
  HttpWatch watch;
  watch.watchers = count > 1 ? std::atoi(words[1]) : 200;
  const int rounds = count > 2 ? std::max(1, std::atoi(words[2])) : 3;
  const std::string form = count > 3 ? words[3] : "packed";
  if (form == "numbers") watch.form = HttpWatch::Form::numbers;
  if (form == "json") watch.form = HttpWatch::Form::json;
  const cellcrush::testing::TemporaryFolder folder;
  const int result = cellcrush::load::measure(folder.path(), watch, rounds);
  cellcrush::testing::kill_workers(folder.path() / "data");
  return result;
}
