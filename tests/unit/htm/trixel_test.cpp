#include "globe/htm/trixel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/predicates.h"
#include "tests/hard/directions.h"

namespace globe::htm {
namespace {

using hard::random_direction;

std::vector<Trixel> all_trixels(int level) {
  std::vector<Trixel> all;
  for (std::uint64_t id = kFirstRoot << (2 * level); id < (kFirstRoot + kRoots) << (2 * level); ++id)
    all.push_back({id});
  return all;
}

Trixel random_trixel(std::mt19937_64& random, int level) {
  return {(kFirstRoot + random() % kRoots) << (2 * level) | (random() & ((1ULL << (2 * level)) - 1))};
}

TEST(Trixel, RootsAreThePublishedOnes) {
  const dvec3 v0{0, 0, 1}, v1{1, 0, 0}, v2{0, 1, 0}, v3{-1, 0, 0}, v4{0, -1, 0}, v5{0, 0, -1};
  const std::vector<std::pair<std::string, Corners>> published{
      {"S0", {v1, v5, v2}}, {"S1", {v2, v5, v3}}, {"S2", {v3, v5, v4}}, {"S3", {v4, v5, v1}},
      {"N0", {v1, v0, v4}}, {"N1", {v4, v0, v3}}, {"N2", {v3, v0, v2}}, {"N3", {v2, v0, v1}}};
  std::uint64_t id = 8;
  for (const auto& [expected_name, expected_corners] : published) {
    EXPECT_EQ(name({id}), expected_name);
    EXPECT_EQ(corners({id}), expected_corners);
    ++id;
  }
}

TEST(Trixel, IdsOutsideEveryLevelAreRefused) {
  for (const std::uint64_t id : {0ULL, 1ULL, 7ULL, 16ULL, 31ULL, 64ULL, 127ULL, 1ULL << 60, ~0ULL})
    EXPECT_FALSE(trixel_from_id(id)) << id;
  for (const std::uint64_t id : {8ULL, 15ULL, 32ULL, 63ULL, 8ULL << 56, (16ULL << 56) - 1})
    EXPECT_TRUE(trixel_from_id(id)) << id;
}

TEST(Trixel, NamesThatAreNoneAreRefused) {
  for (const char* text :
       {"", "N", "S", "X0", "N4", "N01x", "0N", "N0 1", "N-1", "N0123012301230123012301230123012"})
    EXPECT_FALSE(trixel_from_name(text)) << text;
  EXPECT_EQ(trixel_from_name("n012"), trixel_from_name("N012"));
}

TEST(Trixel, NameAndIdAreInversesAtEveryLevel) {
  std::mt19937_64 random(4);
  for (int depth = 0; depth <= kMaxLevel; ++depth) {
    for (int trial = 0; trial < 200; ++trial) {
      const Trixel t = random_trixel(random, depth);
      EXPECT_EQ(level(t), depth);
      EXPECT_EQ(trixel_from_id(t.id), t);
      EXPECT_EQ(trixel_from_name(name(t)), t);
    }
  }
  EXPECT_EQ(name({(12 << 4) | 6}), "N012");
}

struct CatalogueRow {
  double lat_deg, lon_deg;
  const char* name;
};

TEST(Trixel, AgreesWithTheNamesOfSkyServerAtLevel20) {
  // SDSS SkyServer, fHtmEq and fHtmGetString, as quoted in the tests of desitarget (py/desitarget/htm.py).
  for (const CatalogueRow& row :
       {CatalogueRow{16.22908364, 287.87029928, "N023330222213310122202"},
        CatalogueRow{-53.49629596, 223.95814592, "S233100021230000131322"},
        CatalogueRow{24.40112077, 328.99793884, "N031100100010011323332"},
        CatalogueRow{-23.14789754, 127.24251626, "S131112210233032311131"},
        CatalogueRow{0, 10, "N320010020010020010020"}, CatalogueRow{0, 45, "N302000000000000000000"},
        CatalogueRow{0, 350, "N000020010020010020010"}})
    EXPECT_EQ(name(trixel_at(geo::normal_from_degrees(row.lat_deg, row.lon_deg), 20)), row.name);
}

TEST(Trixel, AgreesWithSkyServerOnTheOctahedronsCorners) {
  for (const CatalogueRow& row : {CatalogueRow{90, 0, "N31000000000"}, CatalogueRow{0, 0, "N32000000000"},
                                  CatalogueRow{0, 90, "N22000000000"}, CatalogueRow{0, 180, "N12000000000"},
                                  CatalogueRow{0, 270, "N02000000000"}, CatalogueRow{-90, 0, "S01000000000"}})
    EXPECT_EQ(name(trixel_at(geo::normal_from_degrees(row.lat_deg, row.lon_deg), 10)), row.name);
}

TEST(Trixel, AgreesWithTheIdsOfOtherLibraries) {
  struct Row {
    double lat_deg, lon_deg;
    int level;
    std::uint64_t id;
  };
  for (const Row& row : {Row{16.22908364, 287.87029928, 20, 14015193368226},   // SDSS SkyServer
                         Row{-53.49629596, 223.95814592, 20, 12043250829178},  // SDSS SkyServer
                         Row{-23.14789754, 127.24251626, 20, 10813196528989},  // SDSS SkyServer
                         Row{45.3, 23.5, 20, 17375844608553},      // SkyNode, fHtmLookupEq(23.5, 45.3)
                         Row{24.3, 115.25, 10, 15368378},          // esutil (JHU C++)
                         Row{10.1234, -20.1234, 14, 3278525534}})  // PynyHTM (libtinyhtm)
    EXPECT_EQ(trixel_at(geo::normal_from_degrees(row.lat_deg, row.lon_deg), row.level).id, row.id);
}

TEST(Trixel, CornersRunCounterClockwise) {
  for (int depth = 0; depth <= 5; ++depth) {
    for (const Trixel t : all_trixels(depth)) {
      const Corners c = corners(t);
      EXPECT_EQ(orientation(c[0], c[1], c[2]).sign, 1) << name(t);
    }
  }
}

TEST(Trixel, ChildKeepsItsCornerAndTheMiddleKeepsNone) {
  std::mt19937_64 random(5);
  for (int depth = 0; depth < kMaxLevel; ++depth) {
    const Trixel t = random_trixel(random, depth);
    const Corners own = corners(t);
    for (int k = 0; k < 4; ++k) {
      const Trixel c = child(t, k);
      EXPECT_EQ(parent(c), t);
      EXPECT_EQ(corners(c), child_corners(own, k));
      for (const dvec3& corner : own) {
        const Corners theirs = corners(c);
        const bool kept = std::find(theirs.begin(), theirs.end(), corner) != theirs.end();
        EXPECT_EQ(kept, k < 3 && corner == own[static_cast<std::size_t>(k)]);
      }
    }
  }
}

/// The neighbour across edge k has the ends of that edge bit for bit, runs along it the other way, and has us
/// as its neighbour there.
void expect_neighbors_fit(Trixel t) {
  const Corners c = corners(t);
  const auto around = neighbors(t);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(level(around[k]), level(t)) << name(t);
    const Corners theirs = corners(around[k]);
    const auto back = neighbors(around[k]);
    bool fits = false;
    for (std::size_t m = 0; m < 3; ++m)
      fits |= theirs[(m + 1) % 3] == c[(k + 2) % 3] && theirs[(m + 2) % 3] == c[(k + 1) % 3] && back[m] == t;
    ASSERT_TRUE(fits) << name(t) << " across edge " << k << " to " << name(around[k]);
  }
}

TEST(Trixel, NeighborsShareTheEdgeBitForBitEverywhereToLevel6) {
  for (int depth = 0; depth <= 6; ++depth) {
    for (const Trixel t : all_trixels(depth)) expect_neighbors_fit(t);
  }
}

TEST(Trixel, NeighborsShareTheEdgeBitForBitAtEveryDeeperLevel) {
  std::mt19937_64 random(6);
  for (int depth = 7; depth <= kMaxLevel; ++depth) {
    for (int trial = 0; trial < 300; ++trial) expect_neighbors_fit(random_trixel(random, depth));
    for (int root = 0; root < kRoots; ++root) {
      for (int k = 0; k < 3; ++k) {  // the trixels at the octahedron's corners
        Trixel t{kFirstRoot + static_cast<std::uint64_t>(root)};
        t = child(t, k);
        while (level(t) < depth) t = child(t, 0);
        expect_neighbors_fit(t);
      }
    }
  }
}

TEST(Trixel, OwnsItsCenterAtEveryLevel) {
  std::mt19937_64 random(7);
  for (int depth = 0; depth <= kMaxLevel; ++depth) {
    for (int trial = 0; trial < 300; ++trial) {
      const Trixel t = random_trixel(random, depth);
      EXPECT_EQ(trixel_at(center(t), depth), t) << name(t);
    }
  }
}

TEST(Trixel, AtIsTheChildOfTheTrixelAtOneLevelLess) {
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 2000; ++trial) {
    const dvec3 u = random_direction(random);
    const Trixel deepest = trixel_at(u, kMaxLevel);
    for (int depth = 0; depth <= kMaxLevel; ++depth)
      ASSERT_EQ(trixel_at(u, depth).id, deepest.id >> (2 * (kMaxLevel - depth)));
  }
}

