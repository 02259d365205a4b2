#include "net/heap_trim.h"

#include <malloc.h>

#include <algorithm>

namespace cellcrush::net {
namespace {

constexpr std::size_t kLarge = 100;

}  // namespace

bool HeapTrim::note(std::size_t open) {
  most_ = std::max(most_, open);
  if (most_ < kLarge || open > most_ / 2) return false;
  most_ = open;
  malloc_trim(0);
  return true;
}

}  // namespace cellcrush::net
