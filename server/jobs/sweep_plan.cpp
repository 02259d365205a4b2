#include "jobs/sweep_plan.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "columns/result_columns.h"
#include "error_table.h"
#include "jobs/case_field.h"
#include "jobs/sweep_points.h"
#include "store/large_lattice.h"
#include "translate/case_checker.h"
#include "translate/materials.h"

namespace cellcrush::jobs {

class JobMaker {
 public:
  JobMaker(const v1::Sweep& sweep, std::string executor)
      : sweep_(sweep), points_(expand(sweep)), executor_(std::move(executor)) {}

  [[nodiscard]] const SweepPoints& points() const { return points_; }
  /// "loading.speed_m_per_s = 50, lattice.hexagon.rows = 6".
  [[nodiscard]] std::string text(std::size_t point) const;
  /// Throws InvalidField if a value is none of its field.
  [[nodiscard]] v1::Case case_at(std::size_t point) const;
  /// REQUIRES: its case can be made.
  [[nodiscard]] v1::Job job_at(std::size_t point) const;

 private:
  const v1::Sweep& sweep_;
  const SweepPoints points_;
  const std::string executor_;
};

namespace {

constexpr std::size_t kLongestTitle = 200;                 // of a case, in bytes
constexpr std::size_t kMostCaseBytes = 256 * 1024 * 1024;  // of all cases of a sweep, as the journal keeps them
constexpr std::size_t kMostMadeBytes = std::size_t{1}
                                       << 30;  // of all cases, each of which is made, checked and written
// Checked before merging the problems, which may be numerous.
constexpr std::size_t kPointsAtOnce = 64;
// Of the sweep with the names of its jobs, each of up to this many bytes: the daemon returns both in one message, which
// a client accepts up to 4 MiB. It then has room for the other fields.
constexpr std::size_t kMostNamedBytes = 4'190'000;
constexpr std::size_t kNameBytes = 17;
constexpr std::size_t kMostLabelBytes = 16 * 1024 * 1024;  // of the labels of all its jobs

std::size_t bytes_of_labels(const v1::Sweep& sweep) {
  std::size_t out = 0;
  for (const auto& [key, value] : sweep.labels()) out += key.size() + value.size();
  return out;
}

// Whole numbers in full, others in six digits.
std::string title_text_of(double value) {
  if (value == std::floor(value)) return text_of(value);
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 6);
  return {text.data(), written.ptr};
}

std::string text_of_point(const std::vector<std::string>& fields, const std::vector<double>& values) {
  std::string out;
  for (std::size_t i = 0; i < fields.size(); ++i)
    out += (i == 0 ? "" : ", ") + fields[i] + " = " + title_text_of(values[i]);
  return out;
}

// Truncates the case's own title rather than the values.
std::string title_of(std::string title, std::string point) {
  point = cut_text(std::move(point), kLongestTitle);
  if (point.size() + 2 >= kLongestTitle) return point;
  title = cut_text(std::move(title), kLongestTitle - point.size() - 2);
  return title.empty() ? point : title + ", " + point;
}

// Size of the walls that all cases of the sweep have in common, and the journal keeps once; 0 for small ones.
std::size_t bytes_in_common(const v1::Sweep& sweep, const std::vector<std::string>& fields) {
  v1::Case without = sweep.case_();
  const auto walls = store::take_lattice_out(without);
  const auto& lattice = sweep.case_().lattice();
  const auto* kind = lattice.GetReflection()->GetOneofFieldDescriptor(lattice, lattice.GetDescriptor()->oneof_decl(0));
  const auto varies = [&](const std::string& field) { return field.starts_with("lattice." + kind->name() + "."); };
  return !walls || std::ranges::any_of(fields, varies) ? 0 : walls->size();
}

// Throws InvalidField if the sweep is too large for its points.
void check_sizes(const v1::Sweep& sweep, const SweepPoints& given) {
  const std::size_t points = given.values.size();
  if (const std::size_t bytes = sweep.ByteSizeLong(); bytes + kNameBytes * points > kMostNamedBytes) {
    throw InvalidField(
        "sweep", "has " + std::to_string(bytes) + " bytes, too many with " + std::to_string(points) + " points.",
        "Use at most " + std::to_string(kMostNamedBytes - kNameBytes * points) +
            " bytes for so many points. Lists on axes that advance together (with_previous) take 8 bytes "
            "a value, entries of `points` several times as much.");
  }
  const std::size_t whole = sweep.case_().ByteSizeLong();
  const bool is_kept = (whole - bytes_in_common(sweep, given.fields)) * points <= kMostCaseBytes;
  if (!is_kept || whole * points > kMostMadeBytes) {
    throw InvalidField("sweep", "has " + std::to_string(points) + " points, too many for a case of this size.",
                       is_kept ? "Use fewer points: all cases together may have at most 1 GiB."
                               : "Use fewer points: all cases together may have at most 256 MiB, in which walls that "
                                 "no point changes do not count.");
  }
  if (bytes_of_labels(sweep) * points > kMostLabelBytes) {
    throw InvalidField(
        "sweep.labels",
        "have " + std::to_string(bytes_of_labels(sweep)) + " bytes, too many for " + std::to_string(points) + " jobs.",
        "Use fewer or shorter labels, or fewer points: the labels of all jobs together may have at most 16 MiB.");
  }
}

constexpr const char* kDigits = "0123456789";
constexpr const char* kOfNumbers = "0123456789.e+-";

std::string without_numbers(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const auto number = std::min(text.find_first_of(kDigits, i), text.size());
    out += text.substr(i, number - i) + "#";
    i = std::min(text.find_first_not_of(kOfNumbers, number), text.size());
  }
  return out;
}

