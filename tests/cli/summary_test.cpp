#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

class SummaryCommand : public testing::Test {
 protected:
  Outcome ask(std::vector<std::string> words) const {
    words.insert(words.begin(), {"summary", planet_});
    return run_program(words);
  }
  json summary(std::vector<std::string> words) const {
    words.push_back("--json");
    const Outcome run = ask(words);
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
  }
  json height(const json& at) const {
    std::ostringstream place;
    place << at[0] << ',' << at[1];
    return json::parse(run_program({"height", planet_, "--json", place.str()}).out)["height_m"];
  }

  tests::TemporaryFolder folder_;
  std::string planet_ = cli::make_planet(folder_.path(), {"--level", "6"});
};

TEST_F(SummaryCommand, AnswersTheKeysOfTheContractInOrder) {
  const Outcome run = ask({"--cone", "10,20,2000km", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  std::vector<std::string> keys;
  const auto object = nlohmann::ordered_json::parse(run.out);
  for (const auto& item : object.items()) keys.push_back(item.key());
  EXPECT_EQ(keys, (std::vector<std::string>{"min_m", "mean_m", "max_m", "min_at", "max_at", "area_km2",
                                            "samples", "level", "source", "datum"}));
  EXPECT_EQ(object["level"], 6);
  EXPECT_EQ(object["source"], "data");
  EXPECT_EQ(object["datum"], "unknown");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST_F(SummaryCommand, PlacesAreInTheRegionAndHaveTheHeightsNamed) {
  const json found = summary({"--box", "10,-20,60,40"});
  for (const char* which : {"min", "max"}) {
    const json at = found[std::string(which) + "_at"];
    EXPECT_GE(at[0].get<double>(), -20.0);
    EXPECT_LE(at[0].get<double>(), 40.0);
    EXPECT_GE(at[1].get<double>(), 10.0);
    EXPECT_LE(at[1].get<double>(), 60.0);
    EXPECT_NEAR(found[std::string(which) + "_m"].get<double>(), height(at).get<double>(), 1e-6);
  }
  EXPECT_LE(found["min_m"], found["mean_m"]);
  EXPECT_LE(found["mean_m"], found["max_m"]);
}

TEST_F(SummaryCommand, OfTheWholePlanetIsTheRangeOfItsLayer) {
  const json layer = json::parse(run_program({"info", planet_, "--json"}).out)["layers"][0];
  const json found = summary({"--box=-180,-90,180,90"});
  EXPECT_EQ(found["min_m"], layer["min"]);
  EXPECT_EQ(found["max_m"], layer["max"]);
  EXPECT_EQ(found["samples"], 4 * 64 * 64 + 2);
  EXPECT_NEAR(found["area_km2"].get<double>(), 510065621.724, 0.001);  // WGS84 (Moritz 2000)
  EXPECT_EQ(summary({"--cone", "3,4,180deg"}), found);
}

TEST_F(SummaryCommand, TwoHalvesMakeTheWhole) {
  const std::vector<std::string> cone{"--cone", "-30,170,40deg"};
  auto rest = cone;
  rest.push_back("--complement");
  const json in = summary(cone), out = summary(rest), all = summary({"--cone", "0,0,180deg"});
  EXPECT_EQ(in["samples"].get<int>() + out["samples"].get<int>(), all["samples"].get<int>());
  EXPECT_EQ(std::min(in["min_m"], out["min_m"]), all["min_m"]);
  EXPECT_EQ(std::max(in["max_m"], out["max_m"]), all["max_m"]);
  const double area_in = in["area_km2"], area_out = out["area_km2"], area = all["area_km2"];
  EXPECT_NEAR((area_in + area_out) / area, 1.0, 1e-5);
  EXPECT_NEAR((area_in * in["mean_m"].get<double>() + area_out * out["mean_m"].get<double>()) / area,
              all["mean_m"].get<double>(), 0.05);
}

TEST_F(SummaryCommand, WithoutANodeAnswersTheSurfaceBetweenThem) {
  const json small = summary({"--cone", "10.3,20.4,1km"});
  EXPECT_EQ(small["samples"], 0);
  EXPECT_NEAR(small["area_km2"].get<double>(), M_PI, 1e-3);
  const double middle = height({10.3, 20.4}).get<double>();
  EXPECT_LT(small["min_m"], small["max_m"]);
  EXPECT_NEAR(small["mean_m"].get<double>(), middle, 0.1);
  const json point = summary({"--cone", "10.3,20.4,0"});
  EXPECT_EQ(point["area_km2"], 0.0);
  EXPECT_NEAR(point["min_m"].get<double>(), middle, 1e-3);
  EXPECT_EQ(point["min_m"], point["max_m"]);
  EXPECT_NEAR(point["max_at"][0].get<double>(), 10.3, 1e-6);
}

TEST_F(SummaryCommand, OfAnEmptyRegionIsEmptyAndASuccess) {
  const json none = summary({"--cone", "0,0,180deg", "--complement"});
  EXPECT_EQ(none["samples"], 0);
  EXPECT_EQ(none["area_km2"], 0.0);
  for (const char* key : {"min_m", "mean_m", "max_m", "min_at", "max_at"})
    EXPECT_TRUE(none[key].is_null()) << key;
  EXPECT_NE(ask({"--cone", "0,0,180deg", "--complement"}).out.find("min_m -\n"), std::string::npos);
}

TEST_F(SummaryCommand, TextHasALineANumber) {
  const json found = summary({"--cone", "10,20,2000km", "--precision", "3"});
  const Outcome run = ask({"--cone", "10,20,2000km", "--precision", "3"});
  std::istringstream words(run.lines().at(2));
  std::string name;
  double high = 0, lat = 0, lon = 0;
  words >> name >> high >> lat >> lon;
  EXPECT_EQ(name, "max_m");
  EXPECT_EQ(high, found["max_m"].get<double>());
  EXPECT_EQ(lat, found["max_at"][0].get<double>());
  EXPECT_EQ(lon, found["max_at"][1].get<double>());
  EXPECT_EQ(run.lines().size(), 8u);
}

TEST_F(SummaryCommand, OfAnOlderPlanetWithoutMeansIsTheSame) {
  const std::vector<std::string> region{"--polygon", "0,0 30,70 -40,50"};
  const json with = summary(region);
  std::ifstream in(planet_ + "/planet.json");
  nlohmann::ordered_json file = nlohmann::ordered_json::parse(in);
  auto& layers = file["layers"];
  EXPECT_EQ(layers.back()["name"], "height_mean");
  layers.erase(layers.size() - 1);
  std::ofstream(planet_ + "/planet.json") << file.dump();
  json without = summary(region);
  EXPECT_NEAR(with["mean_m"].get<double>(), without["mean_m"].get<double>(), 1e-3);
  without["mean_m"] = with["mean_m"];
  EXPECT_EQ(with, without);
}

TEST_F(SummaryCommand, MakesTheGroundWhereThereAreNoData) {
  const json deep = summary({"--cone", "10.3,20.4,20km", "--level", "14"});
  EXPECT_EQ(deep["level"], 14);
  EXPECT_EQ(deep["source"], "synthesised");
  EXPECT_GT(deep["samples"], 1000);
  const Outcome builtin = run_program({"summary", "procedural", "--json", "--cone", "0,0,500km"});
  EXPECT_EQ(builtin.status, 0) << builtin.err;
  EXPECT_EQ(json::parse(builtin.out)["source"], "synthesised");
  const Outcome refused = run_program({"summary", "procedural", "--cone", "0,0,90deg", "--level", "16"});
  EXPECT_EQ(refused.status, 1);
  EXPECT_EQ(refused.out, "");
  EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
}

TEST_F(SummaryCommand, RefusesWhatItCannotUse) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"summary"},
                                                {"summary", planet_},
                                                {"summary", planet_, "--cone", "1,2"},
                                                {"summary", planet_, "--cone", "1,2,3km", "--box", "1,2,3,4"},
                                                {"summary", planet_, "--cone", "1,2,3km", "--level", "29"}}) {
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.substr(0, 7), "globe: ");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
  EXPECT_EQ(run_program({"summary", folder_.path().string(), "--cone", "1,2,3km"}).status, 1);
}

}  // namespace
