#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "scenes/crushes.h"

namespace cellcrush::bench {

/// States of crushes at the strains at which they are timed. Each crush runs once, by the best kernel, when first asked
/// for; with a folder its states are kept there for the next time that this same build runs.
class CrushedStates {
 public:
  explicit CrushedStates(std::filesystem::path folder) : folder_(std::move(folder)) {}

  struct Crushed {
    std::shared_ptr<const Scene> scene;
    State state;
  };
  /// REQUIRES: `strain` is one of the crush's.
  const Crushed& at(const scenes::Crush& crush, double strain);

 private:
  void run(const scenes::Crush& crush);

  std::filesystem::path folder_;  ///< empty: nothing is kept
  std::map<std::string, std::map<double, Crushed>> crushed_;
};

}  // namespace cellcrush::bench
