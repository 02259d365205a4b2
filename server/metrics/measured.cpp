#include "metrics/measured.h"

#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>

#include "audit_log.h"
#include "log_writer.h"

namespace cellcrush::metrics {
namespace {

// Numbers of fields in /proc/self/stat, from the one after the name of the program, which may have spaces (proc(5)).
struct Stat {
  double user_ticks = 0.0;     // field 14
  double system_ticks = 0.0;   // 15
  double threads = 0.0;        // 20
  double start_ticks = 0.0;    // 22, since the machine started
  double virtual_bytes = 0.0;  // 23
  double pages = 0.0;          // 24
};

bool read_stat(Stat& out) {
  std::ifstream file("/proc/self/stat");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto end_of_name = text.rfind(')');
  if (end_of_name == std::string::npos) return false;
  std::istringstream fields(text.substr(end_of_name + 1));
  std::string state;
  fields >> state;
  constexpr int kFirst = 4;
  constexpr int kLast = 24;
  for (int field = kFirst; field <= kLast; ++field) {
    double value = 0.0;
    if (!(fields >> value)) return false;
    switch (field) {
      case 14: out.user_ticks = value; break;
      case 15: out.system_ticks = value; break;
      case 20: out.threads = value; break;
      case 22: out.start_ticks = value; break;
      case 23: out.virtual_bytes = value; break;
      case 24: out.pages = value; break;
      default: break;
    }
  }
  return true;
}

// Wall-clock second at which the machine started; 0 if unknown.
double boot_time() {
  std::ifstream file("/proc/stat");
  std::string word;
  double seconds = 0.0;
  while (file >> word) {
    if (word == "btime" && file >> seconds) return seconds;
  }
  return 0.0;
}

// Counts the descriptor with which it counts, too.
double count_descriptors() {
  double out = 0.0;
  std::error_code error;
  for (auto entry = std::filesystem::directory_iterator("/proc/self/fd", error);
       !error && entry != std::filesystem::directory_iterator(); entry.increment(error))
    ++out;
  return out;
}

prometheus::MetricFamily family(const char* name, const char* help, prometheus::MetricType type) {
  return {.name = name, .help = help, .type = type, .metric = std::vector<prometheus::ClientMetric>(1)};
}

prometheus::MetricFamily gauge_family(const char* name, const char* help, double value) {
  auto out = family(name, help, prometheus::MetricType::Gauge);
  out.metric[0].gauge.value = value;
  return out;
}

prometheus::MetricFamily counter_family(const char* name, const char* help, double value) {
  auto out = family(name, help, prometheus::MetricType::Counter);
  out.metric[0].counter.value = value;
  return out;
}

// The metrics of this process that all Prometheus clients have. Leaves out what /proc does not tell.
std::vector<prometheus::MetricFamily> process_families() {
  std::vector<prometheus::MetricFamily> out;
  if (Stat stat; read_stat(stat)) {
    const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
    out.push_back(counter_family("process_cpu_seconds_total", "Processor time of the daemon, without its workers.",
                                 (stat.user_ticks + stat.system_ticks) / ticks));
    out.push_back(gauge_family("process_resident_memory_bytes", "Resident memory of the daemon.",
                               stat.pages * static_cast<double>(sysconf(_SC_PAGESIZE))));
    out.push_back(gauge_family("process_virtual_memory_bytes", "Virtual memory of the daemon.", stat.virtual_bytes));
    out.push_back(gauge_family("process_threads", "Threads of the daemon.", stat.threads));
    // The time of the boot follows the wall clock. What asks for restarts looks for another value.
    static const double boot = boot_time();
    if (boot > 0.0)
      out.push_back(gauge_family("process_start_time_seconds", "Start of the daemon, in seconds since 1970, UTC.",
                                 boot + stat.start_ticks / ticks));
  }
  if (const double open = count_descriptors(); open > 0.0)
    out.push_back(gauge_family("process_open_fds", "Open file descriptors of the daemon.", open));
  if (rlimit limit{}; getrlimit(RLIMIT_NOFILE, &limit) == 0)
    out.push_back(gauge_family("process_max_fds", "File descriptors that the daemon may open.",
                               static_cast<double>(limit.rlim_cur)));
  return out;
}

// With this many series an owner is a person; whoever makes up tokens makes no more.
constexpr std::size_t kMostOwners = 200;

/// A family of gauges with one label.
template <class Map, class Value>
prometheus::MetricFamily labelled(const char* name, const char* help, const char* label, const Map& map,
                                  const Value& value) {
  prometheus::MetricFamily out = gauge_family(name, help, 0.0);
  out.metric.clear();
  for (const auto& [key, entry] : map) {
    if (out.metric.size() == kMostOwners) break;
    auto& metric = out.metric.emplace_back();
    metric.label = {{label, key}};
    metric.gauge.value = static_cast<double>(value(entry));
  }
  return out;
}

std::vector<prometheus::MetricFamily> families_of(const Standing& now) {
  using Owner = Standing::Owner;
  std::vector<prometheus::MetricFamily> out = {
      gauge_family("cellcrush_queue_age_seconds",
                   "Time for which the first waiting job has waited in this daemon; 0 without one.", now.queue_age_s),
      gauge_family("cellcrush_disk_free_bytes", "Free space on the disk of the data folder.",
                   static_cast<double>(now.free_disk_bytes)),
      gauge_family("cellcrush_disk_kept_bytes", "Free space below which no job starts.",
                   static_cast<double>(now.kept_disk_bytes)),
      labelled("cellcrush_owner_jobs_waiting", "Waiting jobs of an owner.", "owner", now.owners,
               [](const Owner& owner) { return owner.waiting; }),
      labelled("cellcrush_owner_jobs_running", "Running jobs of an owner.", "owner", now.owners,
               [](const Owner& owner) { return owner.running; }),
      labelled("cellcrush_owner_disk_bytes", "Journal rows, and results of ended jobs, of an owner.", "owner",
               now.owners, [](const Owner& owner) { return owner.bytes; }),
      labelled("cellcrush_notices_behind", "Changes that a receiver of notices has not seen yet.", "target", now.behind,
               [](std::int64_t changes) { return changes; }),
  };
  std::erase_if(out, [](const auto& family) { return family.metric.empty(); });
  return out;
}

}  // namespace

void Measured::ask(std::function<Standing()> standing) {
  const MutexLock lock(mutex_);
  standing_ = std::move(standing);
}

std::vector<prometheus::MetricFamily> Measured::Collect() const {
  auto out = process_families();
  out.push_back(counter_family("cellcrush_log_lines_lost_total",
                               "Lines of the log that came faster than it was read, or were not written.",
                               static_cast<double>(LogWriter::lost_lines())));
  out.push_back(counter_family("cellcrush_audit_lines_lost_total", "Lines of the audit log that were not written.",
                               static_cast<double>(AuditLog::lost_lines())));
  const MutexLock lock(mutex_);
  if (!standing_) return out;
  try {
    auto more = families_of(standing_());
    std::ranges::move(more, std::back_inserter(out));
  } catch (const std::exception& error) {
    spdlog::warn("A scrape lacks the queue, the disk and the owners: {}", error.what());
  }
  return out;
}

}  // namespace cellcrush::metrics
