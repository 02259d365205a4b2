#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "store/page_room.h"

namespace cellcrush::rpc {

/// Limit of a page, below a client's limit of 4 MiB.
inline constexpr std::size_t kPageBytes = 3'000'000;

/// The requested part of a list. Resources are numbered in order of creation. A page starts after the number in its
/// token, so that creations and deletions in between do not shift pages.
struct Page {
  int size = 0;
  std::int64_t after = 0;  ///< last number of the previous page; 0 for the first page

  [[nodiscard]] store::PageRoom room() const { return {size, kPageBytes}; }
};

/// Reads page_size (0: 50; more than 1000 is 1000) and page_token. `question` identifies the list, with the same text
/// for all its pages. Throws InvalidField for a negative size, and for a token that is malformed or belongs to another
/// list.
Page read_page(int page_size, const std::string& page_token, const std::string& question);

/// The same for small, numerous entries: page_size 0 means as many as fit in kPageBytes.
Page read_full_page(int page_size, const std::string& page_token, const std::string& question);

/// Token of the page after the resource with this number.
std::string page_token(std::int64_t last, const std::string& question);

}  // namespace cellcrush::rpc