// Merges problems, or notes, that several points of a sweep share.
class PointProblems {
 public:
  // What to merge: equal problems, or also those that differ only in their numbers.
  enum class Merge : std::uint8_t { equal, but_for_numbers };

  PointProblems(std::size_t points, Merge merge) : points_(points), merge_(merge) {}

  // Adds a problem of the point at `position`; `point` describes the point.
  void add(const v1::Problem& problem, std::size_t position, const std::string& point);

  // The merged problems, in the order of their first points and with the numbers of these. The message names the first
  // point and counts the others, unless every point of the sweep has the same problem.
  [[nodiscard]] google::protobuf::RepeatedPtrField<v1::Problem> merged() const;

 private:
  struct Entry {
    v1::Problem problem;
    std::size_t first = 0;
    std::string point;
    std::size_t count = 0;
    bool is_equal = true;  // at all its points
  };

  [[nodiscard]] std::string key_of(const v1::Problem& problem) const;

  std::size_t points_;
  Merge merge_;
  std::map<std::string, std::size_t> seen_;
  std::vector<Entry> entries_;
};

void PointProblems::add(const v1::Problem& problem, std::size_t position, const std::string& point) {
  const auto [found, is_new] = seen_.try_emplace(key_of(problem), entries_.size());
  if (is_new) entries_.push_back({problem, position, point});
  Entry& entry = entries_[found->second];
  ++entry.count;
  if (merge_ == Merge::but_for_numbers && problem.SerializeAsString() != entry.problem.SerializeAsString())
    entry.is_equal = false;
}

google::protobuf::RepeatedPtrField<v1::Problem> PointProblems::merged() const {
  google::protobuf::RepeatedPtrField<v1::Problem> out;
  for (const auto& entry : entries_) {
    v1::Problem& problem = *out.Add();
    problem = entry.problem;
    if (entry.is_equal && entry.count == points_) continue;
    std::string where = " This applies to point " + std::to_string(entry.first + 1) + " of " + std::to_string(points_) +
                        " (" + entry.point + ")";
    if (entry.count > 1) where += " and to " + std::to_string(entry.count - 1) + " more";
    problem.set_message(problem.message() + where + ".");
  }
  return out;
}

