// What a scene may ask of the sea, and what is refused by file, line and key.

#include <gtest/gtest.h>

#include "globe/effects/list.h"
#include "tests/unit/scene/expect_refusal.h"

namespace globe::effects {
namespace {

std::string scene_with(const std::string& sea) {
  return "planet = \"procedural\"\n[camera]\nat = \"0,0,100\"\n" + sea;
}

void expect_sea_refused(const std::string& sea, const std::string& begin, const std::string& part) {
  scene_tests::expect_refusal([&] { scene::parse_scene(scene_with(sea), "s.toml", effect_kinds()); }, begin,
                              part);
}

TEST(SeaScene, WavesThatCannotBeAreRefusedByFileLineAndKey) {
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\namplitude = -1\nwavelength = 50\n",
                     "s.toml:6: effects.sea.waves[0].amplitude: ", "-1");
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\namplitude = 1\nwavelength = 0\n",
                     "s.toml:7: effects.sea.waves[0].wavelength: ", "0");
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\nwavelength = 50\n",
                     "s.toml:5: effects.sea.waves[0]: ", "amplitude is missing");
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\namplitude = 1\n",
                     "s.toml:5: effects.sea.waves[0]: ", "wavelength is missing");
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\namplitude = 1\nwavelength = 50\nfrequency = 1\n",
                     "s.toml:8: effects.sea.waves[0].frequency: ", "leave one of the two out");
  expect_sea_refused("[effects.sea]\n[[effects.sea.waves]]\namplitude = 1\nfrequency = 0.1\nhight = 2\n",
                     "s.toml:8: effects.sea.waves[0].hight: ", "");
  expect_sea_refused("[effects.sea]\nwind_speed = -3\n", "s.toml:5: effects.sea.wind_speed: ", "-3");
  std::string high;
  for (int k = 0; k < 3; ++k) high += "[[effects.sea.waves]]\namplitude = 15\nwavelength = 500\n";
  expect_sea_refused("[effects.sea]\n" + high, "s.toml:5: effects.sea.waves: ", "40 m");
}

TEST(SeaScene, OnlyAPlanetWithABareSeaFloorHasASea) {
  const auto flooded = planet::Surface::builtin(1);
  const auto bare = planet::Surface::builtin(1, planet::Surface::kDefaultCache, 1.0, planet::SeaFloor::kBare);
  const auto with = [](const std::string& effects) {
    return scene::parse_scene(scene_with(effects), "s.toml", effect_kinds());
  };
  EXPECT_TRUE(draws_sea(with("[effects.sea]\n")));
  EXPECT_FALSE(draws_sea(with("[effects.fog]\n")));
  scene_tests::expect_refusal([&] { make_effects(with("[effects.underwater]\n"), *flooded); },
                              "s.toml:4: effects.underwater: ", "needs effects.sea");
  EXPECT_TRUE(bare->has_bare_floor());
  EXPECT_EQ(bare->mesh_height(-300.0), -300.0);
  EXPECT_EQ(flooded->mesh_height(-300.0), 0.0);
  EXPECT_EQ(bare->drawn_height(-300.0), 0.0);
}

}  // namespace
}  // namespace globe::effects
