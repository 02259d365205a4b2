#pragma once

#include <cstdint>

struct sqlite3;

namespace cellcrush::store {

class Database;

// The tables of a journal have two columns for what a disk may do to a row: `checksum` is stored, and SQLite computes
// `expected_checksum` from the other columns when it is asked for. Triggers keep them equal. A row in which they differ
// is damaged, and stays so: no trigger seals it again.

/// The SQL function row_checksum(...): CRC-32 of the values with their types and lengths. All have the same size in a
/// row, so that sealing a row does not move it. Returns an SQLite result code.
int add_row_checksum(sqlite3* connection);

/// Adds the columns and triggers to a journal without them, and seals its rows. REQUIRES: a transaction is open. Throws
/// ServiceError.
void seal_tables(Database& database);

/// Seals the row of a job that was mended. REQUIRES: a transaction is open. Throws ServiceError.
void seal_job(Database& database, std::int64_t job);

}  // namespace cellcrush::store
