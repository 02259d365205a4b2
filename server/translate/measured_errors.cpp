#include "translate/measured_errors.h"

#include <google/protobuf/util/field_comparator.h>
#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "cellcrush/fidelity.h"
#include "cellcrush/lattice_words.h"
#include "cellcrush/sample.h"
#include "translate/case_to_spec.h"
#include "translate/embedded_rows.h"
#include "translate/presets.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

/// Error of one quantity of a preset, or of some of its cells, at one plate speed: a row of measured_errors.csv.
struct MeasuredRow {
  std::string preset;
  std::string quantity;
  std::string speed;  ///< m/s, as written
  double speed_m_per_s = 0.0;
  int elements_per_wall = 0;
  double error = 0.0;
  double uncertainty = 0.0;
  double scatter = 0.0;
  int columns = 0;  ///< cells of the specimen; 0: those of the preset
  int rows = 0;
  LoadingSpec::Direction direction = LoadingSpec::Direction::x;
};

MeasuredRow read_measured_row(Cells& cells) {
  MeasuredRow row;
  row.preset = cells.text();
  row.quantity = cells.text();
  row.speed = cells.text();
  row.speed_m_per_s = std::stod(row.speed);
  row.elements_per_wall = cells.count();
  row.error = cells.number();
  row.uncertainty = cells.number();
  row.scatter = cells.number();
  row.columns = cells.count();
  row.rows = cells.count();
  row.direction = cells.text() == "y" ? LoadingSpec::Direction::y : LoadingSpec::Direction::x;
  return row;
}

const std::vector<MeasuredRow>& measured_rows() {
  static const std::vector<MeasuredRow> kRows = rows_of(measured_errors_text(), read_measured_row);
  return kRows;
}

/// What a spec shares with the preset that was measured is equal up to rounding.
constexpr double kRounding = 0.01;

bool is_near(double one, double other) {
  return std::abs(one - other) <= kRounding * std::max(std::abs(one), std::abs(other));
}

/// Whether the numbers that only their kind has are alike, lengths over the thickness of the walls.
bool has_near_own_numbers(const RegularLattice& one, const RegularLattice& other) {
  const auto numbers = with_own_numbers(one).own;
  auto others = with_own_numbers(other).own;
  return std::ranges::all_of(numbers, [&](const auto& own) {
    const bool is_length = own.first.ends_with("_mm");
    return is_near(own.second / (is_length ? *one.wall_thickness_mm : 1.0),
                   others[own.first] / (is_length ? *other.wall_thickness_mm : 1.0));
  });
}

/// A preset, or that many of its cells, and the direction of its crush.
struct Specimen {
  std::string preset;
  int columns;
  int rows;
  LoadingSpec::Direction direction;

  bool operator==(const Specimen&) const = default;
};

bool is_smaller_than_preset(const Specimen& specimen) { return specimen.columns > 0; }

Specimen specimen_of(const MeasuredRow& row) { return {row.preset, row.columns, row.rows, row.direction}; }

/// Lowest and highest speed at which a specimen was measured.
std::pair<double, double> speeds_of(const Specimen& specimen) {
  std::pair<double, double> range = {HUGE_VAL, 0.0};
  for (const MeasuredRow& row : measured_rows()) {
    if (specimen_of(row) != specimen) continue;
    range = {std::min(range.first, row.speed_m_per_s), std::max(range.second, row.speed_m_per_s)};
  }
  return range;
}

/// Greatest amplitude of the imperfection over the side of the cells with which the errors were measured: 0.01 mm.
constexpr double kMeasuredAmplitude = 0.0025;

// Fields in which a measured case may differ: what names, divides or stores a crush; and fields that are compared
// otherwise below. Any other field, also a new one, keeps the errors from holding.
constexpr std::string_view kFreeFields[] = {
    "title",
    "depth_mm",
    "elements_per_wall",
    "output",
    "numerics.fidelity",
    "numerics.threads",
    "numerics.fibre_precision",
    "numerics.rigid_link_slenderness",  // of frames
    "contact.search",
    "lattice",
    "lattice.imperfection.seed",
    "section.axial_points",
    "section.depth_points",
    "loading.speed_m_per_s",
    "loading.quasi_static",
    "loading.kinetic_share",
    "loading.direction",
    "loading.end_strain",
};

/// Collects the paths of the fields in which two cases differ.
class FieldCollector : public google::protobuf::util::MessageDifferencer::Reporter {
 public:
  using Path = std::vector<google::protobuf::util::MessageDifferencer::SpecificField>;
  using Message = google::protobuf::Message;

  void ReportAdded(const Message&, const Message&, const Path& path) override { add(path); }
  void ReportDeleted(const Message&, const Message&, const Path& path) override { add(path); }
  void ReportModified(const Message&, const Message&, const Path& path) override {
    const auto& field = *path.back().field;
    const bool has_fields = field.message_type() != nullptr && !field.is_repeated();  // which are reported themselves
    if (!has_fields) add(path);
  }

