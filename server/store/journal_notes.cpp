// Notes on jobs and sweeps.
#include <utility>

#include "error.h"
#include "store/change_reader.h"
#include "store/contents.h"
#include "store/job_rows.h"
#include "store/job_state.h"
#include "store/journal.h"
#include "store/journal_mending.h"
#include "store/resource_name.h"

namespace cellcrush::store {
namespace {

// Whether there is something to write.
bool replaces(const std::string& name, const std::string& stored, const std::string& note,
              const std::string& previous) {
  if (stored == note) return false;
  if (stored == previous) return true;
  throw ServiceError(ServiceError::Kind::aborted,
                     "The note of " + name + " has changed meanwhile. To replace it, pass what it is now as " +
                         "previous_note: " + (stored.empty() ? "no note." : "\"" + stored + "\"."));
}

v1::Sweep find_sweep(Database& database, std::int64_t sweep) {
  Statement read(database, "SELECT sweep, checksum = expected_checksum FROM sweeps WHERE number = ?1 AND NOT deleting");
  const std::string name = sweep_name_of(sweep);
  if (!read.bind(1, sweep).step()) throw ServiceError(ServiceError::Kind::not_found, "There is no " + name + ".");
  v1::Sweep out;
  if (read.integer(1) != 0 && ContentReader(database).read_sweep(read.bytes(0), out)) return out;
  throw unreadable_sweep(sweep);
}

}  // namespace

bool Journal::set_note(std::int64_t job, const std::string& note, const std::string& previous) {
  bool is_new = false;
  writes_.run([&] {
    auto [stored, last] = read_state(job);
    is_new = replaces(name_of(job), stored.note(), note, previous);
    if (!is_new) return;
    stored.set_note(note);
    // No event follows that of a job's end.
    const bool has_ended = is_terminal(stored.state());
    add_state(database_, job, stored, has_ended ? last : last + 1);
    // Receivers of notices are not told of the end again.
    if (has_ended)
      Statement(database_, "UPDATE changes SET sequence = 0 WHERE number = (SELECT MAX(number) FROM changes)").run();
  });
  if (is_new) on_durable_(job);
  return is_new;
}

bool Journal::set_sweep_note(std::int64_t sweep, const std::string& note, const std::string& previous) {
  bool is_new = false;
  writes_.run([&] {
    v1::Sweep stored = find_sweep(database_, sweep);
    is_new = replaces(sweep_name_of(sweep), stored.note(), note, previous);
    if (!is_new) return;
    stored.set_note(note);
    Statement update(database_, "UPDATE sweeps SET sweep = ?2 WHERE number = ?1");
    update.bind(1, sweep).bind_blob(2, ContentWriter(database_).of_sweep(std::move(stored))).run();
    Statement change(database_, "INSERT INTO changes (kind, resource, sequence) VALUES (?1, ?2, 0)");
    change.bind(1, static_cast<std::int64_t>(ChangeKind::sweep_changed)).bind(2, sweep).run();
  });
  return is_new;
}

}  // namespace cellcrush::store
