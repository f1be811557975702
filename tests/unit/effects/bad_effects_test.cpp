#include <gtest/gtest.h>

#include <string>

#include "globe/base/error.h"
#include "globe/effects/list.h"
#include "globe/scene/scene.h"

namespace globe::effects {
namespace {

std::string refusal_of(const std::string& effect) {
  const std::vector<scene::EffectKind> kinds = effect_kinds();
  try {
    scene::parse_scene("planet = \"procedural\"\n[effects." + effect, "x/scene.toml", kinds);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(BadEffects, CloudsNameFileLineAndKey) {
  EXPECT_EQ(refusal_of("clouds]\ncoverage = -0.5\n")
                .rfind("x/scene.toml:3: effects.clouds.coverage: -0.5 is not", 0),
            0u);
  EXPECT_EQ(refusal_of("clouds]\nimage = \"none.jpg\"\n")
                .rfind("x/scene.toml:3: effects.clouds.image: there is no file x/none.jpg", 0),
            0u);
  EXPECT_NE(refusal_of("clouds]\ncover = 0.5\n").find("coverage"), std::string::npos);
  EXPECT_EQ(refusal_of("clouds]\ncoverage = 0.5\nshadows = false\n"), "");
}

TEST(BadEffects, NightLightsNeedAnImage) {
  EXPECT_EQ(refusal_of("night_lights]\n").rfind("x/scene.toml:2: effects.night_lights: image is missing", 0),
            0u);
  EXPECT_NE(refusal_of("night_lights]\nimage = \"none.jpg\"\nintensity = -1\n"), "");
}

TEST(BadEffects, LightmapsNeedAnImage) {
  EXPECT_EQ(refusal_of("lightmap]\n").rfind("x/scene.toml:2: effects.lightmap: image is missing", 0), 0u);
}

}  // namespace
}  // namespace globe::effects
