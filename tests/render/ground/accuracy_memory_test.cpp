// What `globe accuracy` holds on the GPU: one study's renderers at a time.

#include <epoxy/gl.h>

#include <cstdlib>

#include "app/accuracy/measure.h"
#include "tests/render/ground/views.h"

namespace {

namespace accuracy = app::accuracy;

/// Textures that there are, in the context and those it shares with.
int live_textures() {
  int count = 0;
  for (GLuint name = 1; name < 20000; ++name) count += glIsTexture(name) == GL_TRUE ? 1 : 0;
  return count;
}

/// Textures of the four frames that all studies of positions but the last leave to the next one, at most.
constexpr int kOfPositions = 40;

TEST_F(GlTest, AccuracyHoldsNoRendererOfAStudyThatIsNotMeasured) {
  const bool all = std::getenv("GLOBE_TEST_FULL") != nullptr;
  const accuracy::Scope scope{false, {&context(), [](globe::gl::Context*) {}}, views::builtin_planet()};
  for (const accuracy::Family& family : accuracy::families()) {
    if (!family.draws || (!all && family.name != "samples")) continue;
    const int before = live_textures();
    std::vector<accuracy::Study> studies = family.studies(scope);
    // Depth schemes, tone curves and yardsticks keep what they draw into, a few megabytes; details, which
    // take seconds to make, all.
    const int kept = live_textures();
    const bool keeps = family.name == "positions" || family.name == "detail" || family.name == "depth" ||
                       family.name == "shading";
    EXPECT_LE(kept, before + (keeps ? 80 : 0)) << family.name;
    int most = kept;
    bool releases = false;
    for (accuracy::Study& study : studies) {
      for (accuracy::Setting& setting : study.settings) {
        releases = releases || setting.release;
        setting.cost = [&most, cost = setting.cost] {
          const double result = cost();
          most = std::max(most, live_textures());
          return result;
        };
      }
    }
    accuracy::measure(std::move(studies), {.passes = 2, .most = 1}, [&](double) {
      EXPECT_LE(live_textures(), kept + (family.name == "positions" ? kOfPositions : 0)) << family.name;
    });
    EXPECT_TRUE(!releases || most > kept) << family.name << ": nothing was drawn";
    EXPECT_EQ(live_textures(), before) << family.name;
  }
}

}  // namespace
