#pragma once

#include <string>
#include <string_view>

namespace cellcrush::web {

/// A file of the web page, compiled into the daemon from server/page/bundle.
struct PageFile {
  std::string_view name;
  std::string_view bytes;
};

/// The file for the path of a URL; null if there is none. The paths of the page's views (page/src/main.ts) give
/// index.html, because the page reads the path itself.
const PageFile* find_page_file(std::string_view path);

/// The start page, index.html, whose links lead to files in `root`, such as "../": a path relative to its own address.
bool is_start(const PageFile& file);
std::string start_below(const PageFile& file, const std::string& root);

/// The file in gzip form, made at the first call; empty if that would not be smaller. `file` is of find_page_file. Not
/// thread-safe.
std::string_view gzip_of(const PageFile& file);

/// Whether an Accept-Encoding header permits gzip.
bool accepts_gzip(std::string_view accept_encoding);

/// By the ending of its name.
const char* content_type_of_file(std::string_view name);

/// A quoted tag that changes with the contents.
std::string entity_tag(std::string_view bytes);

}  // namespace cellcrush::web
