#include "globe/effects/list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "globe/effects/bright_stars.h"
#include "tests/unit/scene/expect_refusal.h"

namespace globe::effects {
namespace {

scene::Scene parse(const std::string& text) { return scene::parse_scene(text, "s.toml", effect_kinds()); }

std::shared_ptr<const planet::Surface> builtin() {
  static const auto surface = planet::Surface::builtin(1);
  return surface;
}

std::vector<render::NamedEffect> made(const std::string& text) {
  return make_effects(parse(text), *builtin());
}

void expect_refused(const std::string& text, const std::string& begin, const std::string& part) {
  scene_tests::expect_refusal([&] { made(text); }, begin, part);
}

TEST(EffectList, NamesAreUniqueAndSpeltForScenes) {
  std::set<std::string_view> names;
  for (const EffectEntry& entry : all_effects()) {
    EXPECT_TRUE(names.insert(entry.kind.name).second) << entry.kind.name;
    EXPECT_EQ(entry.kind.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string_view::npos);
  }
  EXPECT_GE(names.size(), 4u);
}

TEST(EffectList, MakesWhatASceneNamesInTheListsOrder) {
  EXPECT_TRUE(made("").empty());
  const auto effects = made("[effects.fog]\n[effects.stars]\n");
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[0].name, "stars");
  EXPECT_EQ(effects[1].name, "fog");
}

TEST(EffectList, RefusesInOneLineWhatMakesNoSense) {
  expect_refused("[effects.fgo]\n", "s.toml:1: effects.fgo: there is no effect \"fgo\"",
                 "did you mean \"fog\"?");
  expect_refused("[effects.fog]\nvisibilty = 3\n", "s.toml:2: effects.fog.visibilty", "visibility");
  expect_refused("[effects.fog]\nvisibility = -3\n", "s.toml:2: effects.fog.visibility", "");
  expect_refused("[effects.fog]\nthickness = \"3 s\"\n", "s.toml:2: effects.fog.thickness", "");
  expect_refused("[[effects]]\nname = \"fog\"\n[[effects]]\nname = \"fog\"\n", "s.toml:3: effects.fog",
                 "leave one of them out");
  expect_refused("[effects.stars]\nfaintest = 9\n", "s.toml:2: effects.stars.faintest", "");
  expect_refused("[effects.lens_flare]\nstrength = -1\n", "s.toml:2: effects.lens_flare.strength", "");
  expect_refused("[effects.color_bands]\nslopes_from = 80\n", "s.toml:2: effects.color_bands.slopes_from",
                 "cliffs_from");
  expect_refused(
      "[effects.color_bands]\n[[effects.color_bands.bands]]\nbelow = 20\ncolor = \"ffffff\"\n"
      "[[effects.color_bands.bands]]\nbelow = 10\ncolor = \"ffffff\"\n",
      "s.toml:6: effects.color_bands.bands[1].below", "");
  expect_refused("[effects.color_bands]\nsea_level = 100\nsummit = 50\n",
                 "s.toml:3: effects.color_bands.summit", "");
}

/// The colour that bands give to ground of a height and a slope.
glm::vec3 banded(const std::string& text, double height_m, double slope_deg) {
  const auto effects = made(text);
  planet::Ground ground;
  ground.height_m = height_m;
  ground.slope = {std::tan(slope_deg * 3.14159265358979 / 180.0), 0.0};
  ground.has_sea = true;
  return (*effects.front().effect->coloring())(ground, glm::vec3(0.25f, 0.5f, 0.75f));
}

TEST(ColorBands, GiveEveryHeightAndSlopeTheColorAskedFor) {
  const std::string text =
      "[effects.color_bands]\nsummit = \"1 km\"\nblend = 0\nslopes = \"00ff00\"\ncliffs = \"0000ff\"\n"
      "[[effects.color_bands.bands]]\nbelow = 30\ncolor = \"ff0000\"\n"
      "[[effects.color_bands.bands]]\nbelow = 100\ncolor = \"ffffff\"\n";
  EXPECT_EQ(banded(text, 0.0, 0.0), glm::vec3(1, 0, 0));
  EXPECT_EQ(banded(text, 299.0, 30.0), glm::vec3(1, 0, 0));
  EXPECT_EQ(banded(text, 301.0, 0.0), glm::vec3(1, 1, 1));
  EXPECT_EQ(banded(text, 5000.0, 0.0), glm::vec3(1, 1, 1)) << "the last band has no end";
  EXPECT_EQ(banded(text, 100.0, 50.0), glm::vec3(0, 1, 0)) << "a slope";
  EXPECT_EQ(banded(text, 100.0, 70.0), glm::vec3(0, 0, 1)) << "a cliff";
  EXPECT_EQ(banded(text, -10.0, 0.0), glm::vec3(0.25f, 0.5f, 0.75f)) << "water keeps its own";
}

TEST(ColorBands, BlendFromOneBandToTheNext) {
  const std::string text =
      "[effects.color_bands]\nsummit = \"1 km\"\nblend = 10\n[[effects.color_bands.bands]]\nbelow = "
      "50\ncolor = "
      "\"000000\"\n[[effects.color_bands.bands]]\nbelow = 100\ncolor = \"ffffff\"\n";
  EXPECT_EQ(banded(text, 449.0, 0.0).r, 0.0f);
  EXPECT_NEAR(banded(text, 500.0, 0.0).r, 0.5f, 1e-5f);
  EXPECT_NEAR(banded(text, 525.0, 0.0).r, 0.75f, 1e-5f);
  EXPECT_EQ(banded(text, 551.0, 0.0).r, 1.0f);
}

TEST(BrightStars, HoldTheWellKnownOnes) {
  const auto find = [](int hipparcos) {
    for (const BrightStar& star : bright_stars())
      if (star.hipparcos == hipparcos) return star;
    ADD_FAILURE() << hipparcos << " is missing";
    return BrightStar{};
  };
  // Right ascension, declination, magnitude: ESA 1997, The Hipparcos Catalogue.
  const struct {
    int hipparcos;
    double ra, dec, magnitude;
  } known[]{{32349, 101.2872, -16.7161, -1.44}, {30438, 95.9880, -52.6957, -0.62},
            {91262, 279.2347, 38.7837, 0.03},   {11767, 37.9529, 89.2641, 1.97},
            {24436, 78.6345, -8.2016, 0.18},    {60718, 186.6496, -63.0991, 0.77}};
  for (const auto& star : known) {
    const BrightStar seen = find(star.hipparcos);
    EXPECT_NEAR(seen.right_ascension_deg, star.ra, 2e-3);
    EXPECT_NEAR(seen.declination_deg, star.dec, 2e-3);
    EXPECT_NEAR(seen.magnitude, star.magnitude, 0.05);
  }
}

std::string text_of(const std::string& name) {
  std::ifstream file(std::string(GLOBE_SOURCE_DIR) + "/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// The README shows how an effect is added by one that there is.
TEST(EffectList, TheReadmesExampleIsTheFilesThatAreBuilt) {
  const std::string readme = text_of("README.md");
  std::string code = text_of("globe/effects/contours.cpp");
  code = code.substr(code.find("/// Mirrors `Contours`"));
  for (const char* left_out : {"}  // namespace globe::effects\n", "}  // namespace\n\n"}) {
    const std::size_t at = code.find(left_out);
    ASSERT_NE(at, std::string::npos);
    code.erase(at, std::string(left_out).size());
  }
  code.erase(code.find_last_not_of('\n') + 1);
  EXPECT_NE(readme.find("```cpp\n" + code + "\n```"), std::string::npos);
  EXPECT_NE(readme.find("```glsl\n" + text_of("shaders/effects/contours.glsl") + "```"), std::string::npos);
  EXPECT_LT(std::count(code.begin(), code.end(), '\n'), 80);
}

}  // namespace
}  // namespace globe::effects
