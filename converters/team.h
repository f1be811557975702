#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace converters {

/// How the jobs of a conversion are shared among processes. Each member goes through the same lists of jobs,
/// one list a map.
class Team {
 public:
  virtual ~Team() = default;
  /// Index of a job in a list that nobody else has been given; counts up, beyond the list's end when all are
  /// given. Called from several threads.
  virtual std::size_t claim(std::size_t list) = 0;
  /// When this member's jobs are done. `all_done` tells whether those of all are. True for the one member
  /// that is to finish the planet. Throws globe::Error when another member failed.
  virtual bool gather(bool all_done) = 0;
};

/// One process that does everything.
class Alone : public Team {
 public:
  explicit Alone(std::size_t lists) : next_(lists) {}
  std::size_t claim(std::size_t list) override { return next_[list]++; }
  bool gather(bool /*all_done*/) override { return true; }

 private:
  std::vector<std::atomic<std::size_t>> next_;
};

}  // namespace converters
