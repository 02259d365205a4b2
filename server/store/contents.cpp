#include "store/contents.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "store/case_hash.h"
#include "store/large_lattice.h"

namespace cellcrush::store {
namespace {

// A BLOB that refers to a content begins with its name, "sha256:" and 64 digits; the rest of the message follows. No
// message begins like this: "s" would open a group, which they do not have.
constexpr std::string_view kContentPrefix = "sha256:";
constexpr std::size_t kNameBytes = kContentPrefix.size() + 64;

std::string name_of_content(const std::string& bytes) { return std::string(kContentPrefix) + sha256_of(bytes); }

// The name at the beginning of a BLOB; empty for one that refers to none.
std::string name_in(const std::string& stored) {
  return stored.starts_with(kContentPrefix) ? stored.substr(0, kNameBytes) : "";
}

// Nothing if it is missing or damaged.
std::optional<std::string> find_content(Database& database, const std::string& name) {
  Statement read(database, "SELECT bytes FROM contents WHERE name = ?1");
  if (!read.bind_text(1, name).step()) return std::nullopt;
  std::string bytes = read.bytes(0);
  if (name_of_content(bytes) != name) return std::nullopt;
  return bytes;
}

}  // namespace

const std::string& ContentWriter::put(const std::string& bytes) {
  if (!name_.empty() && bytes == last_) return name_;
  last_ = bytes;
  name_ = name_of_content(last_);
  Statement known(database_, "SELECT bytes = ?2 FROM contents WHERE name = ?1");
  if (!known.bind_text(1, name_).bind_blob(2, last_).step()) {
    Statement insert(database_, "INSERT INTO contents (name, bytes) VALUES (?1, ?2)");
    insert.bind_text(1, name_).bind_blob(2, last_).run();
  } else if (known.integer(0) == 0) {
    Statement update(database_, "UPDATE contents SET bytes = ?2 WHERE name = ?1");
    update.bind_text(1, name_).bind_blob(2, last_).run();
  }
  return name_;
}

std::string ContentWriter::of_case(v1::Case submitted) {
  auto lattice = take_lattice_out(submitted);
  std::string out = submitted.SerializeAsString();
  if (lattice) out.insert(0, put(*lattice));
  return out;
}

std::string ContentWriter::of_sweep(v1::Sweep sweep) {
  auto lattice = sweep.has_case_() ? take_lattice_out(*sweep.mutable_case_()) : std::nullopt;
  std::string out = sweep.SerializeAsString();
  if (lattice) out.insert(0, put(*lattice));
  return out;
}

std::string ContentWriter::of_mesh(const v1::Mesh& mesh) {
  std::string bytes = mesh.SerializeAsString();
  if (bytes.size() > kLargeContent) return put(bytes);
  return bytes;
}

template <class Message>
bool ContentReader::read(const std::string& stored, Message& out, v1::Case& (*case_of)(Message&)) {
  const std::string name = name_in(stored);
  if (name.empty()) return out.ParseFromString(stored);
  if (name != name_) {
    auto found = find_content(database_, name);
    if (!found) return false;
    name_ = name;
    lattice_ = *std::move(found);
  }
  return out.ParseFromString(stored.substr(name.size())) && put_lattice_back(lattice_, case_of(out));
}

bool ContentReader::read_case(const std::string& stored, v1::Case& out) {
  return read<v1::Case>(stored, out, [](v1::Case& read) -> v1::Case& { return read; });
}

bool ContentReader::read_sweep(const std::string& stored, v1::Sweep& out) {
  return read<v1::Sweep>(stored, out, [](v1::Sweep& read) -> v1::Case& { return *read.mutable_case_(); });
}

bool ContentReader::read_mesh(const std::string& stored, v1::Mesh& out) {
  const std::string name = name_in(stored);
  if (name.empty()) return out.ParseFromString(stored);
  const auto mesh = find_content(database_, name);
  return mesh && name.size() == stored.size() && out.ParseFromString(*mesh);
}

std::string content_size_of(const std::string& table) {
  return "COALESCE((SELECT LENGTH(bytes) FROM contents WHERE name = " + table + ".content), 0)";
}

void add_contents(Database& database) {
  database.execute("CREATE TABLE contents (name TEXT PRIMARY KEY, bytes BLOB NOT NULL) STRICT");
  constexpr std::array kUsers{std::pair("jobs", "submitted_case"), std::pair("sweeps", "sweep"),
                              std::pair("meshes", "mesh")};
  std::string is_unused = "name = old.content";
  for (const auto& [table, column] : kUsers) {
    const auto sql = fmt::format(
        "ALTER TABLE {0} ADD COLUMN content TEXT REFERENCES contents(name) AS (CASE WHEN substr({1}, 1, {2}) = "
        "CAST('{3}' AS BLOB) THEN CAST(substr({1}, 1, {4}) AS TEXT) END) VIRTUAL;"
        "CREATE INDEX {0}_by_content ON {0}(content) WHERE content IS NOT NULL;",
        table, column, kContentPrefix.size(), kContentPrefix, kNameBytes);
    database.execute(sql.c_str());
    is_unused += fmt::format(" AND NOT EXISTS (SELECT 1 FROM {} WHERE content = old.content)", table);
  }
  // What no row refers to any more goes with the last that did, whoever deletes it.
  for (const auto& [table, column] : kUsers) {
    const auto sql = fmt::format(
        "CREATE TRIGGER forget_content_of_{0} AFTER DELETE ON {0} WHEN old.content IS NOT NULL BEGIN"
        "  DELETE FROM contents WHERE {1}; "
        "END;",
        table, is_unused);
    database.execute(sql.c_str());
  }
}

}  // namespace cellcrush::store
