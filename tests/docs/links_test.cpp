// Links between the pages hold, and none is wider than an editor.
#include "docs/links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cellcrush::docs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Pages, EveryLinkHolds) {
  const std::vector<Page> pages = read_pages(CELLCRUSH_SOURCE_ROOT);
  std::size_t links = 0;
  for (const Page& page : pages) links += page.links.size();
  EXPECT_GT(pages.size(), 20U);
  EXPECT_GT(links, 100U);
  const Findings findings = check_links(CELLCRUSH_SOURCE_ROOT, pages);
  EXPECT_TRUE(findings.empty()) << to_text(findings);
}

// Whoever opens a folder finds a page, and from the first page every other one is reached.
TEST(Pages, EveryPageIsReachedFromTheReadme) {
  const std::vector<Page> pages = read_pages(CELLCRUSH_SOURCE_ROOT);
  std::vector<std::string> reached{"README.md"};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const Page& page : pages) {
      if (page.path != reached[next]) continue;
      for (const Link& link : page.links) {
        const std::filesystem::path folder = std::filesystem::path(page.path).parent_path();
        std::string target =
            (folder / link.target.substr(0, link.target.find('#'))).lexically_normal().generic_string();
        if (std::filesystem::is_directory(std::filesystem::path(CELLCRUSH_SOURCE_ROOT) / target)) {
          target = (std::filesystem::path(target) / "README.md").lexically_normal().generic_string();
        }
        if (std::ranges::find(reached, target) == reached.end()) reached.push_back(target);
      }
    }
  }
  for (const Page& page : pages) {
    EXPECT_NE(std::ranges::find(reached, page.path), reached.end()) << page.path << " is linked from no page";
  }
}

TEST(Pages, ABrokenLinkIsFound) {
  const Page page = parse_page("core/page.md",
                               "# A page\n\n[a](README.md), [b](gone.md), [c](#a-page), [d](#b-page)\n"
                               "![e](../tests/gone.svg) `[f](gone.md)` [g](https://example.org/gone)\n"
                               "```sh\n[h](gone.md)\n```\n<!-- [i](gone.md) -->\n");
  const Page readme = parse_page("core/README.md", "# Core\n");
  EXPECT_THAT(check_links(CELLCRUSH_SOURCE_ROOT, {page, readme}),
              ElementsAre("core/page.md:3: gone.md: no such file", "core/page.md:3: #b-page: no such heading",
                          "core/page.md:4: ../tests/gone.svg: no such file"));
}

TEST(Pages, AWideLineIsFound) {
  const std::string wide(121, 'x');
  const Page page = parse_page("core/page.md", wide + "\n\n| " + wide + " |\n\n```\n" + wide + "\n```\n");
  EXPECT_THAT(check_links(CELLCRUSH_SOURCE_ROOT, {page}), ElementsAre(HasSubstr("core/page.md:1: more than 120")));
}

TEST(Pages, WhatAFormatterOfCodeHasTornIsFound) {
  const Page page = parse_page("core/page.md", "#Page\n\n| a | b |\n|---|---|\n| c | d;\ne |\n```\n#include\n```\n");
  EXPECT_THAT(check_links(CELLCRUSH_SOURCE_ROOT, {page}),
              ElementsAre(HasSubstr("core/page.md:1: a heading"), HasSubstr("core/page.md:5: a heading")));
}

TEST(Pages, HeadingsAreNamedAsOnGitHub) {
  const Page page = parse_page("page.md", "# What it's for: `a_b` & c\n## Twice\n## Twice\n");
  EXPECT_THAT(page.anchors, ElementsAre("what-its-for-a_b--c", "twice", "twice-1"));
}

}  // namespace
}  // namespace cellcrush::docs