std::string PointProblems::key_of(const v1::Problem& problem) const {
  if (merge_ == Merge::equal) return problem.SerializeAsString();
  return problem.field() + "\n" + without_numbers(problem.message());
}

struct CheckedPoint {
  std::string text;
  translate::CaseChecker::Verdict verdict;
};

// Checks points with several threads, each with its own checker: each thread builds one mesh for points that share it.
class PointChecker {
 public:
  PointChecker(const JobMaker& maker, const PointChecking& checking)
      : maker_(maker), checking_(checking), checkers_(static_cast<std::size_t>(checking.threads)) {}

  // The points `first` ... `end` - 1, in their order.
  std::vector<CheckedPoint> check(std::size_t first, std::size_t end) {
    std::vector<CheckedPoint> checked(end - first);
    std::atomic<std::size_t> next = first;
    const auto work = [&](translate::CaseChecker& checker) {
      for (std::size_t i = next++; i < end; i = next++) checked[i - first] = check_one(i, checker);
    };
    // If no thread is available, this thread does the work.
    constexpr auto kIfPossible = std::launch::async | std::launch::deferred;
    std::vector<std::future<void>> others;
    for (std::size_t i = 1; i < std::min(checkers_.size(), checked.size()); ++i)
      others.push_back(std::async(kIfPossible, work, std::ref(checkers_[i])));
    work(checkers_.front());
    for (auto& other : others) other.get();
    return checked;
  }

 private:
  CheckedPoint check_one(std::size_t point, translate::CaseChecker& checker) const {
    if (checking_.given_up())
      throw ServiceError(ServiceError::Kind::cancelled, "The client cancelled the call. No sweep was created.");
    CheckedPoint out{maker_.text(point), {}};
    try {
      const v1::Case made = maker_.case_at(point);
      // Large lattices of a sweep are built one after another; the sweep waits for places as long as its caller does.
      std::optional<MeshPlaces::Place> mesh;
      out.verdict = checker.check(made, [&](std::int64_t elements) {
        mesh.emplace(checking_.places, elements, checking_.given_up, std::chrono::hours(24));
      });
    } catch (const InvalidField& refused) {
      out.verdict.problems.push_back(invalid_problem(refused.field(), refused.message(), refused.remedy()));
    }
    return out;
  }

  const JobMaker& maker_;
  const PointChecking& checking_;
  std::vector<translate::CaseChecker> checkers_;
};

v1::Problem implausible(const std::string& field, const std::string& message, const std::string& remedy) {
  auto note = invalid_problem(field, message, remedy);
  note.set_kind(v1::Problem::IMPLAUSIBLE);
  return note;
}

// Axes refuse a repeated value; only listed points repeat.
std::optional<v1::Problem> repetition_note(const SweepPoints& points) {
  const auto found = find_repeated(points.values);
  if (found.count == 0) return std::nullopt;
  const std::string many = std::to_string(found.count);
  return implausible("sweep.points",
                     "have " + many + (found.count == 1 ? " entry that repeats" : " entries that repeat") +
                         " an earlier one: " + (found.count == 1 ? "" : "first ") + "point " +
                         std::to_string(found.second + 1) + " of " + std::to_string(points.values.size()) + " (" +
                         cut_text(text_of_point(points.fields, points.values[found.second]), kLongestTitle) +
                         ") equals point " + std::to_string(found.first + 1) + ".",
                     "List each point once; equal cases have equal results.");
}

// A seed places the imperfections; without any, all seeds give the same result.
std::optional<v1::Problem> idle_seed_note(const v1::Sweep& sweep, const std::vector<std::string>& fields) {
  const auto varies = [&fields](std::string_view field) { return std::ranges::find(fields, field) != fields.end(); };
  const auto& imperfection = sweep.case_().lattice().imperfection();
  const bool has_some = imperfection.amplitude_mm() > 0.0 || imperfection.bow_mm() > 0.0 ||
                        varies("lattice.imperfection.amplitude_mm") || varies("lattice.imperfection.bow_mm");
  if (has_some || !varies(kSeedField)) return std::nullopt;
  return implausible(kSeedField, "has no effect: the case has no imperfections, so all seeds give the same result.",
                     "Set lattice.imperfection.amplitude_mm or bow_mm above 0.");
}

