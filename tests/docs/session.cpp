#include "docs/session.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <system_error>

#include "docs/shown_output.h"
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

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

// A port that is free now.
std::string free_port() {
  const int handle = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  auto* const general = reinterpret_cast<sockaddr*>(&address);
  const bool bound = bind(handle, general, size) == 0 && getsockname(handle, general, &size) == 0;
  close(handle);
  if (!bound) throw std::system_error(errno, std::generic_category(), "no free port");
  return std::to_string(ntohs(address.sin_port));
}

// Addresses of this machine with ports of the session's own, since other daemons may listen on those of the pages.
class Ports {
 public:
  std::string moved(const std::string& text) {
    static const std::regex kAddress(R"((127\.0\.0\.1|localhost|0\.0\.0\.0):([0-9]{4,5}))");
    std::string out;
    auto begin = text.cbegin();
    for (std::smatch match; std::regex_search(begin, text.cend(), match, kAddress); begin = match.suffix().first) {
      std::string& port = ports_[match[2]];
      if (port.empty()) port = free_port();
      out += match.prefix().str() + (match[1] == "0.0.0.0" ? "127.0.0.1" : match[1].str()) + ":" + port;
    }
    return out.append(begin, text.cend());
  }

 private:
  std::map<std::string, std::string> ports_;
};

// Stands before the daemon on the PATH: gives the session's own one the default addresses, with the ports of the
// session, and one more, on which the session asks whether it answers.
constexpr const char* kWrapper = R"(#!/bin/bash
[[ $OF_SESSION ]] || exec DAEMON "$@"
unset OF_SESSION
more=()
case " $* " in *" --config "*) exec DAEMON "$@" --http 127.0.0.1:8080 ;; esac
case " $* " in
  *" --listen "*) ;;
  *) more+=(--listen "unix:$HOME/.local/share/cellcrush/cellcrushd.sock" --listen 127.0.0.1:50551) ;;
esac
case " $* " in *" --http "*|*" --tls-client-ca "*) ;; *) more+=(--http 127.0.0.1:8080) ;; esac
exec DAEMON "$@" "${more[@]}" --listen "unix:$HOME/.session/daemon.sock"
)";

void write_wrappers(const fs::path& folder, const fs::path& programs, Ports& ports) {
  fs::create_directories(folder / ".local/share/cellcrush");
  fs::permissions(folder / ".local/share/cellcrush", fs::perms::owner_all);
  fs::create_directories(folder / ".session");
  const fs::path wrapper = folder / ".session/cellcrushd";
  const std::string daemon = "'" + (programs / "cellcrushd").string() + "'";
  std::ofstream(wrapper) << std::regex_replace(ports.moved(kWrapper), std::regex("DAEMON"), daemon);
  fs::permissions(wrapper, fs::perms::owner_all);
  // Debian's, whose modules the pages install.
  fs::create_symlink("/usr/bin/python3", folder / ".session/python3");
}

// What is typed of a command.
std::string typed(const std::string& command) {
  static const std::regex kDaemon(R"(cellcrushd( +-[^|;&]*)?( [12]?> ?[^ ]+)*)");
  static const std::regex kInstall(R"(apt-get install ((.|\n)*))");
  constexpr const char* kAnswers =
      "answers=1; own=unix:$HOME/.session/daemon.sock; for i in {1..60}; do sleep 0.1; kill -0 $daemon || break\n"
      "{ cellcrush presets --server $own || cellcrush presets; } >$HOME/.session/answer 2>&1 && answers=0 && break\n"
      "done\n";
  if (std::smatch match; std::regex_match(command, match, kInstall)) {
    return "dpkg-query --show " + match[1].str() + " >/dev/null || (exit " +
           std::to_string(StepOutcome::kPackagesAreMissing) + ")\n";
  }
  const bool in_front = std::regex_match(std::regex_replace(command, std::regex(R"(\\\n)"), " "), kDaemon) &&
                        command.find("--version") == std::string::npos;
  if (!in_front && !command.ends_with('&')) return command + "\n";
  return "[[ -z $daemon ]] || { kill $daemon; wait $daemon; } 2>/dev/null\nexport OF_SESSION=1\n" + command +
         (in_front ? " >$HOME/.session/output 2>$HOME/.session/log &" : "") + "\ndaemon=$!\nunset OF_SESSION\n" +
         kAnswers + (in_front ? "cat $HOME/.session/output $HOME/.session/log\n" : "") + "(exit $answers)\n";
}

