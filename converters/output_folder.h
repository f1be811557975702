#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converters/block_row.h"

namespace converters {

/// A planet in the making: everything goes into PLANET.partial, which takes PLANET's name when it is whole.
///
/// PLANET.partial/work holds the recipe (what is converted, and how), the parts that are done and a mark for
/// each. An interrupted conversion leaves it, and the next one with the same recipe goes on from there.
///
/// To wait for the disk at every part would take as long as to make it. One process that works alone on a
/// disk of its own machine therefore marks parts that the system has taken: they outlast the process, and
/// count until the machine is started anew. Those of a team are on the disk.
class OutputFolder {
 public:
  enum class Sharing {
    kAlone,   ///< one process converts the planet
    kInTeam,  ///< several do, each some of its jobs
  };

  /// Throws globe::Error when PLANET exists and may not be replaced (only planets ever are), when another
  /// conversion is writing it, when PLANET.partial has another recipe (unless `overwrite` and alone: then it
  /// is cleared), or the folder cannot be made.
  OutputFolder(const std::filesystem::path& planet, bool overwrite, const std::string& recipe,
               Sharing sharing);
  /// Removes PLANET.partial when it is ours alone and no job is done.
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where the files of the planet go.
  const std::filesystem::path& path() const { return partial_; }
  PartFiles parts() const { return {work_, boot_.empty()}; }

  /// Range of the values of a job that is done, else nothing.
  std::optional<Range> done(const Job& job) const;
  /// Marks a job as done.
  void mark_done(const Job& job, const Range& range) const;

  /// Of a team: waits until nobody else is at work. False when another has finished the planet meanwhile.
  bool take_over();

  /// Gives the folder its final name, in one step even when it replaces an older planet, after planet.json
  /// has been written.
  void finish();

 private:
  void set_up(const std::string& recipe, bool overwrite);
  void forget_recipe() const;
  void clear() const;
  bool any_done() const;

  std::filesystem::path planet_;
  std::filesystem::path partial_;
  std::filesystem::path work_;
  Sharing sharing_;
  std::string boot_;  ///< of the marks that count until the next one; "": marks count for ever
  int lock_ = -1;
  bool finished_ = false;
};

}  // namespace converters
