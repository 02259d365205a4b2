#include "slurm/cluster_options.h"

#include <absl/strings/ascii.h>
#include <absl/strings/numbers.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>

#include "error.h"
#include "slurm/attempt_folder.h"
#include "slurm/slurm_executor.h"

namespace cellcrush::slurm {
namespace {

constexpr std::size_t kLongestName = 40;

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

std::filesystem::path absolute_path(const std::string& key, const std::string& value) {
  if (value.empty() || value.front() != '/')
    refuse(key + " is '" + value + "'; it must be an absolute path, which begins with /.");
  return value;
}

int whole_number(const std::string& key, const std::string& value, int least, int most) {
  int out = 0;
  if (!absl::SimpleAtoi(value, &out) || out < least || out > most)
    refuse(key + " is '" + value + "'; it must be a whole number from " + std::to_string(least) + " to " +
           std::to_string(most) + ".");
  return out;
}

void check_name(const std::string& name) {
  const auto is_good = [](unsigned char c) { return absl::ascii_isalnum(c) || c == '-' || c == '_'; };
  if (name.empty() || name.size() > kLongestName || !std::all_of(name.begin(), name.end(), is_good))
    refuse("the cluster's name is '" + name +
           "'; it must be 1 to 40 letters, digits, - or _, followed by a colon: NAME:folder=PATH.");
}

using Setter = std::function<void(ClusterOptions&, const std::string& key, const std::string& value)>;

const std::map<std::string, Setter>& setters() {
  static const std::map<std::string, Setter> kSetters = {
      {"folder", [](auto& to, const auto& key, const auto& value) { to.folder = absolute_path(key, value); }},
      {"program", [](auto& to, const auto& key, const auto& value) { to.program = absolute_path(key, value); }},
      {"commands", [](auto& to, const auto& key, const auto& value) { to.commands = absolute_path(key, value); }},
      {"simd", [](auto& to, const auto&, const auto& value) { to.simd = value; }},
      {"sbatch",
       [](auto& to, const auto& key, const auto& value) {
         for (const char* own :
              {"--array", "--clusters", "--job-name", "--output", "--test-only", "--wait", "--wrap"}) {
           if (value.rfind(own, 0) == 0)
             refuse(fmt::format("{} is '{}'; the daemon itself decides about {}.", key, value, own));
         }
         if (value.rfind("--", 0) != 0)
           refuse(key + " is '" + value + "'; it must be a long option of sbatch, such as --partition=short.");
         to.sbatch.push_back(value);
       }},
      {"jobs", [](auto& to, const auto& key, const auto& value) { to.jobs = whole_number(key, value, 1, 1024); }},
      {"tasks", [](auto& to, const auto& key, const auto& value) { to.tasks = whole_number(key, value, 1, 1024); }},
      {"task-length",
       [](auto& to, const auto& key, const auto& value) {
         to.task_length = std::chrono::seconds(whole_number(key, value, 0, 86400));
       }},
      {"longest",
       [](auto& to, const auto& key, const auto& value) {
         to.longest = std::chrono::seconds(whole_number(key, value, 60, 100'000'000));
       }},
  };
  return kSetters;
}

}  // namespace

ClusterOptions parse_cluster(const std::string& text) {
  ClusterOptions out;
  const auto colon = text.find(':');
  out.name = text.substr(0, colon);
  check_name(out.name);
  const std::string rest = colon == std::string::npos ? "" : text.substr(colon + 1);
  const std::vector<std::string> settings = absl::StrSplit(rest, ',', absl::SkipEmpty());
  for (const std::string& setting : settings) {
    const auto equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const auto setter = setters().find(key);
    if (setter == setters().end() || equals == std::string::npos) {
      const auto name_of = [](std::string* to, const auto& each) { *to += each.first; };
      refuse("'" + setting + "' is not a setting of a cluster; write KEY=VALUE with one of " +
             absl::StrJoin(setters(), ", ", name_of) + ".");
    }
    setter->second(out, key, setting.substr(equals + 1));
  }
  if (out.folder.empty()) refuse("give folder=PATH, a folder that the daemon and all nodes share.");
  return out;
}

jobs::ExecutorOptions executor_of(const ClusterOptions& options) {
  return {"slurm/" + options.name, options.jobs, [options](const jobs::ExecutorSurroundings& around) {
            ClusterOptions own = options;
            // Not the link itself, which names another program on a node.
            if (own.program.empty()) own.program = std::filesystem::read_symlink("/proc/self/exe");
            prepare_shared_folder(own, around.data_folder);
            return std::make_unique<SlurmExecutor>(
                own, around.step_cost, std::make_unique<jobs::LocalProcess>(around.worker_program, around.stall_limit));
          }};
}

}  // namespace cellcrush::slurm
