#include "slurm/attempt_exit.h"

#include <algorithm>
#include <array>
#include <utility>

#include "slurm/cluster_view.h"

namespace cellcrush::slurm {
namespace {

using ExitKind = jobs::WorkerExit::Kind;

constexpr std::array<std::pair<Ended::Kind, ExitKind>, 8> kKinds = {{{Ended::NOT_STARTED, ExitKind::not_started},
                                                                     {Ended::EXITED, ExitKind::exited},
                                                                     {Ended::SIGNALLED, ExitKind::signalled},
                                                                     {Ended::BROKEN, ExitKind::broken},
                                                                     {Ended::STALLED, ExitKind::stalled},
                                                                     {Ended::SUSPENDED, ExitKind::suspended},
                                                                     {Ended::CANCELLED, ExitKind::cancelled},
                                                                     {Ended::LEFT, ExitKind::stopped}}};

ExitKind kind_of(Ended::Kind kind) {
  const auto* found = std::ranges::find(kKinds, kind, &std::pair<Ended::Kind, ExitKind>::first);
  return found == kKinds.end() ? ExitKind::gone : found->second;
}

}  // namespace

Ended::Kind ended_kind(ExitKind kind) {
  const auto* found = std::ranges::find(kKinds, kind, &std::pair<Ended::Kind, ExitKind>::second);
  return found == kKinds.end() ? Ended::EXITED : found->first;
}

std::string slurm_name(const Attempt& attempt) {
  if (attempt.slurm_job() == 0) return "Slurm job " + (kJobPrefix + attempt.batch());
  return "Slurm job " + std::to_string(attempt.slurm_job()) +
         (attempt.is_array() ? "_" + std::to_string(attempt.task()) : "");
}

jobs::WorkerExit exit_by_meaning(Meaning meaning, const std::optional<worker::Final>& final, const std::string& what) {
  jobs::WorkerExit out{.kind = ExitKind::gone, .final = final, .detail = what};
  if (meaning == Meaning::cancelled) out.kind = ExitKind::withdrawn;
  if (meaning == Meaning::displaced) out.kind = ExitKind::displaced;
  out.out_of_memory = out.at_own_limit = meaning == Meaning::no_memory;
  return out;
}

bool ends_job(const Ended& ended) { return ended.has_final() && !ended.final().has_suspended_step(); }

jobs::WorkerExit exit_of_last_word(const Ended& ended, const Attempt& attempt, const std::string& host) {
  jobs::WorkerExit out{.kind = kind_of(ended.kind()), .code = ended.code(), .out_of_memory = ended.out_of_memory()};
  if (ended.has_final()) out.final = ended.final();
  const std::string where = host.empty() ? "" : " on " + host;
  out.at_own_limit = out.out_of_memory;
  if (out.out_of_memory) out.detail = slurm_name(attempt) + where + ": " + ended.message();
  // What a node lacks is a loss of this attempt: other nodes may have it.
  const bool lacks = out.final && out.final->shortage() != 0;
  if (out.kind == ExitKind::not_started || lacks) {
    out.kind = ExitKind::gone;
    out.detail =
        slurm_name(attempt) + where + " could not compute: " + (lacks ? out.final->message() : ended.message());
    out.final.reset();
    return out;
  }
  if (out.kind != ExitKind::stopped || ends_job(ended)) return out;
  if (ended.reason() == Ended::TIME_LIMIT && !ended.advanced()) {
    out.kind = ExitKind::gone;
    out.final.reset();
    out.detail = slurm_name(attempt) + " came to its time limit before the job got further.";
  } else if (ended.reason() == Ended::TIME_LIMIT) {
    out.detail = slurm_name(attempt) + " came to its time limit and left the job at a checkpoint";
  } else if (ended.reason() == Ended::LEASE) {
    out.detail = slurm_name(attempt) + " lost its connection to the daemon and left the job at a checkpoint";
  } else {
    out.detail = slurm_name(attempt) + " was told to end and left the job at a checkpoint";
  }
  return out;
}

}  // namespace cellcrush::slurm