TEST(Trixel, AtDoesNotDependOnTheLengthOfTheVector) {
  std::mt19937_64 random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const dvec3 u = random_direction(random);
    for (const double power_of_two : {0x1p-60, 0.5, 2.0, 0x1p40})
      ASSERT_EQ(trixel_at(power_of_two * u, kMaxLevel), trixel_at(u, kMaxLevel));
  }
}

TEST(Trixel, AtCountsTheExactTests) {
  std::uint64_t exact_calls = 0;
  trixel_at(glm::normalize(dvec3{0.3, 0.5, 0.7}), 20, &exact_calls);
  EXPECT_EQ(exact_calls, 0u);
  trixel_at({1, 0, 0}, 20, &exact_calls);
  EXPECT_EQ(exact_calls, 0u);  // a corner is well inside its own quarter
  trixel_at(glm::normalize(dvec3{1, 0, 1}), 20, &exact_calls);
  EXPECT_GT(exact_calls, 0u);
}

TEST(Trixel, ManyAtATimeAreTheSameAsOneByOne) {
  std::mt19937_64 random(10);
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<dvec3> points;
    for (std::size_t k = 0; k < count; ++k)
      points.push_back(k % 5 == 0 ? corners(random_trixel(random, 12))[k % 3] : random_direction(random));
    std::vector<Trixel> together(count), one_by_one;
    std::uint64_t exact_together = 0, exact_one_by_one = 0;
    trixels_at(points, 20, together, &exact_together);
    for (const dvec3& u : points) one_by_one.push_back(trixel_at(u, 20, &exact_one_by_one));
    EXPECT_EQ(together, one_by_one);
    EXPECT_EQ(exact_together, exact_one_by_one);
  }
}

TEST(Trixel, OppositeAxesFallToTheDocumentedRoots) {
  EXPECT_EQ(name(root_at({0, 0, 1})), "N3");
  EXPECT_EQ(name(root_at({0, 0, -1})), "S0");
  EXPECT_EQ(name(root_at({1, 0, -1})), "S0");
  EXPECT_EQ(name(root_at({0, 1, 0})), "N2");
  EXPECT_EQ(name(root_at({-1, 0, -0.0})), "N1");
  EXPECT_EQ(name(root_at({-0.0, -1, 0})), "N0");
  EXPECT_EQ(name(root_at({-0.0, -0.0, 1})), "N3");
}

}  // namespace
}  // namespace globe::htm
