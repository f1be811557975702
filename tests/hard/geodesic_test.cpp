// H9, H10: distances as the command line answers them, against Karney's test set and the sphere's truth.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "app/accuracy/vincenty.h"
#include "globe/base/angles.h"
#include "globe/geo/ellipsoid.h"
#include "globe/geo/geodesic.h"
#include "tests/cli/run_program.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"

namespace {

using globe::kDegree;
using globe::geo::Geodetic;

constexpr double kGeodesicError = 15e-9;  ///< metres; HARD-CASES H9
constexpr double kSphereError = 5e-9;     ///< metres; HARD-CASES H10
constexpr double kSphereRadius = 6371008.8;

struct GeodesicPair {
  Geodetic a, b;
};

std::string digits(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// What `globe distance` answers to pairs on its standard input: {s12, azi1, azi2} a line.
std::vector<std::array<double, 3>> ask(const std::vector<GeodesicPair>& pairs,
                                       std::vector<std::string> options = {}) {
  std::string lines;
  for (const GeodesicPair& pair : pairs) {
    lines += digits(pair.a.lat_deg) + ' ' + digits(pair.a.lon_deg) + ' ' + digits(pair.b.lat_deg) + ' ' +
             digits(pair.b.lon_deg) + '\n';
  }
  options.insert(options.begin(), "distance");
  const cli::Outcome run = cli::run_program(options, lines);
  EXPECT_EQ(run.status, 0) << run.err;
  std::vector<std::array<double, 3>> answers;
  for (const std::string& line : run.lines()) {
    std::istringstream words(line);
    std::array<double, 3> numbers{};
    for (double& number : numbers) EXPECT_TRUE(words >> number) << line;
    answers.push_back(numbers);
  }
  EXPECT_EQ(answers.size(), pairs.size());
  return answers;
}

TEST(HardGeodesic, KarneysTestSetIsAnsweredWithin15Nanometres) {
  // The kinds of lines in file order are told in geodtest500.txt beside the file.
  constexpr std::size_t kLines = 500, kFirstNearAntipodal = 100, kNearAntipodal = 120;
  const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / ".." / "geodtest500.dat";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "TEST SET MISSING: " << path;
  std::vector<GeodesicPair> pairs;
  std::vector<std::array<double, 3>> truth;
  std::vector<double> m12;  // what an end moves sideways, a radian of azimuth
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    double lat1 = 0, lon1 = 0, azi1 = 0, lat2 = 0, lon2 = 0, azi2 = 0, s12 = 0, a12 = 0, m = 0;
    ASSERT_TRUE(words >> lat1 >> lon1 >> azi1 >> lat2 >> lon2 >> azi2 >> s12 >> a12 >> m) << line;
    pairs.push_back({{lat1, lon1}, {lat2, lon2}});
    truth.push_back({s12, azi1, azi2});
    m12.push_back(std::abs(m));
  }
  ASSERT_EQ(pairs.size(), kLines);
  const auto answers = ask(pairs);
  double worst = 0, worst_aside = 0;
  std::size_t unsettled = 0;
  for (std::size_t k = 0; k < kLines; ++k) {
    ASSERT_TRUE(std::isfinite(answers[k][0]) && std::isfinite(answers[k][1]) && std::isfinite(answers[k][2]));
    worst = std::max(worst, std::abs(answers[k][0] - truth[k][0]));
    for (const std::size_t end : {1u, 2u}) {
      const double turn = std::remainder(answers[k][end] - truth[k][end], 360.0);
      worst_aside = std::max(worst_aside, std::abs(turn) * kDegree * m12[k]);
    }
    const bool near_antipodal = k >= kFirstNearAntipodal && k < kFirstNearAntipodal + kNearAntipodal;
    if (near_antipodal && !app::accuracy::vincenty(globe::geo::kWgs84, pairs[k].a, pairs[k].b)) ++unsettled;
  }
  EXPECT_LE(worst, kGeodesicError);
  EXPECT_LE(worst_aside, kGeodesicError);
  EXPECT_GT(unsettled, kNearAntipodal / 4) << "Vincenty must fail between near-antipodal places";
  const double share = 100.0 * static_cast<double>(unsettled) / static_cast<double>(kNearAntipodal);
  hard::report("H9", "geodesics by the command line, 500 of Karney's, nm", "15",
               hard::figure(worst * 1e9) + ", by azimuth " + hard::figure(worst_aside * 1e9) +
                   " (Vincenty: " + hard::figure(share) +
                   " % of near-antipodal pairs do not settle in 100 rounds)");
}

TEST(HardGeodesic, VincentyAgreesWhereItSettles) {
  const globe::geo::GeodesicSolver solver(globe::geo::kWgs84);
  const auto settled = app::accuracy::vincenty(globe::geo::kWgs84, {50, 8}, {-33, 151});
  ASSERT_TRUE(settled.has_value());
  EXPECT_NEAR(*settled, solver.inverse({50, 8}, {-33, 151}).s12_m, 1e-3);  // its own error is 0.5 mm
}

/// On a sphere, from exact degrees: atan2 of sine and cosine in quadruple precision.
double true_distance(const GeodesicPair& pair) {
  const auto vector = [](const Geodetic& at) {
    const auto lat = hard::quad_sine_cosine(at.lat_deg), lon = hard::quad_sine_cosine(at.lon_deg);
    return hard::QuadVector{lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
  };
  const hard::QuadVector u = vector(pair.a), v = vector(pair.b);
  const hard::QuadVector across = hard::cross(u, v);
  const auto length = static_cast<long double>(dot(across, across));
  const auto along = static_cast<long double>(dot(u, v));
  return static_cast<double>(static_cast<long double>(kSphereRadius) * std::atan2(std::sqrt(length), along));
}

double by_acos(const GeodesicPair& pair) {
  const double p = pair.a.lat_deg * kDegree, q = pair.b.lat_deg * kDegree;
  const double lon = (pair.b.lon_deg - pair.a.lon_deg) * kDegree;
  const double cosine = std::sin(p) * std::sin(q) + std::cos(p) * std::cos(q) * std::cos(lon);
  return kSphereRadius * std::acos(std::clamp(cosine, -1.0, 1.0));
}

double by_haversine(const GeodesicPair& pair) {
  const double p = pair.a.lat_deg * kDegree, q = pair.b.lat_deg * kDegree;
  const double s = std::sin((q - p) / 2.0);
  const double t = std::sin((pair.b.lon_deg - pair.a.lon_deg) * kDegree / 2.0);
  return 2.0 * kSphereRadius * std::asin(std::min(1.0, std::sqrt(s * s + std::cos(p) * std::cos(q) * t * t)));
}

/// Pairs whose separation, or distance from the antipode, is log-uniform from 0.1 mm to the whole sphere,
/// poles, the equator and the antimeridian among them.
std::vector<GeodesicPair> pairs_at_every_separation(std::size_t count) {
  std::mt19937_64 random(1010);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<GeodesicPair> pairs;
  while (pairs.size() < count) {
    Geodetic a{std::asin(unit(random)) / kDegree, 180.0 * unit(random)};
    if (pairs.size() % 10 == 0) a.lat_deg = 0.0;
    if (pairs.size() % 10 == 1) a.lat_deg = 90.0;
    if (pairs.size() % 10 == 2) a.lon_deg = -180.0;
    const double span_deg = 180.0 * std::pow(10.0, 5.65 * (unit(random) - 1.0));  // 0.1 mm to the antipode
    const double turn = std::numbers::pi * unit(random);
    const double lat = std::clamp(a.lat_deg + span_deg * std::cos(turn), -90.0, 90.0);
    const double across = std::max(std::cos(a.lat_deg * kDegree), 1e-3);
    Geodetic b{lat, std::remainder(a.lon_deg + span_deg * std::sin(turn) / across, 360.0)};
    if (pairs.size() % 2 == 0) b = {-b.lat_deg, std::remainder(b.lon_deg + 180.0, 360.0)};
    pairs.push_back({a, b});
  }
  return pairs;
}

TEST(HardGeodesic, DistanceOnTheSphereIsRightAtEverySeparation) {
  const std::vector<GeodesicPair> pairs = pairs_at_every_separation(hard::cases(200000));
  const auto answers = ask(pairs, {"--ellipsoid", digits(kSphereRadius) + ",0"});
  double worst = 0, worst_acos = 0, worst_haversine = 0, shortest = 1e9, longest = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double truth = true_distance(pairs[k]);
    shortest = std::min(shortest, truth);
    longest = std::max(longest, truth);
    worst = std::max(worst, std::abs(answers[k][0] - truth));
    worst_acos = std::max(worst_acos, std::abs(by_acos(pairs[k]) - truth));
    worst_haversine = std::max(worst_haversine, std::abs(by_haversine(pairs[k]) - truth));
  }
  EXPECT_LT(shortest, 1e-3);
  EXPECT_GT(longest, std::numbers::pi * kSphereRadius - 1e-3);
  EXPECT_LE(worst, kSphereError);
  EXPECT_GT(worst_acos, 1e-2) << "the arc cosine must fail";
  EXPECT_GT(worst_haversine, 1e-5) << "the haversine must fail";
  hard::report("H10", "distance on the sphere at every separation, nm", "5",
               hard::figure(worst * 1e9) + " (acos " + hard::figure(worst_acos) + " m, haversine " +
                   hard::figure(worst_haversine) + " m)");
}

}  // namespace
