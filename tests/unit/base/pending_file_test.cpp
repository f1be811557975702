#include "globe/base/pending_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "globe/base/error.h"
#include "tests/temporary_folder.h"

namespace globe {
namespace {

using tests::TemporaryFolder;
using Names = std::set<std::string>;

void put(const std::filesystem::path& path, const std::string& text) { std::ofstream(path) << text; }

std::string get(const std::filesystem::path& path) {
  std::ifstream file(path);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

TEST(PendingFile, AppearsWhenPublished) {
  const TemporaryFolder folder;
  PendingFile file(folder / "a.txt", false);
  EXPECT_EQ(file.temporary().extension(), ".txt");
  EXPECT_EQ(file.temporary().parent_path(), file.final_path().parent_path());
  put(file.temporary(), "whole");
  EXPECT_EQ(folder.contents().count("a.txt"), 0u);
  file.publish();
  EXPECT_EQ(folder.contents(), Names{"a.txt"});
  EXPECT_EQ(get(folder / "a.txt"), "whole");
}

TEST(PendingFile, LeavesNothingUnpublished) {
  const TemporaryFolder folder;
  {
    const PendingFile file(folder / "a.txt", false);
    put(file.temporary(), "half");
  }
  EXPECT_EQ(folder.contents(), Names{});
}

TEST(PendingFile, KeepsTheOldOneUntilPublished) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  EXPECT_THROW(PendingFile(folder / "a.txt", false), Error);
  {
    const PendingFile file(folder / "a.txt", true);
    put(file.temporary(), "half");
  }
  EXPECT_EQ(get(folder / "a.txt"), "old");
  PendingFile file(folder / "a.txt", true);
  put(file.temporary(), "new");
  file.publish();
  EXPECT_EQ(get(folder / "a.txt"), "new");
}

TEST(PendingFile, SaysThatTheFolderIsMissing) {
  const TemporaryFolder folder;
  EXPECT_THROW(PendingFile(folder / "gone/a.txt", false), Error);
}

TEST(PendingFile, FailsWhenNothingWasWritten) {
  const TemporaryFolder folder;
  PendingFile file(folder / "a.txt", false);
  EXPECT_THROW(file.publish(), Error);
  EXPECT_EQ(folder.contents(), Names{});
}

}  // namespace
}  // namespace globe