// The default mesh follows the speed and the direction of the crush.
std::optional<v1::Problem> changed_mesh_note(const std::map<int, std::vector<std::size_t>>& points_of_mesh,
                                             const JobMaker& maker) {
  if (points_of_mesh.size() < 2) return std::nullopt;
  std::string meshes;
  for (const auto& [mesh, points] : points_of_mesh) {
    meshes += (meshes.empty() ? "" : "; ") + std::to_string(mesh) + " at " + std::to_string(points.size()) +
              (points.size() == 1 ? " point (" : " points (first: ") +
              cut_text(maker.text(points.front()), kLongestTitle) + ")";
  }
  return implausible("elements_per_wall", "is not given, and its default changes within the sweep: " + meshes + ".",
                     "Set elements_per_wall, so that all points have the same mesh.");
}

}  // namespace

std::string JobMaker::text(std::size_t point) const { return text_of_point(points_.fields, points_.values[point]); }

v1::Case JobMaker::case_at(std::size_t point) const {
  v1::Case out = sweep_.case_();
  for (std::size_t i = 0; i < points_.fields.size(); ++i)
    set_case_field(out, points_.fields[i], points_.values[point][i]);
  return out;
}

v1::Job JobMaker::job_at(std::size_t point) const {
  v1::Job out;
  *out.mutable_case_() = translate::with_named_materials(case_at(point));
  out.mutable_case_()->set_title(title_of(out.case_().title(), text(point)));
  *out.mutable_labels() = sweep_.labels();
  out.set_priority(sweep_.priority());
  out.set_time_limit_s(sweep_.time_limit_s());
  out.set_owner(sweep_.owner());
  out.set_executor(executor_);
  return out;
}

SweepPlan plan_sweep(const v1::Sweep& sweep, const PointChecking& checking) {
  SweepPlan out;
  out.maker = std::make_shared<const JobMaker>(sweep, checking.executor);
  const SweepPoints& points = out.maker->points();
  check_sizes(sweep, points);
  PointProblems problems(points.values.size(), PointProblems::Merge::equal);
  PointProblems notes(points.values.size(), PointProblems::Merge::but_for_numbers);
  std::map<int, std::vector<std::size_t>> points_of_mesh;
  PointChecker checker(*out.maker, checking);
  for (std::size_t first = 0; first < points.values.size(); first += kPointsAtOnce) {
    for (auto& point : checker.check(first, std::min(first + kPointsAtOnce, points.values.size()))) {
      const std::size_t i = out.jobs.size();
      for (const auto& problem : point.verdict.problems) problems.add(problem, i, point.text);
      for (const auto& note : point.verdict.notes) notes.add(note, i, point.text);
      if (const int mesh = point.verdict.default_mesh; mesh > 0) points_of_mesh[mesh].push_back(i);
      if (point.verdict.most_memory_bytes > out.most_memory_bytes) {
        out.most_memory_bytes = point.verdict.most_memory_bytes;
        out.largest = i;
      }
      const auto make = [maker = out.maker.get(), i] { return maker->job_at(i); };
      out.jobs.push_back({make, points.values[i], point.verdict.element_steps});
    }
  }
  malloc_trim(0);  // otherwise each thread's heap keeps the memory of its largest mesh
  out.problems = problems.merged();
  if (!out.problems.empty()) {
    out.most_memory_bytes = 0;
    return out;
  }
  out.notes = notes.merged();
  if (auto note = repetition_note(points)) *out.notes.Add() = *std::move(note);
  if (auto note = idle_seed_note(sweep, points.fields)) *out.notes.Add() = *std::move(note);
  if (auto note = changed_mesh_note(points_of_mesh, *out.maker)) *out.notes.Add() = *std::move(note);
  return out;
}

}  // namespace cellcrush::jobs
