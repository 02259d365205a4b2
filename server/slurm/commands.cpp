#include "slurm/commands.h"

#include <absl/strings/numbers.h>
#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>

#include <algorithm>
#include <array>
#include <exception>
#include <map>
#include <sstream>
#include <utility>

namespace cellcrush::slurm {
namespace {

std::vector<std::string> split(const std::string& line, char between) { return absl::StrSplit(line, between); }

// Whether sbatch says that Slurm took nothing. Messages about the way to the controller leave that open.
bool is_refusal(const ProgramEnd& end) {
  if (!end.exit_code || *end.exit_code == 0) return false;
  // A connection that was never made carried nothing.
  if (end.errors.find("connect failure") != std::string::npos) return true;
  constexpr std::array kOpen = {"Unable to contact", "timed out",  "Socket",
                                "Connection",        "Zero Bytes", "Communication"};
  return std::none_of(kOpen.begin(), kOpen.end(),
                      [&end](const char* open) { return end.errors.find(open) != std::string::npos; });
}

template <typename Parse>
std::vector<TaskReport> parse_lines(const std::string& text, const Parse& parse) {
  std::vector<TaskReport> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (auto report = parse(line)) out.push_back(*std::move(report));
  }
  return out;
}

}  // namespace

ProgramEnd Commands::run(const char* command, std::vector<std::string> arguments) const {
  arguments.insert(arguments.begin(), folder_.empty() ? std::string(command) : (folder_ / command).string());
  try {
    return run_program(arguments, limit_, stop_.get_token());
  } catch (const std::exception& error) {
    ProgramEnd out;
    out.errors = error.what();
    return out;
  }
}

Submitted Commands::sbatch(const std::vector<std::string>& arguments) const {
  std::vector<std::string> all = {"--parsable"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const ProgramEnd end = run("sbatch", std::move(all));
  Submitted out;
  std::int64_t job = 0;
  // "17" or "17;CLUSTER".
  const std::string answer = in_one_line(end.output);
  if (end.is_good() && absl::SimpleAtoi(answer.substr(0, answer.find(';')), &job)) {
    out.job = job;
    return out;
  }
  out.is_refused = is_refusal(end);
  out.why = end.is_good() ? "sbatch answered '" + answer + "' instead of a job number." : what_failed("sbatch", end);
  return out;
}

std::optional<std::vector<TaskReport>> Commands::squeue(const std::string& prefix, std::string& why) const {
  // Array job, task, state, reason, nodes, name. Only the last may contain the separator.
  const ProgramEnd end = run("squeue", {"--noheader", "--array", "--states=all", "--user=" + std::to_string(getuid()),
                                        "--format=%F|%K|%T|%r|%N|%j"});
  if (!end.is_good()) {
    why = what_failed("squeue", end);
    return std::nullopt;
  }
  auto out = parse_lines(end.output, parse_squeue_line);
  std::erase_if(out, [&prefix](const TaskReport& report) { return report.name.rfind(prefix, 0) != 0; });
  return out;
}

std::optional<std::vector<TaskReport>> Commands::sacct(const std::vector<std::int64_t>& jobs) const {
  const ProgramEnd end = run("sacct", {"--noheader", "--parsable2", "--allocations",
                                       "--jobs=" + absl::StrJoin(jobs, ","), "--format=JobID,State,NodeList,JobName"});
  if (!end.is_good()) return std::nullopt;
  return parse_lines(end.output, parse_sacct_line);
}

bool Commands::scancel(std::int64_t job, int task) const {
  return run("scancel", {"--quiet", std::to_string(job) + (task < 0 ? "" : "_" + std::to_string(task))}).is_good();
}

std::optional<TaskReport> parse_squeue_line(const std::string& line) {
  const auto words = split(line, '|');
  TaskReport out;
  if (words.size() < 6 || !absl::SimpleAtoi(words[0], &out.job)) return std::nullopt;
  if (!absl::SimpleAtoi(words[1], &out.task)) out.task = -1;
  out.state = words[2];
  out.reason = words[3] == "None" ? "" : words[3];
  out.node = words[4];
  out.name = absl::StrJoin(words.begin() + 5, words.end(), "|");
  return out;
}

std::optional<TaskReport> parse_sacct_line(const std::string& line) {
  const auto words = split(line, '|');
  if (words.size() < 4) return std::nullopt;
  TaskReport out;
  const auto parts = split(words[0], '_');
  if (!absl::SimpleAtoi(parts.front(), &out.job)) return std::nullopt;
  if (parts.size() == 2 && !absl::SimpleAtoi(parts.back(), &out.task)) return std::nullopt;
  // "CANCELLED by 0".
  const auto space = words[1].find(' ');
  out.state = words[1].substr(0, space);
  if (space != std::string::npos) out.reason = words[1].substr(space + 1);
  out.node = words[2] == "None assigned" ? "" : words[2];
  out.name = words[3];
  return out;
}

Meaning meaning_of(const std::string& state) {
  static const std::map<std::string, Meaning> kKnown = {
      {"PENDING", Meaning::waits},           {"CONFIGURING", Meaning::waits},
      {"REQUEUED", Meaning::waits},          {"REQUEUE_HOLD", Meaning::waits},
      {"REQUEUE_FED", Meaning::waits},       {"RESV_DEL_HOLD", Meaning::waits},
      {"SPECIAL_EXIT", Meaning::waits},      {"RUNNING", Meaning::runs},
      {"SUSPENDED", Meaning::runs},          {"STOPPED", Meaning::runs},
      {"SIGNALING", Meaning::runs},          {"RESIZING", Meaning::runs},
      {"STAGE_OUT", Meaning::runs},          {"COMPLETING", Meaning::runs},
      {"COMPLETED", Meaning::ended},         {"FAILED", Meaning::ended},
      {"DEADLINE", Meaning::timed_out},      {"TIMEOUT", Meaning::timed_out},
      {"CANCELLED", Meaning::cancelled},     {"REVOKED", Meaning::cancelled},
      {"PREEMPTED", Meaning::displaced},     {"NODE_FAIL", Meaning::displaced},
      {"BOOT_FAIL", Meaning::displaced},     {"LAUNCH_FAILED", Meaning::displaced},
      {"RECONFIG_FAIL", Meaning::displaced}, {"OUT_OF_MEMORY", Meaning::no_memory},
  };
  const auto found = kKnown.find(state);
  return found == kKnown.end() ? Meaning::unknown : found->second;
}

}  // namespace cellcrush::slurm
