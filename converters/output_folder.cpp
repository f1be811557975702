#include "converters/output_folder.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>

#include "globe/base/error.h"
#include "globe/base/file_lock.h"
#include "globe/planet/planet_file.h"

namespace converters {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRecipe = "recipe.json";

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

/// The whole of a file, or nothing when there is none.
std::optional<std::string> read_text(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Under a temporary name first; the name is ours alone, for others may write the same file.
void write_text(const fs::path& path, const std::string& text, bool to_disk) {
  const fs::path temporary = path.string() + "." + std::to_string(::getpid()) + ".partial";
  {
    std::ofstream stream(temporary, std::ios::binary);
    stream << text;
    if (!stream.flush()) {
      throw globe::Error(path.string(), "cannot be written", "free some disk, then the same command goes on");
    }
  }
  if (to_disk) globe::planet::sync_to_disk(temporary);
  fs::rename(temporary, path);
}

/// What names the time since the machine was started; "" where the system does not tell.
std::string this_boot() {
  std::string name = read_text("/proc/sys/kernel/random/boot_id").value_or("");
  name.erase(std::remove_if(name.begin(), name.end(), [](unsigned char c) { return std::isspace(c); }),
             name.end());
  return name;
}

/// Whether a folder lies on a disk of this machine, where what has been written can be read until the machine
/// stops. Over a network a full disk may show only later.
bool is_on_own_disk(const fs::path& folder) {
  struct statfs status {};
  if (::statfs(folder.c_str(), &status) != 0) return false;
  constexpr std::array<std::uint32_t, 6> kOwn{EXT4_SUPER_MAGIC, XFS_SUPER_MAGIC, BTRFS_SUPER_MAGIC,
                                              F2FS_SUPER_MAGIC, TMPFS_MAGIC,     OVERLAYFS_SUPER_MAGIC};
  return std::find(kOwn.begin(), kOwn.end(), static_cast<std::uint32_t>(status.f_type)) != kOwn.end();
}

fs::path mark_path(const fs::path& work, const Job& job) {
  return PartFiles{work}.tiles(job).replace_extension(".done");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& planet, bool overwrite, const std::string& recipe, Sharing sharing)
    : planet_(planet.has_filename() ? planet : planet.parent_path()),
      partial_(planet_.string() + ".partial"),
      work_(partial_ / "work"),
      sharing_(sharing) {
  refuse_existing(planet_, overwrite);
  std::error_code error;
  fs::create_directories(work_, error);
  lock_ = ::open(partial_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || error) {
    const std::string why = error ? error.message() : std::strerror(errno);
    if (lock_ >= 0) ::close(lock_);
    throw globe::Error(partial_.string(), "cannot be made (" + why + ")",
                       "choose a folder that may be written");
  }
  if (::flock(lock_, (sharing == Sharing::kAlone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0) {
    ::close(lock_);
    throw globe::Error(partial_.string(), "another conversion is writing here",
                       "wait for it or choose another name");
  }
  if (sharing == Sharing::kAlone && is_on_own_disk(work_)) boot_ = this_boot();
  try {
    set_up(recipe, overwrite);
  } catch (...) {
    ::close(lock_);
    throw;
  }
}

void OutputFolder::set_up(const std::string& recipe, bool overwrite) {
  const globe::FileLock lock(work_ / "setup.lock");
  const fs::path path = work_ / kRecipe;
  const std::optional<std::string> begun = read_text(path);
  if (begun == recipe) return;
  if (begun && any_done() && !(overwrite && sharing_ == Sharing::kAlone)) {
    throw globe::Error(partial_.string(), "was begun with other maps or options",
                       "repeat that command, remove the folder, or choose another name");
  }
  clear();
  write_text(path, recipe, true);
}

/// The recipe goes first: without it nothing that is left counts, whenever we are interrupted.
void OutputFolder::forget_recipe() const {
  fs::remove(work_ / kRecipe);
  globe::planet::sync_to_disk(work_);
}

void OutputFolder::clear() const {
  forget_recipe();
  for (const fs::path& folder : {partial_, work_}) {
    for (const fs::directory_entry& leftover : fs::directory_iterator(folder)) {
      if (leftover.path() != work_ && leftover.path().filename() != "setup.lock")
        fs::remove_all(leftover.path());
    }
  }
}

bool OutputFolder::any_done() const {
  for (const fs::directory_entry& file : fs::directory_iterator(work_))
    if (file.path().extension() == ".done") return true;
  return false;
}

std::optional<Range> OutputFolder::done(const Job& job) const {
  const std::optional<std::string> text = read_text(mark_path(work_, job));
  if (!text) return std::nullopt;
  Range range{};
  std::istringstream stream(*text);
  stream.imbue(std::locale::classic());
  if (!(stream >> range.min >> range.max)) return std::nullopt;
  std::string boot;
  if (stream >> boot && boot != this_boot()) return std::nullopt;
  return range;
}

void OutputFolder::mark_done(const Job& job, const Range& range) const {
  char text[64];
  std::snprintf(text, sizeof text, "%.17g %.17g", range.min, range.max);
  write_text(mark_path(work_, job), text + (boot_.empty() ? "" : " " + boot_) + "\n", boot_.empty());
}

bool OutputFolder::take_over() {
  ::flock(lock_, LOCK_UN);
  ::flock(lock_, LOCK_EX);
  struct stat ours {
  }, named{};
  const bool same = ::fstat(lock_, &ours) == 0 && ::stat(partial_.c_str(), &named) == 0 &&
                    ours.st_dev == named.st_dev && ours.st_ino == named.st_ino;
  finished_ = !same;
  return same;
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!finished_ && sharing_ == Sharing::kAlone && !any_done()) fs::remove_all(partial_, ignored);
  ::close(lock_);
}

void OutputFolder::finish() {
  forget_recipe();
  fs::remove_all(work_);
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
