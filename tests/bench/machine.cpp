#include "bench/machine.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "worker/stage_timer.h"

namespace cellcrush::bench {
namespace {

/// What follows `key` and a colon in a file of such lines; empty when no line begins with it.
std::string value_in(const char* file, const std::string& key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (line.starts_with(key) && colon != std::string::npos) {
      const std::size_t first = line.find_first_not_of(" \t", colon + 1);
      return first == std::string::npos ? "" : line.substr(first);
    }
  }
  return "";
}

double kilobytes_in_status(const char* key) {
  double kilobytes = 0.0;
  if (!(std::istringstream(value_in("/proc/self/status", key)) >> kilobytes)) {
    throw std::runtime_error(std::string("/proc/self/status: has no ") + key + "; memory is measured on Linux only.");
  }
  return 1024.0 * kilobytes;
}

}  // namespace

std::string processor_name() {
  std::string name = value_in("/proc/cpuinfo", "model name");
  std::replace(name.begin(), name.end(), ',', ' ');
  return name.empty() ? "unknown" : name;
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof(text), "%Y-%m-%d", std::gmtime(&now));
  return text;
}

double processor_seconds() { return worker::processor_seconds(CLOCK_PROCESS_CPUTIME_ID); }

double resident_bytes() { return kilobytes_in_status("VmRSS"); }

double greatest_resident_bytes() { return kilobytes_in_status("VmHWM"); }

std::string build_name() {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::uint64_t hash = 14695981039346656037ULL;
  for (std::istreambuf_iterator<char> byte(program), end; byte != end; ++byte) {
    hash = (hash ^ static_cast<unsigned char>(*byte)) * 1099511628211ULL;
  }
  char text[32];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace cellcrush::bench
