// Any bytes as a case file: read as the command line reads them, then checked as the daemon checks them. Nothing may
// crash or hang, and every refusal names its field, what is wrong and what to do.
#include <cstdint>
#include <string>

#include "case_file/case_source.h"
#include "command_error.h"
#include "fuzz/size_bound.h"
#include "translate/check_case.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cellcrush;
  const std::string text(reinterpret_cast<const char*>(data), size);
  v1::Case given;
  try {
    const bool json = !text.empty() && text.front() == '{';
    given = json ? client::parse_json_case(text, "fuzz") : client::parse_text_case(text, "fuzz");
  } catch (const client::CommandError&) {
    return 0;
  }
  constexpr double kMostElements = 20000.0;
  if (!fuzz::is_large(given, kMostElements)) fuzz::require_complete(translate::check_case(given).response.problems());
  return 0;
}
