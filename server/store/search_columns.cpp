#include "store/search_columns.h"

#include <utility>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "store/job_state.h"

namespace cellcrush::store {
namespace {

constexpr int kRowsAtOnce = 500;

struct SearchRow {
  std::int64_t number = 0;
  bool has_ended = false;
  std::int64_t bytes = 0;
  v1::Job job;
  std::string title;
};

// Columns: number, state, job, submitted_case.
SearchRow read_search_row(const Statement& read) {
  const std::string job = read.bytes(2);
  const std::string submitted = read.bytes(3);
  SearchRow out;
  out.number = read.integer(0);
  out.has_ended = is_terminal(static_cast<v1::Job::State>(read.integer(1)));
  out.bytes = static_cast<std::int64_t>(2 * job.size() + submitted.size());
  if (!out.job.ParseFromString(job)) out.job.Clear();
  v1::Case parsed;
  if (parsed.ParseFromString(submitted)) out.title = folded_title(parsed.title());
  return out;
}

// Rows are not changed while they are read.
std::vector<SearchRow> read_search_rows(Database& database, std::int64_t after) {
  Statement read(database, "SELECT number, state, job, submitted_case FROM jobs WHERE number > ?1 ORDER BY number");
  read.bind(1, after);
  std::vector<SearchRow> out;
  while (out.size() < kRowsAtOnce && read.step()) out.push_back(read_search_row(read));
  return out;
}

void fill_in_jobs(Database& database) {
  Statement update(database, "UPDATE jobs SET owner = ?2, title = ?3, bytes = ?4, ended_at = ?5 WHERE number = ?1");
  LabelInserter labels(database);
  std::int64_t after = 0;
  for (auto rows = read_search_rows(database, after); !rows.empty(); rows = read_search_rows(database, after)) {
    for (const auto& row : rows) {
      update.bind(1, row.number).bind_text(2, row.job.owner()).bind_text(3, row.title).bind(4, row.bytes);
      row.has_ended ? update.bind(5, 0) : update.bind_null(5);
      update.run();
      labels.insert(row.number, row.job.labels());
    }
    after = rows.back().number;
  }
}

void fill_in_sweeps(Database& database) {
  std::vector<std::pair<std::int64_t, std::string>> owners;
  {
    Statement read(database, "SELECT number, sweep FROM sweeps");
    for (v1::Sweep sweep; read.step();) {
      if (sweep.ParseFromString(read.bytes(1))) owners.emplace_back(read.integer(0), sweep.owner());
    }
  }
  Statement update(database, "UPDATE sweeps SET owner = ?2 WHERE number = ?1");
  for (const auto& [number, owner] : owners) update.bind(1, number).bind_text(2, owner).run();
}

}  // namespace

std::string folded_title(const std::string& title) {
  std::string out = title;
  for (char& character : out) {
    if (character >= 'A' && character <= 'Z') character = static_cast<char>(character - 'A' + 'a');
  }
  return out;
}

void LabelInserter::insert(std::int64_t job, const google::protobuf::Map<std::string, std::string>& labels) {
  for (const auto& [key, value] : labels) insert_.bind_text(1, key).bind_text(2, value).bind(3, job).run();
}

void fill_in_search_columns(Database& database) {
  fill_in_jobs(database);
  fill_in_sweeps(database);
}

}  // namespace cellcrush::store
