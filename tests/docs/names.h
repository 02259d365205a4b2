#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "docs/links.h"
#include "docs/page.h"

namespace cellcrush::docs {

/// Paths of the tree that stand between backticks (`core/step/ledger.h`, `tests/bench`) and lead nowhere. A path ends
/// before a colon or blank; one with `*`, `{` or letters for others (`jobs/JOB`) is held to the part before them.
Findings check_paths(const std::filesystem::path& root, const std::vector<Page>& pages);

/// Fields of a case (`loading.speed_m_per_s`, between backticks or behind --set and --over) that case.proto does not
/// have.
Findings check_fields(const std::vector<Page>& pages);

/// `preset:NAME` in the pages of which there is no preset.
Findings check_presets(const std::vector<Page>& pages);

/// Variables of the environment (CELLCRUSH_...) in the pages that stand in no source of the tree.
Findings check_variables(const std::filesystem::path& root, const std::vector<Page>& pages);

}  // namespace cellcrush::docs
