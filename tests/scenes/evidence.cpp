#include "scenes/evidence.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace cellcrush::scenes {
namespace {

constexpr const char* kEvidenceFile = CELLCRUSH_EVIDENCE;
constexpr const char* kEvidenceHeader = "test,quantity,value";
constexpr double kBoundSlack = 3.0;
constexpr double kLeastBound = 1e-14;

using Key = Evidence::key_type;

bool is_writing() { return std::getenv("CELLCRUSH_WRITE_EVIDENCE") != nullptr; }

/// The running test without what its parameters add on either side.
std::string test_name() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  const std::string suite = test.test_suite_name();
  const std::string name = test.name();
  return suite.substr(suite.find('/') + 1) + "." + name.substr(0, name.find('/'));
}

std::string printed(const char* format, int precision, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, precision, value);
  return text;
}

/// 1.961, 1.2e-4.
std::string text_of(double value, int digits) {
  const std::string text = printed("%.*e", digits - 1, value);
  const std::size_t mark = text.find('e');
  const int exponent = std::stoi(text.substr(mark + 1));
  if (exponent < -3) return text.substr(0, mark) + "e" + std::to_string(exponent);
  return printed("%.*f", std::max(0, digits - 1 - exponent), value);
}

/// The unit of the last digit of a number as it is printed.
double last_unit(const std::string& text) {
  const std::size_t mark = std::min(text.find('e'), text.size());
  const std::size_t point = std::min(text.find('.'), mark);
  const int exponent = mark < text.size() ? std::stoi(text.substr(mark + 1)) : 0;
  return std::pow(10.0, exponent - (point < mark ? static_cast<int>(mark - point) - 1 : 0));
}

double rounded_up(double magnitude) {
  const double unit = std::pow(10.0, std::floor(std::log10(magnitude)) - 1.0);
  return std::ceil(magnitude / unit * (1.0 - 1e-12)) * unit;
}

/// The recorded text; empty, and the test fails, without a row.
std::string recorded(const Key& key) {
  const Evidence evidence = read_evidence(kEvidenceFile);
  const auto row = evidence.find(key);
  if (row != evidence.end()) return row->second;
  ADD_FAILURE() << "tests/core/evidence.csv has no row " << key.first << "," << key.second
                << ". Run this test with CELLCRUSH_WRITE_EVIDENCE=1, then docs_evidence_page.";
  return "";
}

/// Keeps other tests that run at the same time from the file.
class FileLock {
 public:
  FileLock() : file_(open(kEvidenceFile, O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
    if (file_ < 0 || flock(file_, LOCK_EX) != 0) throw std::runtime_error(std::string("cannot lock ") + kEvidenceFile);
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock() { ::close(file_); }

 private:
  int file_;
};

/// Writes a row among the others, or keeps the recorded one where `keeps` says so.
template <class Keeps>
void write(const Key& key, const std::string& text, const Keeps& keeps) {
  if (key.second.find(',') != std::string::npos) throw std::invalid_argument("a comma in the quantity: " + key.second);
  const FileLock lock;
  Evidence evidence = read_evidence(kEvidenceFile);
  std::string& value = evidence[key];
  if (value.empty() || !keeps(value)) value = text;
  write_evidence(kEvidenceFile, evidence);
}

}  // namespace

Evidence read_evidence(const std::filesystem::path& path) {
  Evidence evidence;
  std::ifstream file(path);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::size_t first = line.find(',');
    const std::size_t last = line.rfind(',');
    if (first == last || std::count(line.begin(), line.end(), ',') != 2)
      throw std::invalid_argument(path.string() + ":" + std::to_string(number) + ": not " + kEvidenceHeader);
    if (line != kEvidenceHeader)
      evidence[{line.substr(0, first), line.substr(first + 1, last - first - 1)}] = line.substr(last + 1);
  }
  return evidence;
}

void write_evidence(const std::filesystem::path& path, const Evidence& evidence) {
  std::ofstream file(path);
  file << kEvidenceHeader << "\n";
  for (const auto& [row, number] : evidence) file << row.first << "," << row.second << "," << number << "\n";
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void record_figure(const std::string& quantity, double value, int digits, const Expected& expected) {
  EXPECT_NEAR(value, expected.value, expected.tolerance) << quantity;
  const Key key(test_name(), quantity);
  if (is_writing()) return write(key, text_of(value, digits), [](const std::string&) { return false; });
  const std::string text = recorded(key);
  if (text.empty()) return;
  EXPECT_NEAR(value, std::stod(text), last_unit(text)) << quantity;
}

void record_bound(const std::string& quantity, double value, double most) {
  EXPECT_LT(std::abs(value), most) << quantity;
  const Key key(test_name(), quantity);
  const double bound = rounded_up(std::max(std::abs(value), kLeastBound));
  if (is_writing()) {
    return write(key, text_of(bound, 2), [&](const std::string& before) { return std::stod(before) >= bound; });
  }
  const std::string text = recorded(key);
  if (text.empty()) return;
  EXPECT_LE(std::abs(value), kBoundSlack * std::stod(text)) << quantity;
}

}  // namespace cellcrush::scenes
