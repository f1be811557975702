#pragma once

#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <stdio_ext.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "app/run.h"
#include "tests/temporary_folder.h"

namespace cli {

/// Words of a command and more of them.
inline std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// What a run of the program left behind.
struct Outcome {
  std::string out, err;
  int status = -1;  ///< exit code, or 128 + the signal that ended it

  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::istringstream stream(out);
    for (std::string line; std::getline(stream, line);) all.push_back(line);
    return all;
  }
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline std::ptrdiff_t threads() {
  const std::filesystem::directory_iterator all("/proc/self/task");
  return std::distance(begin(all), end(all));
}
/// Those that libraries start with the process, idle until they are asked.
inline const std::ptrdiff_t threads_from_the_start = threads();

/// Whether a child may run the program's code without starting the program first, which takes longer than
/// most of what the tests ask of it: not with a thread at work in this process, whose locks a child would
/// find as they stood. GLOBE_TEST_FULL=1 starts the program every time.
inline bool may_stay() {
  return std::getenv("GLOBE_TEST_FULL") == nullptr && threads() == threads_from_the_start;
}

/// What a child does: becomes the program with these words, no shell between. `stay` is what may_stay() said
/// before the fork.
[[noreturn]] inline void become_program(const std::vector<std::string>& words, bool stay,
                                        const char* program = GLOBE_PROGRAM) {
  std::vector<char*> argv{const_cast<char*>(program)};
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  if (!stay || std::string(program) != GLOBE_PROGRAM) {
    ::execv(program, argv.data());
    ::_exit(127);
  }
  // Standard output as a new program has it: empty, and written by whole buffers.
  ::__fpurge(stdout);
  std::setvbuf(stdout, nullptr, _IOFBF, BUFSIZ);
  OIIO::attribute("threads", 0);  // as many as there are cores, as a new program has them
  OIIO::attribute("exr_threads", 0);
  const int status = app::run(static_cast<int>(words.size()) + 1, argv.data());
  std::fflush(nullptr);
  ::_exit(status);  // libraries would wait for threads that a child does not have
}

/// Starts the program with its three streams in the files stdin, stdout and stderr of a folder; gives the
/// process id.
inline pid_t start(const std::vector<std::string>& words, const std::filesystem::path& folder,
                   const std::string& input = "", const char* program = GLOBE_PROGRAM) {
  std::ofstream(folder / "stdin", std::ios::binary) << input;
  std::fflush(nullptr);
  const bool stay = may_stay();
  const pid_t child = ::fork();
  if (child != 0) return child;
  ::dup2(::open((folder / "stdin").c_str(), O_RDONLY), STDIN_FILENO);
  ::dup2(::open((folder / "stdout").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  ::dup2(::open((folder / "stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  become_program(words, stay, program);
}

/// The exit code of a child, or 128 + the signal that ended it.
inline int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs the program to its end.
inline Outcome run_program(const std::vector<std::string>& words, const std::string& input = "",
                           const char* program = GLOBE_PROGRAM) {
  const tests::TemporaryFolder folder;
  const int status = wait_for(start(words, folder.path(), input, program));
  return {text_of(folder / "stdout"), text_of(folder / "stderr"), status};
}

/// The program with pipes at both ends, for tests that wait for an answer before they ask on.
class Conversation {
 public:
  explicit Conversation(const std::vector<std::string>& words) {
    std::array<int, 2> to{}, from{};
    if (pipe(to.data()) != 0 || pipe(from.data()) != 0) return;
    const bool stay = may_stay();
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], STDIN_FILENO);
      dup2(from[1], STDOUT_FILENO);
      for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
      become_program(words, stay);
    }
    close(to[0]);
    close(from[1]);
    to_ = to[1];
    from_ = from[0];
  }
  ~Conversation() {
    close(to_);
    close(from_);
    waitpid(child_, nullptr, 0);
  }
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  /// Sends a line and waits for one; empty when the program is gone.
  std::string ask(const std::string& question) {
    const std::string line = question + "\n";
    if (write(to_, line.data(), line.size()) != static_cast<ssize_t>(line.size())) return "";
    std::string answer;
    for (char c = 0; read(from_, &c, 1) == 1 && c != '\n';) answer += c;
    return answer;
  }

 private:
  pid_t child_ = -1;
  int to_ = -1, from_ = -1;
};

}  // namespace cli
