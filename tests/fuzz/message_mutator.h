#pragma once

#include <google/protobuf/message.h>

#include <random>

namespace cellcrush::fuzz {

/// Changes one field somewhere in the message: sets, clears, adds, removes or repeats it. Strings stay ASCII, since
/// what is no UTF-8 is refused before the daemon sees it. What bytes alone may do to a message is left to libFuzzer.
void mutate(google::protobuf::Message& message, std::mt19937& random);

}  // namespace cellcrush::fuzz
