#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/run_program.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

constexpr double kError = 15e-9;  // metres

std::vector<double> numbers(const std::string& line) {
  std::istringstream words(line);
  std::vector<double> all;
  for (double number = 0; words >> number;) all.push_back(number);
  return all;
}

double metres(const std::string& a, const std::string& b, std::vector<std::string> options = {}) {
  options.insert(options.begin(), {"distance", a, b});
  const Outcome run = run_program(options);
  EXPECT_EQ(run.status, 0) << run.out << run.err;
  const auto found = numbers(run.out);
  EXPECT_EQ(found.size(), 3u) << run.out;
  return found.empty() ? NAN : found[0];
}

TEST(Distance, FromNewYorkToLondonIs5552Kilometres) {
  // The example of GeographicLib's Geodesic.hpp.
  EXPECT_NEAR(metres("40.6 -73.8", "51.6 -0.5"), 5551.76e3, 5.0);
  EXPECT_NEAR(metres("40.6 -73.8", "51.6 -0.5", {"--ellipsoid", "6378137,0"}), 5551.76e3, 20e3);
}

TEST(Distance, AnswersTheKeysOfTheContract) {
  EXPECT_EQ(
      run_program({"distance", "--json", "0 0", "0 1"}).out,
      R"({"lat1":0.0,"lon1":0.0,"lat2":0.0,"lon2":1.0,"s12_m":111319.49079327357,"azi1":90.0,"azi2":90.0,)"
      R"("ellipsoid":"wgs84"})"
      "\n");
  EXPECT_EQ(run_program({"distance", "--csv", "--precision", "3", "0 0", "0 1"}).out,
            "lat1,lon1,lat2,lon2,s12_m,azi1,azi2\n0.000,0.000,0.000,1.000,111319.491,90.000,90.000\n");
  EXPECT_EQ(run_program({"distance", "0 0", "0 1", "--precision=1"}).out, "111319.5 90.0 90.0\n");
}

TEST(Distance, TakesEveryNotationOnALine) {
  const double expected = metres("48.5 11.5", "-33 151.25");
  const Outcome run = run_program({"distance"},
                                  "48.5 11.5 -33 151.25\n48.5,11.5 -33,151.25\n48.5, 11.5, -33, 151.25\n"
                                  "48.5,11.5;-33,151.25\n48.5 11.5 ; -33 151.25\n"
                                  "48.5 11.5 100 -33 151.25 200\n48d30'N 11d30'E 33d0'S 151d15'E\n"
                                  "48.5 11.5 1km ; 33S 151d15'E\n33TWN8000090000 33TWN8000080000\n"
                                  "33N 500000 4000000 33N 500000 4100000\n");
  EXPECT_EQ(run.status, 0) << run.out;
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 10u);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(numbers(lines[k]).at(0), expected, kError) << k;
  EXPECT_NEAR(numbers(lines[8]).at(0), 10000.0, 10.0);
  EXPECT_NEAR(numbers(lines[9]).at(0), 100000.0, 100.0);
}

TEST(Distance, OfAPlaceToItselfIsNothing) {
  const Outcome run = run_program({"distance"},
                                  "0 0 0 0\n90 0 90 0\n-90 17 -90 17\n12.5 -180 12.5 -180\n"
                                  "-33.9 18.4 -33.9 18.4\n5 180 5 -180\n90 10 90 -50\n");
  ASSERT_EQ(run.lines().size(), 7u);
  for (const std::string& line : run.lines()) EXPECT_EQ(numbers(line).at(0), 0.0) << line;
}

TEST(Distance, BetweenOppositePlacesGoesByTheNorthPole) {
  for (const char* options : {"wgs84", "6371008.8,0"}) {
    const auto found = numbers(run_program({"distance", "30 20", "-30 -160", "--ellipsoid", options}).out);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[1], 0.0) << options;
    EXPECT_EQ(found[2], 180.0) << options;
  }
  // Along the equator the ellipsoid is longer than over the pole.
  EXPECT_NEAR(metres("0 0", "0 180"), metres("90 0", "-90 0"), kError);
  const auto poles = numbers(run_program({"distance", "90 17", "-90 17"}).out);
  EXPECT_NEAR(poles[0], 2.0 * 10001965.7293, 1e-3);  // the quarter meridian of WGS84
}

