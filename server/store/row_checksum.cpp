#include "store/row_checksum.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <span>

#include "store/sqlite.h"

namespace cellcrush::store {
namespace {

// Above every CRC-32, so that SQLite stores the sum in six bytes, whatever the CRC is.
constexpr std::int64_t kOfOneSize = std::int64_t{1} << 32;

std::uint64_t add_bytes(std::uint64_t crc, const void* bytes, std::size_t size) {
  // A null pointer would begin a new sum.
  return size == 0 ? crc : crc32_z(crc, static_cast<const unsigned char*>(bytes), size);
}

std::uint64_t add_value(std::uint64_t crc, sqlite3_value* value) {
  std::array<unsigned char, 9> head{static_cast<unsigned char>(sqlite3_value_type(value))};
  const bool is_number = head[0] == SQLITE_INTEGER;
  const void* bytes = is_number ? nullptr : sqlite3_value_blob(value);
  const auto size = is_number ? 0 : static_cast<std::size_t>(sqlite3_value_bytes(value));
  const std::int64_t number = is_number ? sqlite3_value_int64(value) : static_cast<std::int64_t>(size);
  std::memcpy(head.data() + 1, &number, sizeof number);
  return add_bytes(add_bytes(crc, head.data(), head.size()), bytes, size);
}

void row_checksum(sqlite3_context* context, int count, sqlite3_value** values) {
  std::uint64_t crc = 0;
  for (sqlite3_value* value : std::span(values, static_cast<std::size_t>(count))) crc = add_value(crc, value);
  sqlite3_result_int64(context, kOfOneSize | static_cast<std::int64_t>(crc));
}

struct SealedTable {
  const char* name;
  const char* columns;      // what the checksum covers
  const char* is_new;       // the row that a trigger is about
  const char* before = "";  // what is written before a new row is sealed
};

constexpr std::array kSealed{
    SealedTable{"jobs",
                "number, state, job, case_checksum, request_id, request_hash, last_sequence, priority, submission, "
                "element_steps, owner, title, ended_at, bytes, measured, executor, samples, begun_again, states",
                "number = new.number",
                "UPDATE jobs SET case_checksum = row_checksum(submitted_case) WHERE number = new.number "
                "AND case_checksum = 0;"},
    SealedTable{"events", "job, sequence, payload", "job = new.job AND sequence = new.sequence"},
    SealedTable{"meshes", "job, mesh", "job = new.job"},
    SealedTable{"sweeps", "number, sweep, max_parallel, request_id, request_hash, max_failures, owner, deleting",
                "number = new.number"},
    SealedTable{"sweep_jobs", "sweep, position, job, point, stopped", "sweep = new.sweep AND position = new.position"},
    SealedTable{"changes", "number, kind, resource, sequence", "number = new.number"},
    SealedTable{"service_clock", "id, seconds", "id = new.id"},
    SealedTable{"facts", "name, value", "name = new.name"}};

}  // namespace

int add_row_checksum(sqlite3* connection) {
  return sqlite3_create_function_v2(connection, "row_checksum", -1,
                                    SQLITE_UTF8 | SQLITE_DETERMINISTIC | SQLITE_INNOCUOUS, nullptr, row_checksum,
                                    nullptr, nullptr, nullptr);
}

void seal_tables(Database& database) {
  // A case may have megabytes and never changes; a state is not to read it.
  database.execute(
      "ALTER TABLE jobs ADD COLUMN case_checksum INTEGER NOT NULL DEFAULT 0;"
      "ALTER TABLE jobs ADD COLUMN states INTEGER NOT NULL DEFAULT 1;"
      "UPDATE jobs SET case_checksum = row_checksum(submitted_case), "
      "states = (SELECT COUNT(*) FROM events WHERE events.job = jobs.number);");
  for (const auto& [name, columns, is_new, before] : kSealed) {
    const auto sql = fmt::format(
        "ALTER TABLE {0} ADD COLUMN checksum INTEGER NOT NULL DEFAULT {3};"
        "ALTER TABLE {0} ADD COLUMN expected_checksum INTEGER AS (row_checksum({1})) VIRTUAL;"
        "UPDATE {0} SET checksum = expected_checksum;"
        "CREATE TRIGGER seal_new_{0} AFTER INSERT ON {0} BEGIN {4}"
        "  UPDATE {0} SET checksum = expected_checksum WHERE {2}; "
        "END;"
        "CREATE TRIGGER seal_changed_{0} AFTER UPDATE OF {1} ON {0} WHEN old.checksum = old.expected_checksum BEGIN"
        "  UPDATE {0} SET checksum = expected_checksum WHERE {2}; "
        "END;",
        name, columns, is_new, kOfOneSize, before);
    database.execute(sql.c_str());
  }
}

void seal_job(Database& database, std::int64_t job) {
  Statement(database, "UPDATE jobs SET checksum = expected_checksum WHERE number = ?1").bind(1, job).run();
}

}  // namespace cellcrush::store
