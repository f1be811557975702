// Effects that a scene does not name cost nothing, and those it names cost nothing where they are not seen:
// counted in OpenGL calls and objects, and compared byte by byte.

#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>

#include "globe/effects/list.h"
#include "globe/geo/sun.h"
#include "globe/render/ground_program.h"
#include "tests/render/ground/views.h"

namespace {

using globe::render::GlobeRenderer;
using globe::render::NamedEffect;

/// Counts some of the calls that go to OpenGL while it lives: draws, and what objects are made.
class CallCount {
 public:
  CallCount() {
    current = this;
    wrap("glCreateProgram", epoxy_glCreateProgram, create_program,
         [] { return current->real_create_program(); });
    wrap("glCreateTextures", epoxy_glCreateTextures, create_textures,
         [](GLenum target, GLsizei n, GLuint* names) {
           current->counts["textures"] += n;
           current->create_textures(target, n, names);
         });
    wrap("glCreateBuffers", epoxy_glCreateBuffers, create_buffers, [](GLsizei n, GLuint* names) {
      current->counts["buffers"] += n;
      current->create_buffers(n, names);
    });
    wrap("glCreateFramebuffers", epoxy_glCreateFramebuffers, create_framebuffers,
         [](GLsizei n, GLuint* names) {
           current->counts["framebuffers"] += n;
           current->create_framebuffers(n, names);
         });
    wrap("glNamedBufferSubData", epoxy_glNamedBufferSubData, buffer_data,
         [](GLuint name, GLintptr offset, GLsizeiptr size, const void* data) {
           ++current->counts["buffer uploads"];
           current->buffer_data(name, offset, size, data);
         });
    wrap("glDrawArrays", epoxy_glDrawArrays, draw_arrays, [](GLenum mode, GLint first, GLsizei count) {
      ++current->counts["draws"];
      current->draw_arrays(mode, first, count);
    });
    wrap("glDrawArraysInstanced", epoxy_glDrawArraysInstanced, draw_instanced,
         [](GLenum mode, GLint first, GLsizei count, GLsizei n) {
           ++current->counts["draws"];
           current->draw_instanced(mode, first, count, n);
         });
    wrap("glDrawElementsInstancedBaseInstance", epoxy_glDrawElementsInstancedBaseInstance, draw_elements,
         [](GLenum mode, GLsizei count, GLenum type, const void* indices, GLsizei n, GLuint base) {
           ++current->counts["draws"];
           current->draw_elements(mode, count, type, indices, n, base);
         });
    wrap("glUseProgram", epoxy_glUseProgram, use_program, [](GLuint program) {
      ++current->counts["programs used"];
      current->use_program(program);
    });
  }
  CallCount(const CallCount&) = delete;
  CallCount& operator=(const CallCount&) = delete;
  ~CallCount() {
    epoxy_glCreateProgram = create_program;
    epoxy_glCreateTextures = create_textures;
    epoxy_glCreateBuffers = create_buffers;
    epoxy_glCreateFramebuffers = create_framebuffers;
    epoxy_glNamedBufferSubData = buffer_data;
    epoxy_glDrawArrays = draw_arrays;
    epoxy_glDrawArraysInstanced = draw_instanced;
    epoxy_glDrawElementsInstancedBaseInstance = draw_elements;
    epoxy_glUseProgram = use_program;
    current = nullptr;
  }

  std::map<std::string, int> counts;

 private:
  template <class Function, class Wrapper>
  static void wrap(const char* name, Function& function, Function& kept, Wrapper wrapper) {
    // Not what epoxy's pointer holds: before its first call that looks the function up, and finds the
    // wrapper.
    kept = reinterpret_cast<Function>(eglGetProcAddress(name));
    function = wrapper;
  }
  GLuint real_create_program() {
    ++counts["programs"];
    return create_program();
  }

