#include "step/execute_stages.h"

#include "cellcrush/tuning.h"

namespace cellcrush {
namespace {

using Stages = std::span<const StageEntry>;

bool overlaps(const StageEntry& entry, const StepInProgress& step) {
  return entry.split != nullptr && step.workspace.workers.count() > 1 &&
         step.scene.element_count() <= kMostElementsOverlapped;
}

/// Number of stages, from the first on, that the function for the whole or the loop over the bands takes together.
std::size_t count_together(Stages stages) {
  const auto is_banded = [](const StageEntry& entry) { return entry.on_whole == nullptr; };
  std::size_t count = 1;
  while (count < stages.size() && is_banded(stages.front()) && is_banded(stages[count]) &&
         stages[count].bands_behind == stages.front().bands_behind) {
    ++count;
  }
  return count;
}

/// Each runs the first stages and returns their number.
std::size_t execute_plain(Stages stages, StepInProgress& step, const StageScope& scope) {
  const Stages together = stages.first(count_together(stages));
  if (const auto on_whole = together.front().on_whole; on_whole != nullptr) {
    scope.begin(together.front().stage);
    on_whole(step);
    return together.size();
  }
  for (std::size_t band = 0; band < step.scene.bands.size(); ++band) {
    for (const StageEntry& entry : together) {
      scope.begin(entry.stage);
      entry.on_band(step, band);
    }
  }
  return together.size();
}

std::size_t execute_overlapped(Stages stages, StepInProgress& step, const StageScope& scope) {
  const StageEntry& first = stages.front();
  const SplitStage& split = *first.split;
  std::size_t end = 1;
  while (end < stages.size() && runs_beside(stages[end], split)) {
    ++end;
  }
  scope.begin(first.stage);
  split.begin(step);
  step.workspace.workers.parallel_overlap(
      split.piece_count(step.scene), [&](std::size_t piece) { split.piece(step, piece); },
      [&] {
        for (std::size_t i = 1; i < end;) {
          i += execute_plain(stages.subspan(i, end - i), step, scope);
        }
      });
  scope.begin(first.stage);
  split.end(step);
  return end;
}

}  // namespace

void execute_stages(Stages stages, StepInProgress& step, const StageScope& scope) {
  while (!stages.empty()) {
    const bool overlap = overlaps(stages.front(), step);
    stages = stages.subspan(overlap ? execute_overlapped(stages, step, scope) : execute_plain(stages, step, scope));
  }
}

void execute_band_stages(Stages stages, StepInProgress& step, std::size_t band, const StageScope& scope) {
  for (const StageEntry& entry : stages) {
    if (entry.on_band != nullptr && band >= entry.bands_behind && band - entry.bands_behind < step.scene.bands.size()) {
      scope.begin(entry.stage);
      entry.on_band(step, band - entry.bands_behind);
    }
  }
}

}  // namespace cellcrush
