#pragma once

#include <memory>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush::scenes {

/// A chain of elements 1 mm thick, and the tip of a short beam that is moved about by hand. Contact without damping.
class Probe {
 public:
  static constexpr double kThickness = 1.0;
  /// How deep most tests press the tip in, and how far from the chain's axis it then stands.
  static constexpr double kDepth = 0.1;
  static constexpr double kDistance = kThickness - kDepth;

  /// Segment i runs from chain[i] to chain[i + 1], or backwards where `reversed` says so.
  explicit Probe(const std::vector<Vector2>& chain, double friction = 0.0, const std::vector<bool>& reversed = {});

  /// Normal force on the tip when it stands there; its beam points away along `outward`.
  Vector2 force_at(const Vector2& place, const Vector2& outward);

  /// Friction on the tip's beam after the tip has been dragged there from where it was, within one step. The beam has
  /// the velocity of the tip, and so does not turn.
  Vector2 drag_to(const Vector2& place, const Vector2& outward);

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] double stiffness() const { return scene_->contact.stiffness; }
  State& state() { return state_; }

 private:
  void place_tip(const Vector2& place, const Vector2& outward);
  void evaluate_contacts();

  std::shared_ptr<Scene> scene_;
  State state_;
  ContactWorkspace workspace_;
  Workers workers_{1};
  int tip_ = 0;
};

}  // namespace cellcrush::scenes
