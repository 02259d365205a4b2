#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "store/page_room.h"

namespace cellcrush::rpc {

/// A page ends early rather than pass a client's limit of 4 MiB.
inline constexpr std::size_t kPageBytes = 3'000'000;

/// Which part of a list is wanted. Resources are numbered as they are made, and a page goes on behind the number that
/// its token names, so that what is made or deleted meanwhile moves no page.
struct Page {
  int size = 0;
  std::int64_t after = 0;  ///< number of the last resource of the page before; 0 on the first page

  [[nodiscard]] store::PageRoom room() const { return {size, kPageBytes}; }
};

/// Reads page_size (0: 50; more than 1000 is 1000) and page_token. `question` is what the list is of, in any form that
/// is the same for all its pages. Throws InvalidField: a negative size, or a token that is none or is of another list.
Page read_page(int page_size, const std::string& page_token, const std::string& question);

/// The same of entries that are small and many: page_size 0 is as many as fit in kPageBytes.
Page read_full_page(int page_size, const std::string& page_token, const std::string& question);

/// Token of the page behind the resource with that number.
std::string page_token(std::int64_t last, const std::string& question);

}  // namespace cellcrush::rpc
