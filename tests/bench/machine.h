#pragma once

#include <string>

namespace cellcrush::bench {

/// Name of the processor, as the kernel tells it, without commas; "unknown" where it does not.
std::string processor_name();

/// Today, as 2001-12-31.
std::string today();

/// Processor time that this process has taken so far, s.
double processor_seconds();

/// Memory of this process: what it holds now, and the most that it held since its start. Bytes, of pages that are in
/// memory.
double resident_bytes();
double greatest_resident_bytes();

/// A text that is another one for every other build of this program.
std::string build_name();

}  // namespace cellcrush::bench