TEST(Distance, IsTheSameBothWays) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> lat(-90, 90), lon(-180, 180);
  std::string there, back;
  for (int k = 0; k < 2000; ++k) {
    const std::string a = std::to_string(lat(random)) + ' ' + std::to_string(lon(random));
    const std::string b = std::to_string(lat(random)) + ' ' + std::to_string(lon(random));
    there.append(a).append(" ").append(b).append("\n");
    back.append(b).append(" ").append(a).append("\n");
  }
  const auto out = run_program({"distance"}, there).lines(), home = run_program({"distance"}, back).lines();
  ASSERT_EQ(out.size(), 2000u);
  ASSERT_EQ(home.size(), 2000u);
  for (std::size_t k = 0; k < out.size(); ++k)
    ASSERT_NEAR(numbers(out[k]).at(0), numbers(home[k]).at(0), kError) << out[k];
}

TEST(Distance, TakesTheEllipsoid) {
  constexpr double kQuarter = M_PI / 2.0;
  EXPECT_NEAR(metres("0 0", "90 0", {"--ellipsoid", "moon"}), kQuarter * 1737400.0, kError);
  EXPECT_NEAR(metres("0 0", "0 90", {"--ellipsoid", "100,1/2"}), kQuarter * 100.0, 1e-12);
  // A quarter of the ellipse with axes 100 and 50: Ramanujan's second formula, good to 1e-6 there.
  const double h = 1.0 / 9.0;
  const double ellipse = M_PI * 150.0 * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
  EXPECT_NEAR(metres("0 0", "90 0", {"--ellipsoid", "100,1/2"}), ellipse / 4.0, 1e-4);
}

TEST(Distance, AnswersBadPairsOnTheirOwnLineAndGoesOn) {
  const Outcome run = run_program({"distance"},
                                  "# pairs\n1 2 3 4\n1 2 3\n1 2 nan 4\n91 0 0 0\n1 2 3 4 5\n1,,2 3 4\n"
                                  "1 2 ; 3 4 ; 5 6\n;\n\n0 0 0 0\n");
  EXPECT_EQ(run.status, 1);
  const auto lines = run.lines();
  ASSERT_EQ(lines.size(), 11u) << run.out;
  for (const std::size_t bad : {2u, 3u, 4u, 5u, 6u, 7u, 8u})
    EXPECT_EQ(lines[bad].substr(0, 7), "ERROR: ") << lines[bad];
  EXPECT_EQ(lines[0], "# pairs");
  EXPECT_EQ(lines[9], "");
  EXPECT_EQ(numbers(lines[10]).at(0), 0.0);
  const Outcome strict = run_program({"distance", "--strict", "--json"}, "1 2 3\n0 0 0 0\n");
  EXPECT_EQ(strict.status, 1);
  ASSERT_EQ(strict.lines().size(), 1u);
  EXPECT_EQ(json::parse(strict.out)["line"], 1);
}

TEST(Distance, RefusesWhatItCannotMean) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"distance", "1 2"},
                                                {"distance", "1 2", "3 4", "5 6"},
                                                {"distance", "1 2", "3 4", "--ellipsoid", "pluto"},
                                                {"distance", "1 2", "3 4", "--ellipsoid", "1,0.999"},
                                                {"distance", "1 2", "3 4", "--ellipsoid", "-1,0"}}) {
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, 2) << run.out;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

TEST(Distance, AnswersEachLineBeforeTheNextIsWritten) {
  cli::Conversation talk({"distance"});
  EXPECT_EQ(talk.ask("0 0 0 1"), "111319.49079327357 90 90");
  EXPECT_TRUE(talk.ask("0 0 0").starts_with("ERROR: line 2: "));
  EXPECT_EQ(talk.ask("0 0 0 0"), "0 180 180");
}

TEST(Distance, ManyLinesComeBackInOrder) {
  std::string lines;
  for (int k = 0; k < 30000; ++k) lines += "0 0 0 " + std::to_string(k % 90) + ".5\n";
  const auto answers = run_program({"distance", "--precision", "0"}, lines).lines();
  ASSERT_EQ(answers.size(), 30000u);
  for (std::size_t k = 0; k < answers.size(); ++k)
    ASSERT_NEAR(numbers(answers[k]).at(0), (static_cast<double>(k % 90) + 0.5) * 111319.49079, 1.0);
}

}  // namespace
