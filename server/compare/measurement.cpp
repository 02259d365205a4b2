#include "compare/measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "error.h"

namespace cellcrush::compare {
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
    "Name all columns in order with their units, and - for one that does not count: \"displacement mm, force N\".";

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

// A text of the file in a message.
std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 60;
  return text.size() <= kMost ? std::string(text) : std::string(text.substr(0, kMost)) + "...";
}

[[noreturn]] void refuse_file(const std::string& file, const std::string& why, const std::string& remedy) {
  throw InvalidField("tests", fmt::format("has {}, which {}.", shortened(file), why), remedy);
}

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
  constexpr std::size_t kLongestTitle = 200;
  if (title.size() > kLongestTitle) return nullptr;
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

// A line of a file, with its number from 1.
struct TestLine {
  int number = 0;
  std::string_view text;
};

// The text of a test, and how it is written.
class TestText {
 public:
  TestText(std::string_view text, const std::string& file) : file_(file) {
    if (text.find('\0') != std::string_view::npos)
      refuse_file(file, "has zero bytes, as UTF-16 has", "Save it as CSV in UTF-8.");
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    for (int number = 1; !text.empty(); ++number) {
      const auto end = std::min(text.find('\n'), text.size());
      const std::string_view line = without_blanks(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (line.empty() || line.front() == '#') continue;
      constexpr std::size_t kMostRows = 200'000;
      if (lines.size() == kMostRows)
        refuse_file(file, fmt::format("has more than {} rows", kMostRows), "Leave out rows: a curve needs a thousand.");
      lines.push_back({number, line});
    }
    if (lines.empty()) refuse_file(file, "has no rows", "Give at least three rows of numbers.");
    separator_ = separator_of(lines.front().text);
  }

  [[nodiscard]] std::vector<std::string> cells_of(const TestLine& line) const {
    return split(line.text, separator_, fmt::format("line {}", line.number));
  }

  // The cells between separators, in quotes or not.
  [[nodiscard]] std::vector<std::string> split(std::string_view text, char separator, const std::string& where) const {
    constexpr std::size_t kMostColumns = 1000;
    std::vector<std::string> out;
    bool is_quoted = false;
    std::size_t begin = 0;
    for (std::size_t at = 0; at <= text.size(); ++at) {
      if (at < text.size() && text[at] == '"') is_quoted = !is_quoted;
      if (at < text.size() && (text[at] != separator || is_quoted)) continue;
      if (out.size() == kMostColumns)
        refuse_file(file_, fmt::format("has in {} more than {} columns", where, kMostColumns), "Leave out columns.");
      out.emplace_back(trimmed(text.substr(begin, at - begin)));
      begin = at + 1;
    }
    return out;
  }

  // A number of up to 1e100 in size. Between commas it has a decimal point; elsewhere a comma is a decimal sign, too.
  [[nodiscard]] std::optional<double> number_of(std::string cell) const {
    if (separator_ != ',' && std::ranges::count(cell, ',') == 1 && cell.find('.') == std::string::npos)
      std::ranges::replace(cell, ',', '.');
    if (cell.starts_with('+')) cell.erase(0, 1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    constexpr double kGreatest = 1e100;
    if (error != std::errc() || end != cell.data() + cell.size() || !(std::abs(value) <= kGreatest))
      return std::nullopt;
    return value;
  }

  [[nodiscard]] bool has_number(const std::vector<std::string>& cells) const {
    return std::ranges::any_of(cells, [this](const std::string& cell) { return number_of(cell).has_value(); });
  }

  [[nodiscard]] double value_of(const TestLine& line, const std::vector<std::string>& cells, std::size_t column) {
    constexpr const char* kFix = "Correct the line, or begin it with # to leave it out.";
    if (column >= cells.size())
      refuse_file(file_, fmt::format("has in line {} only {} columns", line.number, cells.size()), kFix);
    const std::string& cell = cells[column];
    const auto value = number_of(cell);
    if (!value) {
      refuse_file(file_,
                  fmt::format("has in line {}, column {} no number: \"{}\"", line.number, column + 1, shortened(cell)),
                  kFix);
    }
    has_point_ = has_point_ || cell.find('.') != std::string::npos;
    has_comma_ = has_comma_ || cell.find(',') != std::string::npos;
    if (has_point_ && has_comma_) {
      refuse_file(file_, fmt::format("has decimal points and commas, as in line {}: \"{}\"", line.number, cell),
                  "Write one decimal sign, and nothing between thousands.");
    }
    return *value;
  }

  std::vector<TestLine> lines;

 private:
  const std::string& file_;
  char separator_ = ',';
  bool has_point_ = false;
  bool has_comma_ = false;
};

// Where the columns of a test are.
struct TestLayout {
  std::size_t along = 0;   ///< of strain or displacement
  std::size_t across = 0;  ///< of stress or force
  std::vector<TestColumn> columns;
};

std::string list_of(const std::vector<std::string>& titles) {
  constexpr std::size_t kShown = 6;
  std::string out;
  for (std::size_t i = 0; i < std::min(titles.size(), kShown); ++i)
    out += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", shortened(titles[i]));
  return out + (titles.size() > kShown ? ", ..." : "");
}

TestLayout layout_of(const std::vector<std::string>& titles, const std::vector<TestColumn>& columns,
                     const std::string& file) {
  TestLayout out;
  out.columns = columns;
  const auto find = [&](TestQuantity one, TestQuantity other) {
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].quantity != one && columns[i].quantity != other) continue;
      if (found) {
        refuse_file(
            file,
            fmt::format("has in columns {} and {} both {} or {}", *found + 1, i + 1, name_of(one), name_of(other)),
            kRemedy);
      }
      found = i;
    }
    if (!found) {
      refuse_file(file,
                  fmt::format("has no column that is {} or {} with a unit ({}); its columns are {}", name_of(one),
                              name_of(other), kKnownUnits, list_of(titles)),
                  kRemedy);
    }
    return *found;
  };
  out.along = find(TestQuantity::strain, TestQuantity::displacement);
  out.across = find(TestQuantity::stress, TestQuantity::force);
  return out;
}

