#include "store/epoch.h"

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
  constexpr const char* kHexadecimal = "0123456789abcdef";
  std::random_device random;
  std::string out;
  for (int i = 0; i < 16; ++i) out.push_back(kHexadecimal[random() % 16U]);
  return out;
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
