#pragma once

#include <gmock/gmock.h>

#include <string>

#include "error.h"

namespace cellcrush::testing {

/// A call that throws a ServiceError of this kind, with these words in its message.
MATCHER_P2(Refuses, kind, words, "") {
  try {
    arg();
  } catch (const ServiceError& error) {
    *result_listener << error.what();
    return error.kind() == kind && std::string(error.what()).find(words) != std::string::npos;
  }
  return false;
}

}  // namespace cellcrush::testing
