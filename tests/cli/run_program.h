#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace cli {

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

/// A file of its own, gone with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content = "") {
    descriptor_ = mkstemp(path_.data());
    std::ofstream(path_) << content;
  }
  ~TemporaryFile() {
    close(descriptor_);
    unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  int descriptor() const { return descriptor_; }
  std::string content() const {
    std::ifstream file(path_);
    return {std::istreambuf_iterator<char>(file), {}};
  }

 private:
  std::string path_ = "/tmp/globe-cli-XXXXXX";
  int descriptor_ = -1;
};

/// Runs the program with these words (no shell between) and this standard input.
inline Outcome run_program(const std::vector<std::string>& words, const std::string& input = "") {
  const TemporaryFile in(input), out, err;
  std::vector<char*> argv{const_cast<char*>(GLOBE_PROGRAM)};
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(in.descriptor(), STDIN_FILENO);
    dup2(out.descriptor(), STDOUT_FILENO);
    dup2(err.descriptor(), STDERR_FILENO);
    execv(GLOBE_PROGRAM, argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {out.content(), err.content(), WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)};
}

/// The program with pipes at both ends, for tests that wait for an answer before they ask on.
class Conversation {
 public:
  explicit Conversation(const std::vector<std::string>& words) {
    std::array<int, 2> to{}, from{};
    if (pipe(to.data()) != 0 || pipe(from.data()) != 0) return;
    std::vector<char*> argv{const_cast<char*>(GLOBE_PROGRAM)};
    for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], STDIN_FILENO);
      dup2(from[1], STDOUT_FILENO);
      for (const int end : {to[0], to[1], from[0], from[1]}) close(end);
      execv(GLOBE_PROGRAM, argv.data());
      _exit(127);
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
