#include "log_writer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spdlog/details/os.h>
#include <spdlog/pattern_formatter.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <csignal>
#include <deque>
#include <string>
#include <thread>
#include <utility>

#include "mutex.h"
#include "open_file.h"
#include "store/durable_file.h"

namespace cellcrush {
namespace {

constexpr std::size_t kMostBytes = 1024 * 1024;
constexpr std::size_t kMostAtOnce = 64 * 1024;       // bytes
constexpr std::chrono::milliseconds kGathering{30};  // lines that come meanwhile are written together
constexpr const char* kPlain = "\033[m";
constexpr const char* kName = "cellcrushd";

std::atomic<std::int64_t> lost_lines_of_process = 0;

std::shared_ptr<OpenFile> open_log(const std::filesystem::path& path) {
  constexpr int kFlags = O_WRONLY | O_APPEND | O_CREAT | O_NONBLOCK | O_NOCTTY;
  return std::make_shared<OpenFile>(store::open_file(path, kFlags, "opened"));
}

const char* color_of(spdlog::level::level_enum level) {
  switch (level) {
    case spdlog::level::info: return "\033[32m";
    case spdlog::level::warn: return "\033[33m\033[1m";
    case spdlog::level::err: return "\033[31m\033[1m";
    case spdlog::level::critical: return "\033[1m\033[41m";
    default: return "";
  }
}

}  // namespace

bool write_text(int file, std::string_view text) {
  while (!text.empty()) {
    const auto count = write(file, text.data(), text.size());
    if (count >= 0) {
      text.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {  // a pipe, or a stderr that another process has set so
      pollfd ready{.fd = file, .events = POLLOUT, .revents = 0};
      poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

struct LogWriter::State {
  Mutex mutex;
  std::condition_variable_any changed;
  std::deque<std::string> lines CELLCRUSH_GUARDED_BY(mutex);  ///< the first ones are being written
  std::size_t bytes CELLCRUSH_GUARDED_BY(mutex) = 0;
  std::int64_t lost CELLCRUSH_GUARDED_BY(mutex) = 0;  ///< not yet said in the log
  bool stopped CELLCRUSH_GUARDED_BY(mutex) = false;
  std::shared_ptr<OpenFile> file CELLCRUSH_GUARDED_BY(mutex);           ///< none: stderr
  std::unique_ptr<spdlog::formatter> form CELLCRUSH_GUARDED_BY(mutex);  ///< of the line that says what was lost
  bool is_colored = false;

  void lose() CELLCRUSH_REQUIRES(mutex) {
    ++lost;
    ++lost_lines_of_process;
  }

  void add(std::string line) {
    const MutexLock lock(mutex);
    if (stopped || bytes + line.size() > kMostBytes) return lose();
    bytes += line.size();
    lines.push_back(std::move(line));
    changed.notify_all();
  }

  void write_lines() {
    MutexLock lock(mutex);
    while (true) {
      while (lines.empty() && !stopped) changed.wait(lock);
      if (lines.empty()) return;
      if (!stopped) {
        lock.unlock();
        std::this_thread::sleep_for(kGathering);
        lock.lock();
      }
      const auto to = file;
      std::string text;
      std::size_t count = 0;
      for (; count < lines.size() && text.size() < kMostAtOnce; ++count) text += lines[count];
      lock.unlock();
      const bool written = write_text(to ? to->get() : STDERR_FILENO, text);
      lock.lock();
      for (; count > 0; --count) {
        if (!written) lose();
        bytes -= lines.front().size();
        lines.pop_front();
      }
      changed.notify_all();
      if (lost > 0 && lines.empty() && written) say_lost();
    }
  }

  void say_lost() CELLCRUSH_REQUIRES(mutex) {
    const std::string words =
        fmt::format("{} lines of the log are lost: they came faster than the log was read, or could not be written",
                    std::exchange(lost, 0));
    spdlog::memory_buf_t line;
    form->format({kName, spdlog::level::warn, words}, line);
    lines.emplace_back(line.data(), line.size());
    bytes += lines.back().size();
  }
};

LogWriter::LogWriter(const std::filesystem::path& path) : path_(path), state_(std::make_shared<State>()) {
  if (path_.empty()) {
    state_->is_colored = spdlog::details::os::in_terminal(stderr) && spdlog::details::os::is_color_terminal();
  } else {
    state_->file = open_log(path_);
  }
  set_formatter(std::make_unique<spdlog::pattern_formatter>());
  // Signals are for the threads of the program.
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread([state = state_] { state->write_lines(); }).detach();
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

LogWriter::~LogWriter() { stop(); }

void LogWriter::reopen() {
  if (path_.empty()) return;
  auto file = open_log(path_);
  const MutexLock lock(state_->mutex);
  state_->file = std::move(file);
}

void LogWriter::stop(std::chrono::milliseconds limit) {
  const auto until = std::chrono::steady_clock::now() + limit;
  MutexLock lock(state_->mutex);
  state_->stopped = true;
  state_->changed.notify_all();
  while (!state_->lines.empty() && state_->changed.wait_until(lock, until) == std::cv_status::no_timeout) {
  }
}

std::int64_t LogWriter::lost_lines() { return lost_lines_of_process; }

void LogWriter::set_formatter_(std::unique_ptr<spdlog::formatter> form) {
  {
    const MutexLock lock(state_->mutex);
    state_->form = form->clone();
  }
  base_sink::set_formatter_(std::move(form));
}

void LogWriter::sink_it_(const spdlog::details::log_msg& message) {
  spdlog::memory_buf_t line;
  formatter_->format(message, line);
  std::string text(line.data(), line.size());
  if (state_->is_colored && message.color_range_end > message.color_range_start) {
    text.insert(message.color_range_end, kPlain);
    text.insert(message.color_range_start, color_of(message.level));
  }
  state_->add(std::move(text));
}

}  // namespace cellcrush
