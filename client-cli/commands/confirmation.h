#pragma once

#include <functional>
#include <string>

namespace cellcrush::client {

/// Whether the user agrees to what `question` asks: "y" or "yes". It is asked on stderr when stdin and stderr are
/// terminals; without, as in a script, the answer is yes and the question is not made.
bool confirm(const std::function<std::string()>& question);

}  // namespace cellcrush::client
