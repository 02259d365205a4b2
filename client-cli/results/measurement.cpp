#include "results/measurement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <utility>

#include "case_file/typed_number.h"
#include "command_error.h"

namespace cellcrush::client {
namespace {

enum class TestQuantity { none, strain, displacement, stress, force };

struct TestUnit {
  std::string_view name;
  TestQuantity quantity;
  double factor;  ///< to 1, mm, MPa or N
};

constexpr std::array kUnits = {TestUnit{"%", TestQuantity::strain, 0.01},
                               TestUnit{"mm/mm", TestQuantity::strain, 1.0},
                               TestUnit{"-", TestQuantity::strain, 1.0},
                               TestUnit{"mm", TestQuantity::displacement, 1.0},
                               TestUnit{"cm", TestQuantity::displacement, 10.0},
                               TestUnit{"m", TestQuantity::displacement, 1000.0},
                               TestUnit{"um", TestQuantity::displacement, 1e-3},
                               TestUnit{"in", TestQuantity::displacement, 25.4},
                               TestUnit{"Pa", TestQuantity::stress, 1e-6},
                               TestUnit{"kPa", TestQuantity::stress, 1e-3},
                               TestUnit{"MPa", TestQuantity::stress, 1.0},
                               TestUnit{"GPa", TestQuantity::stress, 1e3},
                               TestUnit{"N/mm2", TestQuantity::stress, 1.0},
                               TestUnit{"N/mm^2", TestQuantity::stress, 1.0},
                               TestUnit{"psi", TestQuantity::stress, 0.00689475729},
                               TestUnit{"N", TestQuantity::force, 1.0},
                               TestUnit{"kN", TestQuantity::force, 1000.0},
                               TestUnit{"mN", TestQuantity::force, 1e-3},
                               TestUnit{"lbf", TestQuantity::force, 4.4482216153}};
constexpr const char* kKnownUnits = "%, mm/mm, mm, cm, m, um, in, N, mN, kN, lbf, Pa, kPa, MPa, GPa, N/mm2, psi";
constexpr const char* kRemedy =
    "Name all columns in order with their units, and - for one that does not count: --columns \"displacement mm, force "
    "N\"";

struct TestColumn {
  TestQuantity quantity = TestQuantity::none;
  double factor = 1.0;
};

const char* name_of(TestQuantity quantity) {
  switch (quantity) {
    case TestQuantity::strain: return "strain";
    case TestQuantity::displacement: return "displacement";
    case TestQuantity::stress: return "stress";
    case TestQuantity::force: return "force";
    case TestQuantity::none: break;
  }
  return "none";
}

[[noreturn]] void refuse_file(const std::string& file, const std::string& why) { refuse(file + ": " + why); }

const TestUnit* find_unit(std::string_view text) {
  const auto found = std::ranges::find(kUnits, text, &TestUnit::name);
  return found == kUnits.end() ? nullptr : &*found;
}

std::string_view without_blanks(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

std::string_view trimmed(std::string_view text) {
  text = without_blanks(text);
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"') text = text.substr(1, text.size() - 2);
  return without_blanks(text);
}

// The unit of "Load (kN)", "Load [kN]", "Load / kN", "load_kN" or "load kN"; null without one.
const TestUnit* unit_in(std::string_view title) {
  if (const TestUnit* whole = find_unit(title); whole != nullptr && title != "-") return whole;
  const auto open = title.find_last_of("([");
  if (open != std::string_view::npos) {
    const auto close = title.find_first_of(")]", open);
    return find_unit(trimmed(title.substr(open + 1, close == std::string_view::npos ? close : close - open - 1)));
  }
  const auto sign = title.find_last_of("/_ \t");
  // The sign of "mm/mm" or "N/mm2" is part of the unit.
  for (auto at = title.find_first_of("/_ \t"); at != std::string_view::npos;
       at = title.find_first_of("/_ \t", at + 1)) {
    if (const TestUnit* unit = find_unit(trimmed(title.substr(at + 1)))) return unit;
    if (at == sign) break;
  }
  return nullptr;
}

TestColumn column_of(std::string_view title) {
  if (const TestUnit* unit = unit_in(title)) return {unit->quantity, unit->factor};
  std::string lower(title);
  std::ranges::transform(lower, lower.begin(), [](unsigned char letter) { return std::tolower(letter); });
  if (lower.find("strain") != std::string::npos && lower.find("rate") == std::string::npos)
    return {TestQuantity::strain, 1.0};
  return {};
}

char separator_of(std::string_view line) {
  for (const char each : {';', '\t'}) {
    if (line.find(each) != std::string_view::npos) return each;
  }
  return ',';
}

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> out;
  bool is_quoted = false;
  std::string cell;
  for (const char each : line) {
    if (each == '"') is_quoted = !is_quoted;
    if (each == separator && !is_quoted) {
      out.emplace_back(trimmed(cell));
      cell.clear();
    } else {
      cell += each;
    }
  }
  out.emplace_back(trimmed(cell));
  return out;
}

bool is_number(const std::string& cell) { return !read_real(cell).plain.empty(); }

struct TestLine {
  int number = 0;
  std::vector<std::string> cells;
};

std::vector<TestLine> lines_of(std::string_view text) {
  if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
  std::vector<TestLine> out;
  int number = 0;
  char separator = 0;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = without_blanks(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.empty() || line.front() == '#') continue;
    if (separator == 0) separator = separator_of(line);
    out.push_back({number, cells_of(line, separator)});
  }
  return out;
}

// Where the columns of a test are.
struct TestLayout {
  std::size_t along = 0;   ///< of strain or displacement
  std::size_t across = 0;  ///< of stress or force
  std::vector<TestColumn> columns;
};

TestLayout layout_of(const std::vector<std::string>& titles, const std::vector<TestColumn>& columns,
                     const std::string& file) {
  TestLayout out;
  out.columns = columns;
  const auto find = [&](TestQuantity one, TestQuantity other) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].quantity != one && columns[i].quantity != other) continue;
      if (found) {
        refuse_file(file, fmt::format("columns {} and {} are both {} or {}. {}", *found + 1, i + 1, name_of(one),
                                      name_of(other), kRemedy));
      }
      found = i;
    }
    if (!found) {
      refuse_file(file, fmt::format("no column is {} or {} with a unit ({}); the columns are \"{}\". {}", name_of(one),
                                    name_of(other), kKnownUnits, fmt::join(titles, "\", \""), kRemedy));
    }
    return *found;
  };
  out.along = find(TestQuantity::strain, TestQuantity::displacement);
  out.across = find(TestQuantity::stress, TestQuantity::force);
  return out;
}

