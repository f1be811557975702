#include "flat/visibility.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "globe/base/error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;

/// Two flats with a wall of mountains between them; `gap_row`: where it is open.
std::shared_ptr<const Terrain> walled(int gap_row) {
  const PostRect posts{-40, -40, 81, 81, 1};
  std::vector<float> heights;
  for (int row = 0; row < 81; ++row) {
    for (int column = 0; column < 81; ++column)
      heights.push_back(column >= 38 && column <= 42 && std::abs(row - gap_row) > 4 ? 900.0f : 100.0f);
  }
  const HeightGrid grid(30.0, posts, heights);
  return std::make_shared<const Terrain>(TangentFrame(globe::geo::kWgs84, 46.0, 7.0), grid, posts);
}

/// Whether anything stands between a place and a post of the ground, by small steps.
bool sees(const Terrain& terrain, const glm::dvec3& eye, int column, int row) {
  const glm::dvec3 to(terrain.x_m(column), terrain.y_m(row), terrain.z(column, row));
  for (int k = 1; k < 2000; ++k) {
    const glm::dvec3 at = eye + (to - eye) * (k / 2000.0);
    if (at.z < terrain.z_at(at.x, at.y) - 1e-6) return false;
  }
  return true;
}

TEST(Visibility, AWallHidesWhatIsBehindItFromBelowAndNotFromAbove) {
  const auto terrain = walled(1000);
  const Visibility sets = Visibility::compute(*terrain);
  const std::size_t west = 10, east = 14;  // of the middle row
  const glm::dvec3 below(terrain->x_m(8), terrain->y_m(40), 110.0);
  EXPECT_FALSE(sets.may_see(below, east));
  EXPECT_TRUE(sets.may_see(below, west));
  EXPECT_TRUE(sets.may_see({below.x, below.y, 2400.0}, east));
  EXPECT_TRUE(sets.may_see({below.x, below.y, 1e5}, east));
  EXPECT_TRUE(sets.may_see({below.x - 1e5, below.y, 110.0}, east));  // from outside
  EXPECT_GT(sets.hidden_share(), 0.02);
}

TEST(Visibility, AGapInTheWallIsSeenThrough) {
  const auto terrain = walled(40);
  const Visibility sets = Visibility::compute(*terrain);
  EXPECT_TRUE(sets.may_see({terrain->x_m(8), terrain->y_m(40), 110.0}, 14));
}

TEST(Visibility, NoPatchThatIsSeenIsHidden) {
  const auto terrain = rough_terrain(6, 6);
  const Visibility sets = Visibility::compute(*terrain);
  std::mt19937 random(23);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int seen = 0, hidden = 0;
  for (int round = 0; round < 400; ++round) {
    const double x = (share(random) - 0.5) * 2880.0, y = (share(random) - 0.5) * 2880.0;
    const glm::dvec3 eye(x, y, terrain->z_at(x, y) + 1.0 + 200.0 * share(random) * share(random));
    for (std::size_t k = 0; k < terrain->patch_count(); ++k) {
      if (sets.may_see(eye, k)) continue;
      ++hidden;
      for (int post = 0; post < 6; ++post) {
        const int column = static_cast<int>(k % 6) * 16 + static_cast<int>(16.99 * share(random));
        const int row = static_cast<int>(k / 6) * 16 + static_cast<int>(16.99 * share(random));
        seen += sees(*terrain, eye, column, row) ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(seen, 0);
  EXPECT_GT(hidden, 100);
}

TEST(Visibility, AFileIsOfItsRegionAlone) {
  const tests::TemporaryFolder folder;
  const auto terrain = rough_terrain(3, 3);
  const Visibility sets = Visibility::compute(*terrain);
  const auto file = folder.path() / "sets.pvs";
  sets.write(file, false);
  EXPECT_EQ(Visibility::read(file, *terrain).hidden_share(), sets.hidden_share());
  EXPECT_THROW(sets.write(file, false), globe::Error);
  EXPECT_THROW(Visibility::read(file, *rough_terrain(3, 4)), globe::Error);
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THROW(Visibility::read(file, *terrain), globe::Error);
  std::ofstream(file) << "something else";
  EXPECT_THROW(Visibility::read(file, *terrain), globe::Error);
}

}  // namespace
