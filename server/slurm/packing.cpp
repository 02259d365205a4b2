#include "slurm/packing.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace cellcrush::slurm {
namespace {

constexpr std::int64_t kMebibyte = 1024 * 1024;
// For the program itself, its buffers and what the prediction misses.
constexpr double kMemoryFactor = 1.3;
constexpr std::int64_t kMemoryBeside = 200;
constexpr std::int64_t kMemoryStep = 128;
// Contacts and slower nodes.
constexpr double kTimeFactor = 3.0;
constexpr double kTimeBeside = 600.0;

}  // namespace

Need need_of(int threads, std::int64_t memory_bytes, double seconds) {
  const auto mib = static_cast<std::int64_t>(kMemoryFactor * static_cast<double>(memory_bytes) / kMebibyte);
  return {threads, (mib + kMemoryBeside + kMemoryStep - 1) / kMemoryStep * kMemoryStep, seconds};
}

std::vector<Pack> pack(const std::vector<Need>& attempts, std::chrono::duration<double> task_length,
                       std::size_t most_tasks) {
  std::map<std::pair<int, std::int64_t>, std::vector<std::size_t>> alike;
  for (std::size_t i = 0; i < attempts.size(); ++i) alike[{attempts[i].threads, attempts[i].memory_mib}].push_back(i);
  std::vector<Pack> out;
  for (const auto& [kind, members] : alike) {
    double filled = 0.0;  // of the last task
    bool begins_pack = true;
    for (const std::size_t i : members) {
      if (begins_pack || task_length.count() == 0 || filled + attempts[i].seconds > task_length.count()) {
        if (begins_pack || out.back().tasks.size() == most_tasks) out.push_back({{kind.first, kind.second, 0.0}, {}});
        begins_pack = false;
        out.back().tasks.emplace_back();
        filled = 0.0;
      }
      filled += attempts[i].seconds;
      out.back().tasks.back().push_back(i);
      out.back().need.seconds = std::max(out.back().need.seconds, filled);
    }
  }
  return out;
}

std::int64_t time_limit_minutes(double seconds, std::chrono::seconds longest) {
  double wanted = kTimeFactor * seconds + kTimeBeside;
  if (longest.count() > 0) wanted = std::min(wanted, static_cast<double>(longest.count()));
  return std::max<std::int64_t>(1, std::llround(std::ceil(wanted / 60.0)));
}

}  // namespace cellcrush::slurm
