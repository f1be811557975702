#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/temporary_folder.h"

namespace window {

/// Starts a program with its streams in files, or nowhere; gives the process id.
inline pid_t spawn(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                   const std::string& out = "/dev/null", const std::string& err = "/dev/null") {
  const pid_t child = fork();
  if (child != 0) return child;
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
  dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
  std::vector<char*> argv;
  argv.reserve(words.size() + 1);
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(127);
}

inline int wait_for(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// A screen of its own without glass (Xvfb), and hands for it (xdotool).
class Screen {
 public:
  static constexpr int kWidth = 800, kHeight = 600;

  Screen() {
    const std::string number = (folder_ / "number").string();
    const int fd = open(number.c_str(), O_RDWR | O_CREAT | O_TRUNC, 0600);
    const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight) + "x24";
    server_ = fork();
    if (server_ == 0) {
      dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
      dup2(fd, 7);
      // It would start anew, and refuse who comes meanwhile, whenever its last client left: xdotool, often.
      execlp("Xvfb", "Xvfb", "-displayfd", "7", "-screen", "0", size.c_str(), "-noreset", "-nolisten", "tcp",
             nullptr);
      _exit(127);
    }
    close(fd);
    for (int k = 0; k < 600 && display_.empty(); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::ifstream stream(number);
      std::string digits;
      if (std::getline(stream, digits) && !stream.eof()) display_ = ":" + digits;
    }
  }
  ~Screen() {
    kill(server_, SIGTERM);
    waitpid(server_, nullptr, 0);
  }
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  bool is_there() const { return !display_.empty(); }
  std::vector<std::string> environment() const { return {"DISPLAY=" + display_}; }

  /// xdotool's words: "mousemove 10 20", "mousedown 1", "key ctrl+q", "type ...".
  void hands(const std::vector<std::string>& words) const {
    std::vector<std::string> all{"xdotool"};
    all.insert(all.end(), words.begin(), words.end());
    wait_for(spawn(all, environment()));
  }
  void move_to(int x, int y) const { hands({"mousemove", "--sync", std::to_string(x), std::to_string(y)}); }

  /// Whether a window of that name is there: xdotool's answer.
  bool shows(const std::string& name) const {
    return wait_for(spawn({"xdotool", "search", "--onlyvisible", "--name", name}, environment())) == 0;
  }

 private:
  tests::TemporaryFolder folder_;
  pid_t server_ = -1;
  std::string display_;
};

inline void rest(int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); }

/// `globe view` on a screen.
class ViewProgram {
 public:
  ViewProgram(const Screen& screen, std::vector<std::string> words, const std::filesystem::path& folder)
      : screen_(screen), folder_(folder) {
    words.insert(words.begin(), {GLOBE_PROGRAM, "view"});
    std::vector<std::string> environment = screen.environment();
    environment.push_back("XDG_STATE_HOME=" + (folder / "state").string());
    environment.push_back("LIBGL_ALWAYS_SOFTWARE=1");
    child_ = spawn(words, environment, (folder / "out").string(), (folder / "err").string());
  }
  ~ViewProgram() {
    if (child_ > 0) {
      kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  ViewProgram(const ViewProgram&) = delete;
  ViewProgram& operator=(const ViewProgram&) = delete;

  /// Waits until something is so, a minute at most.
  static bool await(const std::function<bool()>& is_so) {
    for (int k = 0; k < 600; ++k) {
      if (is_so()) return true;
      rest(100);
    }
    return false;
  }

  /// Until its picture is complete and nothing moves: its title says so.
  bool await_rest() const {
    return await([&] { return screen_.shows("^globe - [^(]*$"); });
  }

  /// Closes it as a person does and gives its exit status; -1 when it does not close.
  int close() {
    screen_.hands({"key", "ctrl+q"});
    int status = -1;
    if (!await([&] { return waitpid(child_, &status, WNOHANG) == child_; })) return -1;
    child_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  std::string text(const char* stream) const {
    std::ifstream file(folder_ / stream);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  /// How it was left, of the one view that the folder's state knows.
  nlohmann::json left() const {
    std::ifstream file(folder_ / "state/globe/views.json");
    const nlohmann::json views = nlohmann::json::parse(file, nullptr, false);
    return views.is_object() && views.size() == 1 ? views.begin().value() : nlohmann::json();
  }

 private:
  const Screen& screen_;
  std::filesystem::path folder_;
  pid_t child_ = -1;
};

}  // namespace window