  static CallCount* current;
  decltype(epoxy_glCreateProgram) create_program = nullptr;
  decltype(epoxy_glCreateTextures) create_textures = nullptr;
  decltype(epoxy_glCreateBuffers) create_buffers = nullptr;
  decltype(epoxy_glCreateFramebuffers) create_framebuffers = nullptr;
  decltype(epoxy_glNamedBufferSubData) buffer_data = nullptr;
  decltype(epoxy_glDrawArrays) draw_arrays = nullptr;
  decltype(epoxy_glDrawArraysInstanced) draw_instanced = nullptr;
  decltype(epoxy_glDrawElementsInstancedBaseInstance) draw_elements = nullptr;
  decltype(epoxy_glUseProgram) use_program = nullptr;
};
CallCount* CallCount::current = nullptr;

constexpr int kCalledWidth = 96, kCalledHeight = 54;

std::vector<NamedEffect> effects_of(const std::string& text) {
  return globe::effects::make_effects(
      globe::scene::parse_scene(text, "s.toml", globe::effects::effect_kinds()), *views::builtin_planet());
}

globe::render::RenderSettings small_settings() {
  globe::render::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(16);
  return settings;
}

struct Seen {
  std::vector<std::uint8_t> picture;
  std::map<std::string, int> first_frame, next_frame;
  std::vector<globe::render::EffectState> states;
};

/// Two frames over land by day at a height, looking along a pitch away from the sun.
Seen seen(const std::string& scene, double above_m, double pitch_deg, double heading_deg = 270.0) {
  const globe::gl::Framebuffer target(kCalledWidth, kCalledHeight);
  GlobeRenderer renderer(views::builtin_planet(), small_settings(), effects_of(scene));
  const auto camera = views::camera_above(renderer, *views::builtin_planet(), {"land", -43.42, -106.43},
                                          above_m, heading_deg, pitch_deg);
  const glm::dvec3 sun = globe::geo::morning_sun(-106.43);
  Seen result;
  {
    CallCount calls;
    renderer.draw(camera, sun, true, target);
    result.first_frame = calls.counts;
  }
  {
    CallCount calls;
    renderer.draw(camera, sun, true, target);
    result.next_frame = calls.counts;
  }
  result.picture = target.read_rgba8();
  result.states = renderer.effect_states();
  return result;
}

class OnlyWhatIsCalledFor : public GlTest {};

TEST_F(OnlyWhatIsCalledFor, WhatIsNamedButNotSeenDrawsAndMakesNothing) {
  const Seen without = seen("", 300.0, -20.0);
  // By day the stars, and with the sun behind the camera the flare, are not seen.
  for (const char* scene : {"[effects.stars]\n", "[effects.lens_flare]\n"}) {
    const Seen with = seen(scene, 300.0, -20.0);
    ASSERT_EQ(with.states.size(), 1u);
    EXPECT_FALSE(with.states.front().verdict.active) << scene;
    EXPECT_EQ(with.first_frame, without.first_frame) << scene;
    EXPECT_EQ(with.next_frame, without.next_frame) << scene;
    EXPECT_EQ(with.states.front().gpu_bytes, 0u) << scene;
    EXPECT_EQ(with.picture, without.picture) << scene;
  }
}

TEST_F(OnlyWhatIsCalledFor, WhatIsSeenIsDrawn) {
  const Seen without = seen("", 300.0, 30.0, 60.0);
  const Seen flare = seen("[effects.lens_flare]\n", 300.0, 30.0, 60.0);
  EXPECT_TRUE(flare.states.front().verdict.active);
  EXPECT_EQ(flare.next_frame.at("draws"), without.next_frame.at("draws") + 3)
      << "two passes, and the light shown";
  EXPECT_EQ(flare.next_frame.count("textures"), 0u) << "made once";
  EXPECT_NE(flare.picture, without.picture);
  const Seen fog = seen("[effects.fog]\nbase = \"2 km\"\n", 300.0, -20.0);
  EXPECT_TRUE(fog.states.front().verdict.active);
  EXPECT_EQ(fog.next_frame.at("draws"), seen("", 300.0, -20.0).next_frame.at("draws"))
      << "it has no pass of its own";
}

int active_resources(const globe::gl::Program& program, GLenum kind) {
  GLint count = 0;
  glGetProgramInterfaceiv(program.id(), kind, GL_ACTIVE_RESOURCES, &count);
  return count;
}

TEST_F(OnlyWhatIsCalledFor, AProgramForASetOfEffectsHasNothingOfTheOthers) {
  using namespace globe::render;
  GlobeRenderer renderer(views::builtin_planet(), small_settings());
  const auto program = [&](const std::string& scene, int active, Serving serving) {
    const std::vector<NamedEffect> effects = effects_of(scene);
    const EffectShaders shaders(effects);
    EffectProgram ground(ground_sources(kLooks.front(), renderer.textures(), false, AirSteps{}.haze),
                         shaders);
    const globe::gl::Program& chosen = ground.for_active(active, serving);
    return std::array{active_resources(chosen, GL_UNIFORM_BLOCK), active_resources(chosen, GL_UNIFORM),
                      static_cast<int>(chosen.uniform("active_effects"))};
  };
  const std::string fog = "[effects.fog]\n", both = fog + "[effects.clouds]\n";
  const auto plain = program("", 0, Serving::kItsSet);
  EXPECT_EQ(program(both, 0, Serving::kItsSet), plain);
  const std::vector<NamedEffect> effects = effects_of(both);
  const int fog_bit = effects[0].name == "fog" ? 1 : 2;
  EXPECT_EQ(program(both, fog_bit, Serving::kItsSet), program(fog, 1, Serving::kItsSet));
  const auto any = program(both, 0, Serving::kCompiled);
  EXPECT_EQ(any[2], EffectShaders::kActiveEffects) << "what serves any set is told";
  EXPECT_EQ(any[0], plain[0] + 2);
}

TEST_F(OnlyWhatIsCalledFor, FramesInRealTimeDrawWhatWholeFramesDo) {
  const globe::gl::Framebuffer target(kCalledWidth, kCalledHeight);
  const std::string scene = "[effects.fog]\nbase = \"2 km\"\n[effects.clouds]\naltitude = \"12 km\"\n";
  const Seen whole = seen(scene, 300.0, -20.0);
  GlobeRenderer renderer(views::builtin_planet(), small_settings(), effects_of(scene));
  renderer.warm_up(target);
  const auto camera =
      views::camera_above(renderer, *views::builtin_planet(), {"land", -43.42, -106.43}, 300.0, 270.0, -20.0);
  int frames = 0;
  bool complete = false;
  for (; frames < 300 && !complete; ++frames) {
    complete = renderer.draw(camera, globe::geo::morning_sun(-106.43), false, target, 1e3).complete;
    renderer.await_computing();
  }
  EXPECT_GT(frames, 1);
  EXPECT_TRUE(complete);
  EXPECT_EQ(target.read_rgba8(), whole.picture);
}

TEST_F(OnlyWhatIsCalledFor, APictureDrawnAsLightIsThePictureWithinAStepOfItsBytes) {
  // Fog too thin to see changes nothing but how the picture comes about: with a flare it is drawn as light.
  const Seen plain = seen("", 300.0, 30.0, 60.0);
  const Seen light = seen("[effects.lens_flare]\nstrength = 0\n", 300.0, 30.0, 60.0);
  ASSERT_EQ(plain.picture.size(), light.picture.size());
  int worst = 0;
  for (std::size_t k = 0; k < plain.picture.size(); ++k)
    worst = std::max(worst, std::abs(int{plain.picture[k]} - int{light.picture[k]}));
  EXPECT_LE(worst, 1);
}

TEST_F(OnlyWhatIsCalledFor, ASunBehindAMountainMakesNoFlare) {
  // Looking down at the ground straight below the sun: its place in the picture is ground.
  const auto target = globe::gl::Framebuffer(kCalledWidth, kCalledHeight);
  const auto surface = views::builtin_planet();
  const auto picture = [&](const std::string& scene) {
    GlobeRenderer renderer(surface, small_settings(), effects_of(scene));
    const auto camera =
        views::camera_above(renderer, *surface, {"land", -43.42, -106.43}, 300.0, 90.0, -10.0);
    const glm::dvec3 below = glm::normalize(camera.forward - 0.1 * camera.up);  // the sun has set
    renderer.draw(camera, below, true, target);
    return target.read_rgba8();
  };
  const auto with = picture("[effects.lens_flare]\nstrength = 50\n"),
             without = picture("[effects.lens_flare]\nstrength = 0\n");
  EXPECT_EQ(with, without);
}

}  // namespace
