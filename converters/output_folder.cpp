#include "converters/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "globe/base/error.h"
#include "globe/planet/planet_file.h"

namespace converters {
namespace {

namespace fs = std::filesystem;

bool is_planet(const fs::path& folder) {
  return fs::is_regular_file(folder / globe::planet::kPlanetFileName);
}

void refuse_existing(const fs::path& planet, bool overwrite) {
  if (!fs::exists(fs::symlink_status(planet))) return;
  if (!fs::is_directory(planet) || (!is_planet(planet) && !fs::is_empty(planet))) {
    throw globe::Error(planet.string(), "exists and is not a planet", "choose another name");
  }
  if (!overwrite && is_planet(planet)) {
    throw globe::Error(planet.string(), "exists already", "choose another name or add --overwrite");
  }
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& planet, bool overwrite)
    : planet_(planet.has_filename() ? planet : planet.parent_path()),
      partial_(planet_.string() + ".partial") {
  refuse_existing(planet_, overwrite);
  std::error_code error;
  fs::create_directories(partial_, error);
  lock_ = ::open(partial_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) {
    throw globe::Error(partial_.string(), std::string("cannot be made (") + std::strerror(errno) + ")",
                       "choose a folder that may be written");
  }
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw globe::Error(partial_.string(), "another conversion is writing here",
                       "wait for it or choose another name");
  }
  for (const fs::directory_entry& leftover : fs::directory_iterator(partial_))
    fs::remove_all(leftover.path());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!finished_) fs::remove_all(partial_, ignored);
  ::close(lock_);
}

void OutputFolder::finish() {
  globe::planet::sync_to_disk(partial_);
  const bool replaces = fs::exists(planet_);
  // Exchanging the two names leaves no moment without a planet.
  if (::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, planet_.c_str(),
                  replaces ? RENAME_EXCHANGE : RENAME_NOREPLACE) != 0) {
    throw globe::Error(planet_.string(), std::string("cannot take its name (") + std::strerror(errno) + ")",
                       "choose another name");
  }
  finished_ = true;
  if (replaces) fs::remove_all(partial_);
  globe::planet::sync_to_disk(fs::absolute(planet_).parent_path());
}

}  // namespace converters
