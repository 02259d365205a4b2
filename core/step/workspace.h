#pragma once

#include "contact/contact_workspace.h"

namespace cellcrush {

/// Room that the stages of a step work in, kept from step to step so that no step allocates. It belongs to no state: any step
/// of any state of the scene may use it, and none depends on what it holds.
struct Workspace {
  ContactWorkspace contact;
};

}  // namespace cellcrush
