#include "docs/names.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

#include "cellcrush/v1/case.pb.h"
#include "scenes/presets.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

// Calls `found` for each match in the code of a page, with its line: of blocks too when `blocks` is true.
void for_each_match(const Page& page, const std::regex& pattern, bool blocks,
                    const std::function<void(int, const std::string&)>& found) {
  const auto search = [&](int line, const std::string& text) {
    for (auto match = std::sregex_iterator(text.begin(), text.end(), pattern); match != std::sregex_iterator();
         ++match) {
      found(line, (*match)[1].str());
    }
  };
  for (const Code& code : page.inline_codes) search(code.line, code.text);
  if (!blocks) return;
  for (const Code& block : page.blocks) {
    std::istringstream lines(block.text);
    std::string line;
    for (int number = block.line; std::getline(lines, line); ++number) search(number, line);
  }
}

// Whether an entry of the folder begins with `name`.
bool has_entry_like(const fs::path& folder, const std::string& name) {
  if (!fs::is_directory(folder)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with(name)) return true;
  }
  return false;
}

bool is_field_of_case(const std::string& path) {
  const google::protobuf::Descriptor* message = v1::Case::descriptor();
  std::istringstream names(path);
  std::string name;
  while (std::getline(names, name, '.')) {
    if (message == nullptr) return false;
    name = name.substr(0, name.find('['));
    const google::protobuf::FieldDescriptor* field = message->FindFieldByName(name);
    if (field == nullptr) return false;
    message = field->message_type();
  }
  return true;
}

std::set<std::string> variables_in(const fs::path& root) {
  static const std::regex kVariable("CELLCRUSH_[A-Z][A-Z_]*");
  std::set<std::string> variables;
  for (const char* folder : {"client-cli", "server", "core", "tests", "deploy", "CMakeLists.txt"}) {
    std::vector<fs::path> files;
    if (fs::is_regular_file(root / folder)) files.push_back(root / folder);
    if (fs::is_directory(root / folder)) {
      for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
        if (entry.is_regular_file() && entry.path().extension() != ".md" && entry.file_size() < 1'000'000) {
          files.push_back(entry.path());
        }
      }
    }
    for (const fs::path& path : files) {
      const std::string all = read_text(path);
      for (auto match = std::sregex_iterator(all.begin(), all.end(), kVariable); match != std::sregex_iterator();
           ++match) {
        variables.insert(match->str());
      }
    }
  }
  return variables;
}

}  // namespace

Findings check_paths(const fs::path& root, const std::vector<Page>& pages) {
  static const std::regex kPath(R"(^((?:core|server|client-cli|proto|tests|deploy)/[A-Za-z0-9_./-]*)(?:[*{: ].*)?$)");
  Findings findings;
  for (const Page& page : pages) {
    for (const Code& code : page.inline_codes) {
      std::smatch match;
      if (!std::regex_match(code.text, match, kPath)) continue;
      fs::path path(match[1].str());
      const bool open = code.text.size() > path.string().size() && code.text[path.string().size()] != ' ' &&
                        code.text[path.string().size()] != ':';
      if (fs::exists(root / path) || (open && path.string().ends_with('/') && fs::is_directory(root / path))) continue;
      if (open && has_entry_like(root / path.parent_path(), path.filename().string())) continue;
      findings.push_back(place_of(page, code.line) + path.string() + " does not exist");
    }
  }
  return findings;
}

Findings check_fields(const std::vector<Page>& pages) {
  static const std::regex kAlone(R"(^([a-z_0-9]+(?:\.[a-z_0-9\[\]]+)+)(?:[ =:].*)?$)");
  static const std::regex kGiven(R"(--(?:set|over)[ =]([a-z_0-9]+(?:\.[a-z_0-9\[\]]+)+)=)");
  Findings findings;
  for (const Page& page : pages) {
    const auto check = [&](int line, const std::string& path) {
      if (!is_field_of_case(path)) findings.push_back(place_of(page, line) + "a case has no field " + path);
    };
    for_each_match(page, kGiven, true, check);
    for_each_match(page, kAlone, false, [&](int line, const std::string& path) {
      if (is_field_of_case(path.substr(0, path.find('.')))) check(line, path);
    });
  }
  return findings;
}

Findings check_presets(const std::vector<Page>& pages) {
  static const std::regex kPreset("preset:([a-z0-9][a-z0-9-]*)");
  Findings findings;
  for (const Page& page : pages) {
    for_each_match(page, kPreset, true, [&](int line, const std::string& name) {
      const bool is_known = std::ranges::count(scenes::presets(), name, &scenes::NamedSpec::name) > 0;
      if (!is_known) findings.push_back(place_of(page, line) + "no preset is called " + name);
    });
  }
  return findings;
}

Findings check_variables(const fs::path& root, const std::vector<Page>& pages) {
  static const std::regex kVariable("(CELLCRUSH_[A-Z][A-Z_]*)");
  const std::set<std::string> known = variables_in(root);
  Findings findings;
  for (const Page& page : pages) {
    for_each_match(page, kVariable, true, [&](int line, const std::string& name) {
      if (!known.contains(name)) findings.push_back(place_of(page, line) + "nothing reads the variable " + name);
    });
  }
  return findings;
}

}  // namespace cellcrush::docs
