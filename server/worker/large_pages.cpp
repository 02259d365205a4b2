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
constexpr int kCollapse = 25;  // Linux 6.1; older headers lack the name, older kernels refuse it
#endif

}  // namespace

void use_large_pages(const Simulation& simulation) {
  // The first and last page of an array also hold its neighbours, because small arrays are adjacent.
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
    // Refused if part of the page does not belong to the program; it then stays on small pages.
    static_cast<void>(madvise(const_cast<char*>(page), kLargePage, kCollapse));
  }
}

}  // namespace cellcrush::worker
