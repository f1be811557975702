#include "app/piped_program.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "globe/base/error.h"

namespace app {
namespace {

using globe::Error;

/// What is said on the way to a failure is long in ffmpeg; the cause comes last.
constexpr long kLastWords = 400;

int spawn(const std::vector<std::string>& arguments, int input, int errors, pid_t& process) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
  const int failure = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failure;
}

std::string last_words(std::FILE* file) {
  std::fseek(file, 0, SEEK_END);
  const long size = std::ftell(file);
  std::fseek(file, size > kLastWords ? size - kLastWords : 0, SEEK_SET);
  std::string text(kLastWords, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) {
    if (c == '\n') c = ' ';
  }
  return text;
}

}  // namespace

PipedProgram::PipedProgram(const std::vector<std::string>& arguments, const std::string& missing)
    : name_(arguments.front()), messages_(std::tmpfile()) {
  // A pair of sockets is a pipe that can be written to without SIGPIPE.
  int ends[2];
  if (!messages_ || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
    throw Error(name_, std::strerror(errno), "free some space or file handles");
  }
  const int failure = spawn(arguments, ends[1], ::fileno(messages_.get()), process_);
  ::close(ends[1]);
  input_ = ends[0];
  if (failure == 0) return;
  ::close(input_);
  throw Error(name_, failure == ENOENT ? "there is no such program here" : std::strerror(failure), missing);
}

PipedProgram::~PipedProgram() {
  close_input();
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

void PipedProgram::close_input() {
  if (input_ >= 0) ::close(input_);
  input_ = -1;
}

void PipedProgram::fail(const std::string& why) {
  const std::string words = last_words(messages_.get());
  throw Error(name_, words.empty() ? why : words, "check the output's folder and the free space of its disk");
}

void PipedProgram::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(input_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) {
      const std::string why = std::strerror(errno);
      // Its end of the pair is closed: it is about to end, and its last words come with that.
      ::waitpid(process_, nullptr, 0);
      process_ = -1;
      fail(why);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void PipedProgram::finish() {
  close_input();
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail("it ended with status " + std::to_string(status));
}

}  // namespace app