  std::vector<std::string> fields;

 private:
  void add(const Path& path) {
    std::string field;
    for (const auto& part : path) {
      field += (field.empty() ? "" : ".") + part.field->name();
      if (part.field->is_repeated() || std::ranges::find(kFreeFields, field) != std::end(kFreeFields)) break;
    }
    const bool is_known = std::ranges::find(fields, field) != fields.end();
    if (!is_known && std::ranges::find(kFreeFields, field) == std::end(kFreeFields)) fields.push_back(field);
  }
};

/// Fields other than the free ones in which two specs differ by more than rounding.
std::vector<std::string> other_fields(const SceneSpec& spec, const SceneSpec& measured) {
  FieldCollector collector;
  google::protobuf::util::DefaultFieldComparator comparator;
  comparator.set_float_comparison(google::protobuf::util::DefaultFieldComparator::APPROXIMATE);
  comparator.SetDefaultFractionAndMargin(kRounding, 0.0);
  google::protobuf::util::MessageDifferencer differencer;
  differencer.set_field_comparator(&comparator);
  differencer.ReportDifferencesTo(&collector);
  differencer.Compare(to_case(measured), to_case(spec));
  const bool hardens = spec.material.hardens() || measured.material.hardens();
  const bool uses_poisson =
      spec.material.plane == MaterialSpec::Plane::strain || spec.section.shear_deformation;
  std::erase_if(collector.fields, [&](const std::string& field) {
    return (!hardens && field == "material.isotropic_fraction") ||
           (!uses_poisson && field == "material.poissons_ratio");
  });
  return collector.fields;
}

/// Nothing if they are different lattices.
std::optional<std::vector<std::string>> fields_beside(const Specimen& specimen, const SceneSpec& spec) {
  SceneSpec measured = find_preset(specimen.preset)->spec;
  measured.section = {};  // all were measured with the default elements
  const auto* cells = std::get_if<RegularLattice>(&spec.lattice);
  if (spec.changes != LatticeChanges()) return std::nullopt;
  const auto& its = std::get<RegularLattice>(measured.lattice);
  if (cells == nullptr || cells->kind != its.kind) return std::nullopt;
  std::vector<std::string> fields;
  const auto add_if = [&fields](bool differs, const std::string& field) {
    if (differs) fields.push_back(field);
  };
  const std::string lattice = "lattice." + cells->kind + ".";
  const bool is_smaller = is_smaller_than_preset(specimen);
  add_if(*cells->columns < (is_smaller ? specimen.columns : *its.columns), lattice + "columns");
  add_if(*cells->rows < (is_smaller ? specimen.rows : *its.rows), lattice + "rows");
  add_if(!is_near(*cells->wall_thickness_mm / *cells->side_mm, *its.wall_thickness_mm / *its.side_mm) ||
             !has_near_own_numbers(*cells, its),
         lattice + "wall_thickness_mm");
  add_if(!spec.inclusions.rows.empty(), "lattice.inclusions");
  add_if(spec.imperfection.amplitude_mm > (1.0 + kRounding) * kMeasuredAmplitude * *cells->side_mm,
         "lattice.imperfection.amplitude_mm");
  add_if(spec.imperfection.bow_mm != measured.imperfection.bow_mm, "lattice.imperfection.bow_mm");
  add_if(spec.section.axial_count() != measured.section.axial_count(), "section.axial_points");
  add_if(spec.section.depth_count() != measured.section.depth_count(), "section.depth_points");
  add_if(spec.loading.direction != specimen.direction, "loading.direction");
  const auto [lowest, highest] = speeds_of(specimen);
  const double speed = spec.loading.speed_m_per_s.value_or(0.0);
  add_if(speed < lowest || speed > highest,
         spec.loading.quasi_static ? "loading.quasi_static" : "loading.speed_m_per_s");
  add_if(spec.loading.end_strain.value_or(1.0) < Summary::kPlateauHigh, "loading.end_strain");
  std::ranges::copy(other_fields(spec, measured), std::back_inserter(fields));
  return fields;
}

std::vector<Specimen> measured_specimens() {
  std::vector<Specimen> specimens;
  for (const MeasuredRow& row : measured_rows()) {
    if (std::ranges::find(specimens, specimen_of(row)) == specimens.end()) specimens.push_back(specimen_of(row));
  }
  return specimens;
}

/// The rows of one quantity with one mesh whose speeds are next to that of a crush.
std::vector<MeasuredRow> neighbours(const Specimen& specimen, std::string_view quantity, int elements, double speed) {
  std::optional<MeasuredRow> below;
  std::optional<MeasuredRow> above;
  for (const MeasuredRow& row : measured_rows()) {
    if (specimen_of(row) != specimen || row.quantity != quantity || row.elements_per_wall != elements) continue;
    if (row.speed_m_per_s <= speed && (!below || row.speed_m_per_s > below->speed_m_per_s)) below = row;
    if (row.speed_m_per_s >= speed && (!above || row.speed_m_per_s < above->speed_m_per_s)) above = row;
  }
  if (!below || !above) return {};
  return below->speed_m_per_s == above->speed_m_per_s ? std::vector{*below} : std::vector{*below, *above};
}

