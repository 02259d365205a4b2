#include "docs/session.h"

#include <gtest/gtest.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <regex>
#include <sstream>
#include <system_error>

#include "programs/process.h"
#include "programs/temporary_folder.h"

namespace cellcrush::docs {
namespace {

namespace fs = std::filesystem;

const std::string kBegin = "@@ begin ";
const std::string kEnd = "@@ end ";

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The daemon's ports stay closed, since another one may listen on them: only the Unix socket of this session is open.
void write_daemon_wrapper(const fs::path& folder, const fs::path& programs) {
  fs::create_directories(folder / ".local/share/cellcrush");
  fs::create_directories(folder / ".session");
  const fs::path wrapper = folder / ".session/cellcrushd";
  std::ofstream(wrapper) << "#!/bin/bash\ncase \"$1\" in [a-z]*) exec '" << (programs / "cellcrushd").string()
                         << "' \"$@\" ;; esac\nexec '" << (programs / "cellcrushd").string()
                         << "' --listen \"unix:$HOME/.local/share/cellcrush/cellcrushd.sock\" --http none \"$@\"\n";
  fs::permissions(wrapper, fs::perms::owner_all);
}

std::string script_of(const std::vector<Step>& steps, const fs::path& folder, const fs::path& programs) {
  std::ostringstream script;
  script << "trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT\nunset ${!CELLCRUSH_@} XDG_DATA_HOME\nexport HOME='"
         << folder.string() << "' COLUMNS=100\n"
         << "PATH='" << (folder / ".session").string() << "':'" << programs.string() << "':$PATH\ncd \"$HOME\"\n";
  for (const Step& step : steps) {
    script << "echo '" << kBegin << step.line << "'\n" << step.command << "\n";
    if (step.command.ends_with('&')) {
      script << "for i in {1..300}; do cellcrush presets >.session/answer 2>&1 && break; sleep 0.1; done\n";
    }
    // A file's last line may lack its line feed.
    script << "code=$?; echo; echo '" << kEnd << step.line << "' $code\n[[ $code == 0 ]] || exit 0\n";
  }
  script << "exit 0\n";
  return script.str();
}

// The words before a command that make an ordinary user of root. Gives the folder to that user.
std::vector<std::string> become_ordinary(const fs::path& folder) {
  const passwd* nobody = geteuid() == 0 ? getpwnam("nobody") : nullptr;
  if (nobody == nullptr) return {};
  const auto give = [nobody](const fs::path& path) {
    if (lchown(path.c_str(), nobody->pw_uid, nobody->pw_gid) != 0)
      throw std::system_error(errno, std::generic_category(), "chown " + path.string());
  };
  give(folder);
  for (const auto& entry : fs::recursive_directory_iterator(folder)) give(entry.path());
  return {"/usr/bin/setpriv", "--reuid=nobody", "--regid=" + std::to_string(nobody->pw_gid), "--clear-groups",
          "--pdeathsig=KILL"};
}

using testing::TemporaryFolder;

constexpr std::chrono::seconds kSessionLimit{480};

Page find_page(const std::string& path) {
  for (Page& page : read_pages(CELLCRUSH_SOURCE_ROOT)) {
    if (page.path == path) return page;
  }
  ADD_FAILURE() << "no page " << path;
  return {};
}

}  // namespace

std::vector<Step> steps_of(const Page& page) {
  std::vector<Step> steps;
  for (const Code& block : page.blocks) {
    if (block.language != "console") continue;
    int number = block.line;
    bool continued = false;
    for (const std::string& line : lines_of(block.text)) {
      if (continued) {
        steps.back().command += "\n" + line;
      } else if (line.starts_with("$ ")) {
        steps.push_back({number, line.substr(2), {}});
      } else if (!line.empty() && !steps.empty()) {
        steps.back().shown.push_back(line);
      }
      continued = (continued || line.starts_with("$ ")) && line.ends_with('\\');
      ++number;
    }
  }
  return steps;
}

std::string masked(const std::string& line) {
  static const std::regex kNumber(R"([-+]?[0-9][0-9.,:]*(e[-+]?[0-9]+)?)");
  static const std::regex kName(R"((jobs|sweeps)/[A-Za-z0-9_-]+)");
  static const std::regex kBlank(R"([ \t]+)");
  static const std::regex kRule(R"(([-=#])\1+)");
  std::string text = std::regex_replace(line, kName, "$1/NAME");
  text = std::regex_replace(text, kNumber, "#");
  text = std::regex_replace(text, kRule, "=");
  text = std::regex_replace(text, kBlank, " ");
  while (text.ends_with(' ')) text.pop_back();
  while (text.starts_with(' ')) text.erase(0, 1);
  return text;
}

std::string missing_line(const std::vector<std::string>& shown, const std::string& output) {
  std::vector<std::string> lines;
  for (const std::string& line : lines_of(output)) {
    if (const std::string text = masked(line); !text.empty()) lines.push_back(text);
  }
  auto next = lines.begin();
  bool gap = false;
  for (const std::string& line : shown) {
    if (line == "...") {
      gap = true;
      continue;
    }
    const auto found = gap ? std::find(next, lines.end(), masked(line)) : next;
    if (found == lines.end() || *found != masked(line)) return line;
    next = found + 1;
    gap = false;
  }
  return "";
}

std::vector<StepOutcome> run_session(const std::vector<Step>& steps, const fs::path& folder, const fs::path& programs,
                                     std::chrono::seconds limit, Reader reader) {
  write_daemon_wrapper(folder, programs);
  const fs::path script = folder / ".session/script.sh";
  const fs::path transcript = folder / ".session/transcript";
  std::ofstream(script) << script_of(steps, folder, programs);
  // Into a file and not a pipe, which a daemon in the background would keep open.
  std::vector<std::string> words;
  if (reader == Reader::ordinary_user) words = become_ordinary(folder);
  words.insert(words.end(),
               {"/bin/bash", "-c", "exec /bin/bash '" + script.string() + "' >'" + transcript.string() + "' 2>&1"});
  e2e::Process bash(words);
  (void)bash.wait(limit);
  std::vector<StepOutcome> outcomes;
  std::string output;
  for (const std::string& line : lines_of(read_text(transcript))) {
    if (line.starts_with(kBegin)) {
      output.clear();
    } else if (line.starts_with(kEnd)) {
      outcomes.push_back({std::stoi(line.substr(line.rfind(' '))), output});
    } else {
      output += line + "\n";
    }
  }
  return outcomes;
}

void install(const fs::path& prefix) {
  const e2e::Outcome outcome = e2e::run(
      {CELLCRUSH_CMAKE, "--install", CELLCRUSH_BINARY_ROOT, "--prefix", prefix.string()}, std::chrono::seconds(60));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.all();
}

void expect_shown(const std::string& path, Reader reader, const std::map<std::string, std::string>& instead,
                  const std::map<std::string, std::string>& saved) {
  const TemporaryFolder folder;
  // An ordinary user passes through it.
  fs::permissions(folder.path(), fs::perms::others_exec, fs::perm_options::add);
  const fs::path home = folder.path() / "home";
  install(home / ".local");
  const Page page = find_page(path);
  for (const auto& [file, language] : saved) {
    const auto block = std::ranges::find(page.blocks, language, &Code::language);
    ASSERT_NE(block, page.blocks.end()) << path << " has no block of " << language;
    std::ofstream(home / file) << block->text;
  }
  std::vector<Step> steps = steps_of(page);
  ASSERT_FALSE(steps.empty());
  for (const auto& [words, typed] : instead) {
    const auto step = std::ranges::find_if(steps, [&page_words = words](const Step& candidate) {
      return candidate.command.find(page_words) != std::string::npos;
    });
    ASSERT_NE(step, steps.end()) << path << " has no command with " << words;
    step->command.replace(step->command.find(words), words.size(), typed);
  }
  fs::create_directory_symlink(CELLCRUSH_SOURCE_ROOT, home / "cellcrush");
  const std::vector<StepOutcome> outcomes = run_session(steps, home, home / ".local/bin", kSessionLimit, reader);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const std::string place = path + ":" + std::to_string(steps[i].line) + ": $ " + steps[i].command;
    EXPECT_EQ(outcomes[i].exit_code, 0) << place << "\n" << outcomes[i].output;
    EXPECT_EQ(missing_line(steps[i].shown, outcomes[i].output), "") << place << "\n" << outcomes[i].output;
  }
  ASSERT_EQ(outcomes.size(), steps.size())
      << path << ":" << steps[std::min(outcomes.size(), steps.size() - 1)].line << ": the session ended here";
}

}  // namespace cellcrush::docs