// Whether most of a curve is negative, as compression may be.
bool is_negative(const std::vector<double>& values) {
  const auto [least, greatest] = std::ranges::minmax_element(values);
  return -*least > *greatest;
}

void turn(std::vector<double>& values) {
  for (double& value : values) value = -value;
}

}  // namespace

double LoadCurve::at(double at) const {
  const auto next = std::ranges::upper_bound(x, at);
  if (next == x.end()) return y.back();
  const auto i = static_cast<std::size_t>(next - x.begin());
  if (i == 0) return y.front();
  const double share = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return y[i - 1] + share * (y[i] - y[i - 1]);
}

void LoadCurve::add(double at, double value) {
  if (!std::isfinite(at + value) || (!x.empty() && at <= x.back())) return;
  x.push_back(at);
  y.push_back(value);
}

Measurement read_measurement(const std::string& text, const std::string& file, const std::string& columns,
                             const std::optional<Specimen>& specimen) {
  TestText test(text, file);
  auto data = test.lines.begin();
  std::vector<std::string> cells = test.cells_of(*data);
  std::vector<std::string> titles;
  if (!test.has_number(cells)) {
    titles = std::move(cells);
    cells = ++data == test.lines.end() ? std::vector<std::string>() : test.cells_of(*data);
  }
  std::vector<TestColumn> found;
  for (const auto& title : titles) found.push_back(column_of(title));
  // Testing machines write a row of units below the titles.
  if (data != test.lines.end() && !titles.empty() && !test.has_number(cells)) {
    for (std::size_t i = 0; i < std::min(found.size(), cells.size()); ++i) {
      if (const TestUnit* unit = unit_in(cells[i])) found[i] = {unit->quantity, unit->factor};
    }
    ++data;
  }
  if (!columns.empty()) {
    titles = test.split(columns, ',', "columns");
    found.clear();
    for (const auto& title : titles) {
      found.push_back(title == "-" ? TestColumn() : column_of(title));
      if (title != "-" && found.back().quantity == TestQuantity::none)
        throw InvalidField("columns",
                           fmt::format("has \"{}\" without a unit that is known ({}).", shortened(title), kKnownUnits),
                           kRemedy);
    }
  }
  if (titles.empty()) refuse_file(file, "has no header", kRemedy);
  const TestLayout layout = layout_of(titles, found, file);
  const bool is_displacement = layout.columns[layout.along].quantity == TestQuantity::displacement;
  const bool is_force = layout.columns[layout.across].quantity == TestQuantity::force;
  if (!specimen && (!is_displacement || !is_force))
    refuse_file(file, "has strain or stress, not displacement and force",
                "With force_part, name the columns of displacement and force.");
  const double length = specimen && is_displacement ? specimen->length_mm : 1.0;
  const double area = specimen && is_force ? specimen->area_mm2 : 1.0;
  std::vector<double> along;
  std::vector<double> across;
  for (; data != test.lines.end(); ++data) {
    cells = test.cells_of(*data);
    along.push_back(test.value_of(*data, cells, layout.along) * layout.columns[layout.along].factor / length);
    across.push_back(test.value_of(*data, cells, layout.across) * layout.columns[layout.across].factor / area);
  }
  if (along.size() < 3)
    refuse_file(file, fmt::format("has {} rows of numbers", along.size()), "Give at least three rows of numbers.");
  // Of a force over a displacement that is turned, the force is turned as well.
  const bool is_turned = is_negative(along);
  if (is_turned) turn(along);
  if ((specimen || is_turned) && is_negative(across)) turn(across);
  Measurement out{file, {}};
  for (std::size_t i = 0; i < along.size(); ++i) out.curve.add(along[i], across[i]);
  if (out.curve.x.size() < 3)
    refuse_file(file, "does not get further after its first rows", "Give the loading, not the unloading.");
  constexpr double kMost = 2.0;
  if (specimen && out.curve.x.back() > kMost) {
    refuse_file(file, fmt::format("reaches a strain of {:.3g}", out.curve.x.back()),
                is_displacement
                    ? "Compare with a job whose specimen is as long as that of the test, or name the unit of "
                      "the displacement."
                    : "Its unit may be %: name the columns as in \"strain %, stress MPa\".");
  }
  return out;
}

}  // namespace cellcrush::compare