double value_of(const TestLine& line, std::size_t column, const std::string& file) {
  if (column >= line.cells.size())
    refuse_file(file, fmt::format("line {} has {} columns, and not {}", line.number, line.cells.size(), column + 1));
  const TypedNumber read = read_real(line.cells[column]);
  double value = 0.0;
  if (read.plain.empty() || !parse_plain(read.plain, value) || !std::isfinite(value))
    refuse_file(file, fmt::format("line {}, column {}: \"{}\" {}", line.number, column + 1, line.cells[column],
                                  read.problem.empty() ? "is not a number" : read.problem));
  return value;
}

// Compression may be told as negative.
void make_positive(std::vector<double>& values) {
  const auto [least, greatest] = std::ranges::minmax_element(values);
  if (-*least <= *greatest) return;
  for (double& value : values) value = -value;
}

}  // namespace

double StressCurve::at(double at) const {
  const auto next = std::ranges::upper_bound(strain, at);
  if (next == strain.end()) return stress_mpa.back();
  const auto i = static_cast<std::size_t>(next - strain.begin());
  if (i == 0) return stress_mpa.front();
  const double share = (at - strain[i - 1]) / (strain[i] - strain[i - 1]);
  return stress_mpa[i - 1] + share * (stress_mpa[i] - stress_mpa[i - 1]);
}

Measurement read_measurement(const std::string& text, const std::string& file, const std::string& columns,
                             const Specimen& specimen) {
  std::vector<TestLine> lines = lines_of(text);
  if (lines.empty()) refuse_file(file, "has no rows");
  auto data = lines.begin();
  std::vector<std::string> titles;
  if (!std::ranges::any_of(data->cells, is_number)) titles = (data++)->cells;
  std::vector<TestColumn> found;
  for (const auto& title : titles) found.push_back(column_of(title));
  // Testing machines write a row of units below the titles.
  if (data != lines.end() && !titles.empty() && !std::ranges::any_of(data->cells, is_number)) {
    for (std::size_t i = 0; i < std::min(found.size(), data->cells.size()); ++i) {
      if (const TestUnit* unit = unit_in(data->cells[i])) found[i] = {unit->quantity, unit->factor};
    }
    ++data;
  }
  if (!columns.empty()) {
    titles = cells_of(columns, ',');
    found.clear();
    for (const auto& title : titles) {
      found.push_back(title == "-" ? TestColumn() : column_of(title));
      if (title != "-" && found.back().quantity == TestQuantity::none)
        refuse_file(file, fmt::format("--columns has \"{}\" without a unit that is known ({}). {}", title, kKnownUnits,
                                      kRemedy));
    }
  }
  if (titles.empty()) refuse_file(file, std::string("has no header. ") + kRemedy);
  const TestLayout layout = layout_of(titles, found, file);
  std::vector<double> strain;
  std::vector<double> stress;
  for (; data != lines.end(); ++data) {
    strain.push_back(value_of(*data, layout.along, file) * layout.columns[layout.along].factor);
    stress.push_back(value_of(*data, layout.across, file) * layout.columns[layout.across].factor);
  }
  if (strain.size() < 3) refuse_file(file, fmt::format("has {} rows of numbers; a curve needs 3", strain.size()));
  make_positive(strain);
  make_positive(stress);
  const bool is_displacement = layout.columns[layout.along].quantity == TestQuantity::displacement;
  const bool is_force = layout.columns[layout.across].quantity == TestQuantity::force;
  Measurement out{file, {}};
  for (std::size_t i = 0; i < strain.size(); ++i) {
    const double now = is_displacement ? strain[i] / specimen.length_mm : strain[i];
    // Unloading and noise between two rows.
    if (!out.curve.strain.empty() && now <= out.curve.strain.back()) continue;
    out.curve.strain.push_back(now);
    out.curve.stress_mpa.push_back(is_force ? stress[i] / specimen.area_mm2 : stress[i]);
  }
  constexpr double kMost = 2.0;
  if (out.curve.strain.back() > kMost) {
    refuse_file(file, fmt::format("reaches a strain of {:.3g}. {}", out.curve.strain.back(),
                                  is_displacement ? "The specimen of the job is shorter than that of the test, or the "
                                                    "displacement has another unit"
                                                  : "Its unit may be %: --columns \"strain %, ...\""));
  }
  if (out.curve.strain.size() < 3) refuse_file(file, "does not get further after its first rows");
  return out;
}

}  // namespace cellcrush::client
