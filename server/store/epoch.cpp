#include "store/epoch.h"

#include <fmt/format.h>

#include <random>

namespace cellcrush::store {
namespace {

std::string fact(Database& database, const std::string& name) {
  Statement read(database, "SELECT value FROM facts WHERE name = ?1");
  return read.bind_text(1, name).step() ? read.bytes(0) : "";
}

void set_fact(Database& database, const std::string& name, const std::string& value) {
  Statement write(database, "INSERT OR REPLACE INTO facts (name, value) VALUES (?1, ?2)");
  write.bind_text(1, name).bind_text(2, value).run();
}

// Sixteen hexadecimal digits.
std::string random_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}", random(), random());
}

}  // namespace

Epoch read_epoch(Database& database) { return {fact(database, "epoch"), fact(database, "restored")}; }

void ensure_epoch(Database& database) {
  if (fact(database, "epoch").empty()) set_fact(database, "epoch", random_id());
}

void begin_epoch(Database& database, const std::string& restored) {
  set_fact(database, "epoch", random_id());
  set_fact(database, "restored", restored);
}

}  // namespace cellcrush::store
