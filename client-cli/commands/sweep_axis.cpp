#include "commands/sweep_axis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

#include "case_file/typed_number.h"
#include "columns/swept_fields.h"
#include "command_error.h"
#include "help/case_manual.h"
#include "results/field_value.h"

namespace cellcrush::client {
namespace {

constexpr std::string_view kForms =
    "expected PATH=V1,V2,..., PATH=FIRST:LAST:COUNT, PATH=FIRST:LAST:COUNT:log or PATH=seeds:N, such as "
    "loading.speed_m_per_s=50,100,200";

class AxisText {
 public:
  explicit AxisText(const std::string& text) : text_(text) {}

  v1::SweepAxis parse() const {
    const std::size_t equals = text_.find('=');
    if (equals == 0 || equals == std::string::npos) refuse(kForms);
    v1::SweepAxis axis;
    axis.set_field(text_.substr(0, equals));
    const std::string_view values = std::string_view(text_).substr(equals + 1);
    if (values.starts_with("seeds:")) {
      axis.set_seed_count(number<int>(values.substr(values.find(':') + 1)));
    } else if (values.find(':') != std::string_view::npos) {
      set_range(split(values, ':'), axis);
    } else {
      for (const auto value : split(values, ',')) axis.mutable_list()->add_values(number<double>(value));
    }
    check_field(axis.field());
    return axis;
  }

 private:
  static void check_field(const std::string& path) {
    try {
      (void)find_field_manual(path);
    } catch (const CommandError& error) {
      client::refuse(fmt::format("--over {}", error.what()));
    }
  }

  [[noreturn]] void refuse(std::string_view message) const {
    client::refuse(fmt::format("--over {}: {}", text_, message));
  }

  static std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> out;
    while (true) {
      out.push_back(text.substr(0, text.find(separator)));
      if (out.back().size() == text.size()) return out;
      text.remove_prefix(out.back().size() + 1);
    }
  }

  void set_range(const std::vector<std::string_view>& parts, v1::SweepAxis& axis) const {
    const bool logarithmic = parts.size() == 4 && parts[3] == "log";
    if (parts.size() != 3 && !logarithmic) refuse(kForms);
    auto& range = logarithmic ? *axis.mutable_logarithmic() : *axis.mutable_linear();
    range.set_first(number<double>(parts[0]));
    range.set_last(number<double>(parts[1]));
    range.set_count(number<int>(parts[2]));
  }

  template <class Number>
  Number number(std::string_view value) const {
    const TypedNumber typed = std::is_integral_v<Number> ? read_whole(value) : read_real(value);
    if (!typed.problem.empty()) {
      refuse(fmt::format("\"{}\" {}{}", value, typed.problem,
                         std::is_integral_v<Number> ? "" : "; for other values queue a sweep each, with --set"));
    }
    Number out{};
    if (!parse_plain(typed.plain, out)) refuse(fmt::format("{} is too large", value));
    return out;
  }

  const std::string& text_;
};

}  // namespace

v1::SweepAxis parse_axis(const std::string& text) { return AxisText(text).parse(); }

std::string axis_text(const v1::SweepAxis& axis) {
  const v1::SweepAxis::Range* range = axis.has_linear()        ? &axis.linear()
                                      : axis.has_logarithmic() ? &axis.logarithmic()
                                                               : nullptr;
  std::string values = fmt::format("{}", fmt::join(axis.list().values(), ", "));
  if (range != nullptr) values = fmt::format("{} to {}", range->first(), range->last());
  if (axis.has_seed_count()) values = fmt::format("1 to {}", axis.seed_count());
  const std::string unit = words_of(axis.field()).unit;
  return fmt::format("{} = {}{}{} ({} values)", axis.field(), values, unit.empty() ? "" : " ", unit,
                     count_values(axis));
}

double count_points(const v1::Sweep& sweep) {
  double points = 1.0;
  for (const v1::SweepAxis& axis : sweep.axes()) points *= count_values(axis);
  return points;
}

}  // namespace cellcrush::client
