#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace app {

/// Another program that reads from us on its standard input. Its standard output goes nowhere, its standard
/// error is kept for messages.
class PipedProgram {
 public:
  /// @param arguments  the program's name, looked up in PATH, and its arguments
  /// @param missing    what to tell the person to do when there is no such program
  /// Throws Error when it cannot be started.
  PipedProgram(const std::vector<std::string>& arguments, const std::string& missing);
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;
  /// Kills the program when finish() was not called.
  ~PipedProgram();

  /// Waits until the program has taken nearly all. Throws Error when it has ended.
  void write(std::span<const std::uint8_t> bytes);

  /// Ends the input and waits for the program. Throws Error with its last words unless it exits with 0.
  void finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  [[noreturn]] void fail(const std::string& why);
  void close_input();

  std::string name_;
  std::unique_ptr<std::FILE, CloseFile> messages_;
  int input_ = -1;
  pid_t process_ = -1;
};

}  // namespace app
