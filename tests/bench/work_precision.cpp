// Time against accuracy of the choices that a crush has. `run` appends a row a crush to a table and leaves out what
// stands there already, so that it can be stopped and resumed, and two can share the work; `chart` draws a scene of the
// table, `overview` its support plateau alone.
//   work_precision run tests/bench/work_precision.txt table.csv [part=1/2] [scene=NAME]
//   work_precision chart tests/bench/work_precision.txt table.csv picture.svg scene=NAME converged=GROUP:LABEL
//   work_precision overview tests/bench/work_precision.txt table.csv picture.svg scene=NAME title=WORDS

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>

#include "bench/precision.h"
#include "bench/precision_chart.h"
#include "validation/crush_run.h"
#include "validation/crush_table.h"
#include "validation/options.h"
#include "validation/provenance.h"

namespace cellcrush::bench {
namespace {

/// Words of the form name=value behind the files.
class Settings {
 public:
  Settings(const std::vector<std::string>& words, std::map<std::string, std::string> defaults)
      : values_(std::move(defaults)) {
    for (const std::string& word : words) {
      const std::size_t equals = word.find('=');
      const std::string name = word.substr(0, equals);
      if (equals == std::string::npos || !values_.contains(name)) {
        throw std::invalid_argument(word + ": is no setting here; see the usage.");
      }
      values_[name] = word.substr(equals + 1);
    }
  }
  [[nodiscard]] const std::string& operator[](const std::string& name) const { return values_.at(name); }

 private:
  std::map<std::string, std::string> values_;
};

struct Crush {
  const VariedScene* scene;
  const Variant* variant;
  int seed;
};

/// The crushes of a part: every so many-th one, so that parts are alike. Seeds come last, so that a list that is cut
/// short has whole variants of few seeds rather than few variants.
std::vector<Crush> crushes_of(const std::vector<VariedScene>& scenes, const Settings& settings) {
  int part = 0;
  int parts = 0;
  if (std::sscanf(settings["part"].c_str(), "%d/%d", &part, &parts) != 2 || part < 1 || part > parts) {
    throw std::invalid_argument("part=" + settings["part"] + ": is no part; give one such as part=1/2.");
  }
  int seeds = 0;
  for (const VariedScene& scene : scenes) {
    for (const Variant& variant : scene.variants) seeds = std::max(seeds, variant.seeds);
  }
  std::vector<Crush> crushes;
  int count = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    for (const VariedScene& scene : scenes) {
      if (!settings["scene"].empty() && settings["scene"] != scene.name) continue;
      for (const Variant& variant : scene.variants) {
        if (seed > variant.seeds) continue;
        if (count++ % parts == part - 1) crushes.push_back({&scene, &variant, seed});
      }
    }
  }
  return crushes;
}

bool is_done(const Crush& crush, const std::string& table) {
  const std::vector<CsvRow> rows = read_csv(table);
  return std::any_of(rows.begin(), rows.end(), [&](const CsvRow& row) {
    return row.at("seed") == std::to_string(crush.seed) && is_of(row, *crush.scene, *crush.variant);
  });
}

void run(const std::vector<VariedScene>& scenes, const std::string& table, const Settings& settings) {
  const std::vector<Crush> crushes = crushes_of(scenes, settings);
  for (std::size_t i = 0; i < crushes.size(); ++i) {
    const auto& [scene, variant, seed] = crushes[i];
    std::cout << i + 1 << " of " << crushes.size() << ": " << scene->name << " " << variant->name << " seed " << seed
              << std::flush;
    if (is_done(crushes[i], table)) {
      std::cout << ", done already\n";
      continue;
    }
    const validation::Options options = validation::read_options(words_of(*scene, *variant, seed));
    const validation::CrushRun crush = validation::run_crush(options.spec);
    validation::Cells cells = {{"scene", scene->name},
                               {"variant", variant->name},
                               {"seed", std::to_string(seed)},
                               {"processor_seconds", std::to_string(crush.processor_seconds)},
                               {"elements", std::to_string(crush.facts.element_count)}};
    const validation::Cells origin = validation::origin_of_a_run();
    cells.insert(cells.end(), origin.begin(), origin.end());
    validation::append_row(table, options, crush, cells);
    std::cout << ", " << crush.processor_seconds << " s\n";
  }
}

const VariedScene& scene_in(const std::vector<VariedScene>& scenes, const Settings& settings) {
  const auto scene = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const VariedScene& found) { return found.name == settings["scene"]; });
  if (scene == scenes.end()) throw std::invalid_argument("scene=" + settings["scene"] + ": is not in the list.");
  return *scene;
}

void chart(const std::vector<VariedScene>& scenes, const std::string& table, const std::string& picture,
           const Settings& settings) {
  const VariedScene& scene = scene_in(scenes, settings);
  const std::vector<CsvRow> rows = read_csv(table);
  for (const Measure& measure : kMeasures) {
    double scatter = 0.0;
    std::printf("%s\n", measure.title.c_str());
    for (const Precision& found : precisions(scene, rows, measure, settings["converged"], scatter)) {
      std::printf("  %-28s %9.3f s  error %8.4f +- %.4f, %d seeds%s\n", found.variant.c_str(), found.seconds,
                  found.error, found.uncertainty, found.seeds, found.on_front ? ", front" : "");
    }
    std::printf("  one converged crush scatters by %.4f\n", scatter);
  }
  draw_precisions(picture, scene, rows, settings["converged"]);
}

void obey(const std::vector<std::string>& words) {
  const bool runs = words.size() >= 3 && words[0] == "run";
  const bool draws = words.size() >= 4 && (words[0] == "chart" || words[0] == "overview");
  if (!runs && !draws) throw std::invalid_argument("work_precision: say what to do.");
  const std::vector<VariedScene> scenes = read_variants(words[1]);
  if (runs) {
    run(scenes, words[2], Settings({words.begin() + 3, words.end()}, {{"part", "1/1"}, {"scene", ""}}));
  } else {
    const Settings settings({words.begin() + 4, words.end()},
                            {{"scene", ""}, {"converged", kConverged}, {"title", ""}});
    if (words[0] == "chart") {
      chart(scenes, words[2], words[3], settings);
    } else {
      draw_overview(words[3], scene_in(scenes, settings), read_csv(words[2]), settings["converged"], settings["title"]);
    }
  }
}

}  // namespace
}  // namespace cellcrush::bench

int main(int count, char** words) {
  try {
    cellcrush::bench::obey({words + 1, words + count});
    return 0;
  } catch (const std::exception& error) {
    std::cerr
        << error.what()
        << "\nwork_precision run LIST TABLE.csv [part=1/1] [scene=NAME]"
           "\nwork_precision chart LIST TABLE.csv PICTURE.svg scene=NAME [converged=GROUP:LABEL]"
           "\nwork_precision overview LIST TABLE.csv PICTURE.svg scene=NAME [converged=GROUP:LABEL] [title=WORDS]\n";
    return 2;
  }
}