std::string script_of(const std::vector<Step>& steps, const fs::path& folder, const fs::path& programs, Ports& ports) {
  std::ostringstream script;
  script << "trap 'kill $(jobs -p) 2>/dev/null; wait' EXIT\nunset ${!CELLCRUSH_@} XDG_DATA_HOME\nexport HOME='"
         << folder.string() << "' COLUMNS=100\n"
         << "PATH='" << (folder / ".session").string() << "':'" << programs.string() << "':$PATH\n"
         << "export PYTHONPATH=$(echo ~/.local/lib/python3*/dist-packages)\ncd \"$HOME\"\n";
  for (const Step& step : steps) {
    script << "echo '" << kBegin << step.line << "'\n" << typed(ports.moved(step.command));
    // A file's last line may lack its line feed.
    script << "code=$?; echo; echo '" << kEnd << step.line << "' $code\n[[ $code == 0 ]] || exit 0\n";
  }
  script << "exit 0\n";
  return script.str();
}

std::string user_name() {
  const passwd* found = getpwuid(geteuid());
  return found == nullptr ? "uid" + std::to_string(geteuid()) : found->pw_name;
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

void add_lines(const Code& block, std::vector<Step>& steps) {
  const bool console = block.language == "console";
  int number = block.line;
  const std::size_t before = steps.size();
  bool continued = false;
  for (const std::string& line : lines_of(block.text)) {
    const bool starts = console ? line.starts_with("$ ") : !line.empty() && !line.starts_with("#");
    if (continued) {
      steps.back().command += "\n" + line;
    } else if (starts) {
      steps.push_back({number, line.substr(console ? 2 : 0), {}});
    } else if (console && steps.size() > before) {
      steps.back().shown.push_back(line);
    }
    const bool command = continued || starts;
    continued = command && line.ends_with('\\');
    ++number;
    if (command) steps.back().shown_line = number;
  }
  for (std::size_t i = before; i < steps.size(); ++i) {
    while (!steps[i].shown.empty() && steps[i].shown.back().empty()) steps[i].shown.pop_back();
  }
}

}  // namespace

std::vector<Step> steps_of(const Page& page) {
  const std::string python = "~/.session/page.py";
  std::vector<Step> steps;
  const auto save = [&](const Code& block, const std::string& how, const std::string& file) {
    steps.push_back(
        {block.line,
         "mkdir -p $(dirname " + file + ") && cat " + how + " " + file + " <<'@@ file'\n" + block.text + "@@ file",
         {}});
  };
  int python_line = 0;
  for (const Code& block : page.blocks) {
    if (!block.excuse.empty()) continue;
    if (!block.file.empty()) {
      save(block, ">", block.file);
    } else if (block.language == "python") {
      save(block, ">>", python);
      python_line = block.line;
    } else if (block.language == "console" || block.language == "sh" || block.language == "run") {
      add_lines(block, steps);
    }
  }
  if (python_line > 0) steps.push_back({python_line, "python3 " + python, {}});
  return steps;
}

std::string with_shown(const std::string& page, const std::vector<Step>& steps,
                       const std::vector<std::vector<std::string>>& shown) {
  std::vector<std::string> lines = lines_of(page);
  for (std::size_t i = std::min(steps.size(), shown.size()); i-- > 0;) {
    if (steps[i].shown.empty() || steps[i].shown == shown[i]) continue;
    const std::string& command = lines[steps[i].line - 1];
    const std::string indent = command.substr(0, command.find_first_not_of(' '));
    const auto first = lines.begin() + steps[i].shown_line - 1;
    auto place = lines.erase(first, first + static_cast<std::ptrdiff_t>(steps[i].shown.size()));
    for (const std::string& line : shown[i]) place = lines.insert(place, line.empty() ? line : indent + line) + 1;
  }
  return text_of(lines);
}

