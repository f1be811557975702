#pragma once

#include <string>

namespace app {

enum class ProgressStyle { kNone, kBar, kJson };

/// A bar on standard error when it is a terminal, JSON lines when asked for, else nothing.
ProgressStyle progress_style(bool quiet, bool json);

/// Shows how far a long command has come, on standard error; no more often than changes can be seen.
class Progress {
 public:
  explicit Progress(ProgressStyle style) : style_(style) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `fraction` of a stage, 0 to 1.
  void show(const std::string& stage, double fraction);

  /// Takes the bar away, so that a line can be printed.
  void clear();

 private:
  ProgressStyle style_;
  std::string stage_;
  int percent_ = -1;
  bool drawn_ = false;
};

}  // namespace app
