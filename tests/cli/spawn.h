#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

namespace cli {

struct Result {
  int status = -1;  ///< exit code, or 128 + signal
  std::string out, err;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Starts GLOBE_PROGRAM with its three streams in files of the folder; gives the process id.
inline pid_t start(std::vector<std::string> args, const std::filesystem::path& folder,
                   const std::string& stdin_text = {}) {
  std::ofstream(folder / "stdin") << stdin_text;
  args.insert(args.begin(), GLOBE_PROGRAM);
  std::vector<char*> words;
  for (std::string& arg : args) words.push_back(arg.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(::open((folder / "stdin").c_str(), O_RDONLY), 0);
    ::dup2(::open((folder / "stdout").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    ::dup2(::open((folder / "stderr").c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  return child;
}

inline int wait_for(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs GLOBE_PROGRAM to its end.
inline Result run(std::vector<std::string> args, std::string stdin_text = {}) {
  const tests::TemporaryFolder folder;
  const int status = wait_for(start(std::move(args), folder.path(), stdin_text));
  return {status, text_of(folder / "stdout"), text_of(folder / "stderr")};
}

}  // namespace cli
