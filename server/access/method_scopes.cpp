#include "access/method_scopes.h"

#include <algorithm>
#include <array>

namespace cellcrush::access {
namespace {

constexpr std::optional<Scope> kOpen = std::nullopt;

struct ScopeEntry {
  std::string_view path;
  std::optional<Scope> scope;
};

// The only table of who may call what. A method with scope submit that changes a job or sweep also checks its owner
// (Gate::require_own).
constexpr std::array kScopeEntries = {
    // Its service admits a task by the token of its attempt.
    ScopeEntry{"/cellcrush.slurm.Workers/ClaimAttempt", kOpen},
    ScopeEntry{"/cellcrush.slurm.Workers/Contact", kOpen},
    ScopeEntry{"/cellcrush.slurm.Workers/EndAttempt", kOpen},
    ScopeEntry{"/cellcrush.slurm.Workers/ReadFile", kOpen},
    ScopeEntry{"/cellcrush.slurm.Workers/WriteFile", kOpen},
    ScopeEntry{"/cellcrush.v1.Admin/Drain", Scope::admin},
    ScopeEntry{"/cellcrush.v1.Admin/GetCapabilities", Scope::read},
    ScopeEntry{"/cellcrush.v1.Admin/GetQueue", Scope::read},
    ScopeEntry{"/cellcrush.v1.Cases/CheckCase", Scope::read},
    ScopeEntry{"/cellcrush.v1.Cases/GetPreset", Scope::read},
    ScopeEntry{"/cellcrush.v1.Cases/ListPresets", Scope::read},
    ScopeEntry{"/cellcrush.v1.Cases/PreviewCase", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/CancelJob", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Jobs/CreateJob", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Jobs/DeleteJob", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Jobs/DownloadResult", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/ExportJob", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/GetFrame", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/GetHistory", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/GetJob", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/ListJobs", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/ResumeJob", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Jobs/StreamFrames", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/SuspendJob", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Jobs/WatchJob", Scope::read},
    ScopeEntry{"/cellcrush.v1.Jobs/WatchJobs", Scope::read},
    ScopeEntry{"/cellcrush.v1.Sweeps/CancelSweep", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Sweeps/CreateSweep", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Sweeps/DeleteSweep", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Sweeps/GetConvergence", Scope::read},
    ScopeEntry{"/cellcrush.v1.Sweeps/GetSweep", Scope::read},
    ScopeEntry{"/cellcrush.v1.Sweeps/GetSweepTable", Scope::read},
    ScopeEntry{"/cellcrush.v1.Sweeps/ListSweeps", Scope::read},
    ScopeEntry{"/cellcrush.v1.Sweeps/RetryFailedJobs", Scope::submit},
    ScopeEntry{"/cellcrush.v1.Sweeps/WatchSweep", Scope::read},
    ScopeEntry{"/grpc.health.v1.Health/Check", kOpen},
    ScopeEntry{"/grpc.health.v1.Health/Watch", kOpen},
    ScopeEntry{"/grpc.reflection.v1.ServerReflection/ServerReflectionInfo", Scope::read},
    ScopeEntry{"/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo", Scope::read},
};

const ScopeEntry* find_entry(std::string_view path) {
  const auto* found = std::find_if(kScopeEntries.begin(), kScopeEntries.end(),
                                   [path](const ScopeEntry& entry) { return entry.path == path; });
  return found == kScopeEntries.end() ? nullptr : found;
}

}  // namespace

std::optional<Scope> needed_scope(std::string_view path) {
  const ScopeEntry* entry = find_entry(path);
  return entry == nullptr ? Scope::admin : entry->scope;
}

bool has_scope_entry(std::string_view path) { return find_entry(path) != nullptr; }

}  // namespace cellcrush::access
