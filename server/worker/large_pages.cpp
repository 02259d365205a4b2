#include "worker/large_pages.h"

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <set>

namespace cellcrush::worker {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21;

/// What some thousand small pages hold.
constexpr std::size_t kLeastBytes = 16'000'000;

#ifdef MADV_COLLAPSE
constexpr int kCollapse = MADV_COLLAPSE;
#else
constexpr int kCollapse = 25;  // Linux 6.1; older headers lack its name, older kernels refuse it
#endif

}  // namespace

void use_large_pages(const Simulation& simulation) {
  // An array's first and last page hold what lies beside it, too: small arrays follow each other.
  std::set<const char*> pages;
  std::size_t bytes_of_all = 0;
  simulation.visit_arrays([&](const void* first, std::size_t bytes) {
    const char* begin = static_cast<const char*>(first);
    for (const char* page = begin - reinterpret_cast<std::uintptr_t>(begin) % kLargePage; page < begin + bytes;
         page += kLargePage) {
      pages.insert(page);
    }
    bytes_of_all += bytes;
  });
  if (bytes_of_all < kLeastBytes) {
    return;
  }
  for (const char* page : pages) {
    // Refused where some of the page is not the program's: it stays on small pages then.
    static_cast<void>(madvise(const_cast<char*>(page), kLargePage, kCollapse));
  }
}

}  // namespace cellcrush::worker