std::vector<StepOutcome> run_session(const std::vector<Step>& steps, const fs::path& folder, const fs::path& programs,
                                     std::chrono::seconds limit, Reader reader) {
  Ports ports;
  write_wrappers(folder, programs, ports);
  const fs::path script = folder / ".session/script.sh";
  const fs::path transcript = folder / ".session/transcript";
  std::ofstream(script) << script_of(steps, folder, programs, ports);
  // Into a file and not a pipe, which a daemon in the background would keep open.
  std::vector<std::string> words;
  if (reader == Reader::ordinary_user) words = become_ordinary(folder);
  words.insert(words.end(),
               {"/bin/bash", "-c", "exec /bin/bash '" + script.string() + "' >'" + transcript.string() + "' 2>&1"});
  e2e::Process bash(words);
  (void)bash.wait(limit);
  std::vector<StepOutcome> outcomes;
  const std::regex home(folder.string());
  const std::regex user(reader == Reader::ordinary_user && geteuid() == 0 ? "\\bnobody\\b"
                                                                          : "\\b" + user_name() + "\\b");
  std::string output;
  for (const std::string& line : lines_of(read_text(transcript))) {
    if (line.starts_with(kBegin)) {
      output.clear();
    } else if (line.starts_with(kEnd)) {
      outcomes.push_back({std::stoi(line.substr(line.rfind(' '))), output});
    } else if (line.find("/.session/daemon.sock") == std::string::npos) {
      // Pages show a user of that name.
      output += std::regex_replace(std::regex_replace(line, home, "/home/anna"), user, "anna") + "\n";
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
                  const std::vector<std::string>& before) {
  const TemporaryFolder folder;
  // An ordinary user passes through it.
  fs::permissions(folder.path(), fs::perms::others_exec, fs::perm_options::add);
  const fs::path home = folder.path() / "home";
  install(home / ".local");
  const Page page = find_page(path);
  std::vector<Step> steps = steps_of(page);
  ASSERT_FALSE(steps.empty());
  for (const auto& [words, typed] : instead) {
    const auto step = std::ranges::find_if(steps, [&page_words = words](const Step& candidate) {
      return candidate.command.find(page_words) != std::string::npos;
    });
    ASSERT_NE(step, steps.end()) << path << " has no command with " << words;
    step->command.replace(step->command.find(words), words.size(), typed);
  }
  std::transform(before.begin(), before.end(), std::inserter(steps, steps.begin()), [](const std::string& command) {
    return Step{0, command, {}};
  });
  fs::create_directory_symlink(CELLCRUSH_SOURCE_ROOT, home / "cellcrush");
  const std::vector<StepOutcome> outcomes = run_session(steps, home, home / ".local/bin", kSessionLimit, reader);
  const bool writes = std::getenv("CELLCRUSH_WRITE_PAGES") != nullptr;
  std::vector<std::vector<std::string>> shown;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].exit_code == StepOutcome::kPackagesAreMissing) GTEST_SKIP() << "Not here: " << steps[i].command;
    constexpr std::size_t kMostOutput = 4000;
    const std::string& output = outcomes[i].output;
    const std::string place = path + ":" + std::to_string(steps[i].line) + ": $ " + steps[i].command + "\n" +
                              output.substr(output.size() - std::min(output.size(), kMostOutput));
    EXPECT_EQ(outcomes[i].exit_code, 0) << place;
    shown.push_back(steps[i].shown.empty() ? steps[i].shown : show_again(steps[i].shown, output));
    if (writes) continue;
    EXPECT_EQ(text_of(steps[i].shown), text_of(shown.back()))
        << "CELLCRUSH_WRITE_PAGES=1 writes the second into the page.\n"
        << place;
  }
  ASSERT_EQ(outcomes.size(), steps.size())
      << path << ":" << steps[std::min(outcomes.size(), steps.size() - 1)].line << ": the session ended here";
  if (writes) {
    const fs::path file = fs::path(CELLCRUSH_SOURCE_ROOT) / path;
    const std::string text = read_text(file);
    shown.erase(shown.begin(), shown.begin() + static_cast<std::ptrdiff_t>(before.size()));
    steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(before.size()));
    if (const std::string made = with_shown(text, steps, shown); made != text) std::ofstream(file) << made;
  }
}

}  // namespace cellcrush::docs