std::string words_of(const std::vector<MeasuredRow>& rows) {
  const Specimen specimen = specimen_of(rows.front());
  std::string words = rows.front().quantity + ", ";
  if (is_smaller_than_preset(specimen)) {
    words += std::to_string(specimen.columns) + " x " + std::to_string(specimen.rows) + " cells of ";
  }
  words += specimen.preset;
  if (specimen.direction != find_preset(specimen.preset)->spec.loading.direction) {
    words += specimen.direction == LoadingSpec::Direction::y ? " along y" : " along x";
  }
  words += ", ";
  if (rows.size() > 1) words += rows.front().speed + " to ";
  return words + rows.back().speed + " m/s";
}

void write_errors(const SceneSpec& spec, v1::FidelityForecast& out) {
  const std::vector<std::string> beside = fields_beside_measured(spec);
  out.mutable_given_fields()->Assign(beside.begin(), beside.end());
  if (!beside.empty()) return;
  for (const MeasuredError& measured : measured_errors_of(spec, out.elements_per_wall())) {
    auto& error = *out.add_errors();
    error.set_measure(measured.measure);
    error.set_error_relative(measured.error);
    error.set_uncertainty_relative(measured.uncertainty);
    error.set_scatter_relative(measured.scatter);
  }
}

}  // namespace

std::vector<std::string> fields_beside_measured(const SceneSpec& spec) {
  std::optional<std::vector<std::string>> fewest;
  for (const Specimen& specimen : measured_specimens()) {
    const auto fields = fields_beside(specimen, spec);
    if (fields && (!fewest || fields->size() < fewest->size())) fewest = fields;
  }
  return fewest.value_or(std::vector<std::string>{"lattice"});
}

std::vector<MeasuredError> measured_errors_of(const SceneSpec& spec, int elements_per_wall) {
  std::vector<MeasuredError> errors;
  for (const Specimen& specimen : measured_specimens()) {
    const auto fields = fields_beside(specimen, spec);
    if (!fields || !fields->empty()) continue;
    for (const std::string_view quantity : {"impact plateau", "support plateau", "limit stress"}) {
      const auto rows = neighbours(specimen, quantity, elements_per_wall, *spec.loading.speed_m_per_s);
      if (rows.empty()) continue;
      const auto worst = std::ranges::max_element(
          rows, {}, [](const MeasuredRow& row) { return std::max(row.error, row.uncertainty); });
      errors.push_back({words_of(rows), worst->error, worst->uncertainty, worst->scatter});
    }
  }
  return errors;
}

const Preset* largest_measured(const std::string& kind) {
  const auto cells_of = [](const Preset& preset) { return std::get<RegularLattice>(preset.spec.lattice); };
  const auto count_of = [&](const Preset& preset) { return *cells_of(preset).columns * *cells_of(preset).rows; };
  const Preset* largest = nullptr;
  for (const Specimen& specimen : measured_specimens()) {
    const Preset* preset = find_preset(specimen.preset);
    if (cells_of(*preset).kind != kind) continue;
    if (largest == nullptr || count_of(*preset) > count_of(*largest)) largest = preset;
  }
  return largest;
}

void add_fidelities(const v1::Case& submitted, double step_cost, CaseCheck& check) {
  v1::CheckCaseResponse& response = check.response;
  const auto asked = submitted.numerics().fidelity();
  const auto decides = asked == v1::Numerics::FIDELITY_UNSPECIFIED ? v1::Numerics::STANDARD : asked;
  const SceneSpec spec = to_spec(submitted).spec;
  if (std::holds_alternative<FrameWalls>(spec.lattice)) return;
  for (const FidelityPoint& point : fidelity_points(spec)) {
    SceneSpec tried = spec;
    tried.numerics.fidelity = point.fidelity;
    const SpecChecker::Verdict verdict = check.meshes->check(tried);
    if (!verdict.problems.empty()) continue;
    auto& forecast = *response.add_fidelities();
    forecast.set_fidelity(to_proto(point.fidelity));
    forecast.set_elements_per_wall(*fill_in_fidelity(tried).elements_per_wall);
    forecast.set_element_count(verdict.element_count);
    forecast.set_step_count(verdict.step_count);
    forecast.set_predicted_seconds(step_cost * verdict.reference_steps);
    write_errors(spec, forecast);
    if (decides == forecast.fidelity()) response.set_predicted_seconds(forecast.predicted_seconds());
  }
}

}  // namespace cellcrush::translate
