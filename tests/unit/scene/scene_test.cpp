#include "globe/scene/scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>

#include "globe/effects/list.h"
#include "globe/scene/nearest_word.h"
#include "tests/temporary_folder.h"
#include "tests/unit/scene/expect_refusal.h"

namespace globe::scene {
namespace {

/// An effect of the tests, as a file of globe/effects reads its own.
struct Mist {
  double density = 0;
  double top_m = 0;
};
std::any read_mist(Fields& fields) {
  Mist mist;
  mist.density = fields.number("density", {0.0, 1.0}).value_or(0.5);
  mist.top_m = fields.length_m("top", at_least(0.0)).value_or(300.0);
  return mist;
}
std::any read_swell(Fields& fields) { return fields.length_m("amplitude", at_least(0.0)).value_or(1.0); }
const std::vector<EffectKind> kEffects{{"mist", read_mist}, {"swell", read_swell}};

Scene parse(const std::string& text) { return parse_scene(text, "s.toml", kEffects); }

void expect_refused(const std::string& text, const std::string& begin, const std::string& part) {
  scene_tests::expect_refusal([&] { parse(text); }, begin, part);
}

TEST(Scene, SaysWhatTheCommandLineSays) {
  const Scene scene = parse(R"(
planet = "procedural:7"
[picture]
size = "640x480"
fov = "45 deg"
samples = 4
background = "00ff80"
detail = 32
exaggeration = 2
morph = false
positions = "chord"
window = "plain"
[camera]
at = "46 7 2km"
agl = true
look = "120,-10"
[sun]
time = 2026-06-21T10:00:00Z
speed = 60
)");
  EXPECT_EQ(scene.planet, "procedural:7");
  EXPECT_EQ(scene.picture.size, "640x480");
  EXPECT_EQ(scene.picture.fov_deg, 45.0);
  EXPECT_EQ(scene.picture.samples, 4);
  EXPECT_EQ(scene.picture.background, "00ff80");
  EXPECT_EQ(scene.picture.detail, 32);
  EXPECT_EQ(scene.picture.exaggeration, 2.0);
  EXPECT_EQ(scene.picture.morph, false);
  EXPECT_EQ(scene.picture.positions, "chord");
  ASSERT_TRUE(scene.camera.has_value());
  EXPECT_EQ(scene.camera->at.position.h_m, 2000.0);
  EXPECT_TRUE(scene.camera->agl);
  EXPECT_EQ(scene.camera->look->pitch_deg, -10.0);
  EXPECT_EQ(scene.sun.time, "2026-06-21T10:00:00Z");
  EXPECT_EQ(scene.sun.speed, 60.0);
}

TEST(Scene, NothingButItsNameIsNeeded) {
  const Scene scene = parse("");
  EXPECT_EQ(scene.planet, "procedural");
  EXPECT_FALSE(scene.camera || scene.path || scene.picture.size || scene.sun.time);
  EXPECT_TRUE(scene.effects.empty());
}

TEST(Scene, PathsHaveTheirPlacesInOrder) {
  const Scene scene = parse(R"(
[path]
duration = "1 min"
fps = 25
agl = true
[[path.keys]]
time = 0
at = "10,20,2000km"
[[path.keys]]
time = "0.5 min"
at = "10,21,200"
agl = false
look = "90,0"
stop = true
roll = "-15 deg"
[[path.keys]]
time = 30
at = "50,21,200"
jump = true
[[path.keys]]
time = 40
at = "51,21,200"
)");
  ASSERT_TRUE(scene.path.has_value());
  EXPECT_EQ(scene.path->duration_s, 60.0);
  ASSERT_EQ(scene.path->keys.size(), 4u);
  EXPECT_EQ(scene.path->keys[0].line, 6);
  EXPECT_TRUE(scene.path->keys[0].above_ground);
  EXPECT_FALSE(scene.path->keys[0].look.has_value());
  EXPECT_EQ(scene.path->keys[1].time_s, 30.0);
  EXPECT_FALSE(scene.path->keys[1].above_ground);
  EXPECT_TRUE(scene.path->keys[1].stop);
  EXPECT_EQ(scene.path->keys[0].roll_deg, 0.0);
  EXPECT_EQ(scene.path->keys[1].roll_deg, -15.0);
  EXPECT_FALSE(scene.path->keys[1].jump);
  EXPECT_TRUE(scene.path->keys[2].jump);
}

TEST(Scene, EffectsReadTheirOwnTables) {
  const Scene one = parse("[effects.swell]\namplitude = '20 ft'\n[effects.mist]\ntop = 120\n");
  ASSERT_EQ(one.effects.size(), 2u);
  EXPECT_EQ(one.effects[0].name, "swell");  // the file's order, not the alphabet's
  EXPECT_DOUBLE_EQ(std::any_cast<double>(one.effects[0].parameters), 6.096);
  EXPECT_EQ(one.effects[1].line, 3);
  EXPECT_EQ(std::any_cast<Mist>(one.effects[1].parameters).top_m, 120.0);
  EXPECT_EQ(std::any_cast<Mist>(one.effects[1].parameters).density, 0.5);
  const Scene two = parse("[[effects]]\nname = 'mist'\n[[effects]]\nname = 'mist'\ndensity = 1\n");
  ASSERT_EQ(two.effects.size(), 2u);
  EXPECT_EQ(std::any_cast<Mist>(two.effects[1].parameters).density, 1.0);
}

TEST(Scene, UnknownEffectsAreRefusedWithTheKnownOnes) {
  expect_refused("\n[effects.clowds]\n", "s.toml:2: effects.clowds: ", "known: mist and swell");
  expect_refused("[effects.mits]\n", "s.toml:1: effects.mits: there is no effect \"mits\"",
                 "did you mean \"mist\"?");
  expect_refused("[[effects]]\nname = \"sea\"\n", "s.toml:2: effects[0].name: ", "known: mist and swell");
  expect_refused("[[effects]]\ndensity = 1\n", "s.toml:1: effects[0]: name is missing", "");
  scene_tests::expect_refusal([] { parse_scene("[effects.fog]", "s.toml", {}); },
                              "s.toml:1: effects.fog: ", "this program has none");
}

TEST(Scene, EveryBadKeyIsRefusedByFileLineAndName) {
  const struct {
    const char *text, *begin, *part;
  } cases[]{
      {"planet = ", "s.toml:1: ", "TOML"},
      {"[picture]\nsize = \"640x480\"\nsize = \"1x1\"\n", "s.toml:3: ", ""},
      {"planet = 7\n", "s.toml:1: planet: 7 is not a text", "quotes"},
      {"planet = \"procedural:x\"\n", "s.toml:1: planet: ", "seed"},
      {"planet = \"nowhere\"\n", "s.toml:1: planet: there is no planet in nowhere", "globe convert"},
      {"plant = \"procedural\"\n", "s.toml:1: plant: there is no such key", "did you mean planet?"},
      {"[picture]\n\nsise = \"1x1\"\n", "s.toml:3: picture.sise: ", "did you mean size?"},
      {"[picture]\nwhatever = 1\n", "s.toml:2: picture.whatever: ", "known here: size, projection, fov"},
      {"[picture]\nsize = \"640\"\n", "s.toml:2: picture.size: ", "WxH"},
      {"[picture]\nfov = 171\n", "s.toml:2: picture.fov: 171 is not an angle from 0.01 to 170 deg", "15 deg"},
      {"[picture]\nprojection = \"fisheye\"\nfov = 361\n", "s.toml:3: picture.fov: ", "to 360 deg"},
      {"[picture]\nprojection = \"fish\"\n", "s.toml:2: picture.projection: ", "perspective, fisheye or"},
      {"[picture]\nfov = nan\n", "s.toml:2: picture.fov: nan is not an angle", ""},
      {"[picture]\nexaggeration = inf\n", "s.toml:2: picture.exaggeration: inf is not a number", ""},
      {"[picture]\nexaggeration = \"2\"\n", "s.toml:2: picture.exaggeration: \"2\" is not", "without quotes"},
      {"[picture]\nsamples = 2\n", "s.toml:2: picture.samples: ", "1 or 4"},
      {"[picture]\nsamples = 4.0\n", "s.toml:2: picture.samples: 4 is not a whole number", ""},
      {"[picture]\ndetail = 15\n", "s.toml:2: picture.detail: 15 is not a whole number from 16 to 1024", ""},
      {"[picture]\nmorph = \"on\"\n", "s.toml:2: picture.morph: \"on\" is not true or false", ""},
      {"[picture]\nbackground = \"red\"\n", "s.toml:2: picture.background: ", "RRGGBB"},
      {"picture = 1\n", "s.toml:1: picture: 1 is not a table", "[picture]"},
      {"[camera]\n", "s.toml:1: camera: at is missing", "LAT,LON,ALT"},
      {"[camera]\nat = \"91,0\"\n", "s.toml:2: camera.at: latitude 91", "latitude first"},
      {"[camera]\nat = \"0,0\"\nlook = \"0,91\"\n", "s.toml:3: camera.look: ", "HEADING,PITCH"},
      {"[camera]\nat = \"0,0\"\nlook = \"0,9\"\nroll = 181\n", "s.toml:4: camera.roll: ", "to 180 deg"},
      {"[camera]\nat = \"0,0\"\nroll = 18\n", "s.toml:3: camera.roll: ", "HEADING,PITCH"},
      {"[camera]\nat = \"0,0\"\nfov = 30\n[picture]\nfov = 30\n", "s.toml:3: camera.fov: ", "leave one"},
      {"[camera]\nat = \"0,0\"\n[path]\n", "s.toml:3: path: there is a [camera] too", ""},
      {"[path]\n", "s.toml:1: path: there are neither keys nor a file", ""},
      {"[path]\nfile = \"no.kml\"\n", "s.toml:2: path.file: there is no file no.kml", ""},
      {"[path]\nkeys = 3\n", "s.toml:2: path.keys: 3 is not an array", "[[path.keys]]"},
      {"[path]\nkeys = [3]\n", "s.toml:2: path.keys[0]: 3 is not a table", ""},
      {"[[path.keys]]\ntime = 0\nat = \"0,0,1\"\n", "s.toml:1: path.keys: a path of one place",
       "two or more"},
      {"[[path.keys]]\ntime = 0\nat = \"0,0\"\n[[path.keys]]\n", "s.toml:3: path.keys[0].at: the altitude",
       ""},
      {"[[path.keys]]\nat = \"0,0,1\"\n[[path.keys]]\n", "s.toml:1: path.keys[0]: time is missing",
       "seconds"},
      {"[[path.keys]]\ntime=5\nat=\"0,0,1\"\n[[path.keys]]\ntime=5\nat=\"0,1,1\"\n", "s.toml:4: the time",
       ""},
      {"[[path.keys]]\ntime=5\nat=\"0,0,1\"\n[[path.keys]]\ntime=5\njump=true\nat=\"0,1,1\"\n",
       "s.toml:4: the path takes no time", ""},
      {"[[path.keys]]\ntime=5\nat=\"0,0,1\"\n[[path.keys]]\ntime=4\njump=true\nat=\"0,1,1\"\n",
       "s.toml:4: the time", ""},
      {"[[path.keys]]\ntime=-1\nat=\"0,0,1\"\nlok = 1\n[[path.keys]]\n",
       "s.toml:4: path.keys[0].lok: ", "look"},
      {"[sun]\ntime = \"noon\"\n", "s.toml:2: sun.time: \"noon\" is not a date and time", "2026-03-21"},
      {"[sun]\ntime = 2026-02-28\nspeed = nan\n", "s.toml:3: sun.speed: ", ""},
      {"[sun]\ntime = \"2026-02-30\"\n", "s.toml:2: sun.time: ", ""},
      {"[sun]\nspeed = 3\n", "s.toml:2: sun.speed: ", "give a time"},
      {"[sun]\nazimuth = 3\n", "s.toml:2: sun.azimuth: ", "belong together"},
      {"[sun]\ntime = 2026-02-28\noverhead = \"0,0\"\n", "s.toml:1: sun: ", "two places"},
      {"[effects.swell]\namplitude = -2\n",
       "s.toml:2: effects.swell.amplitude: -2 is not a length of at least 0 m", "120 km"},
      {"[effects.swell]\namplitude = \"-2 km\"\n", "s.toml:2: effects.swell.amplitude: \"-2 km\"", ""},
      {"[effects.swell]\namplitud = 2\n", "s.toml:2: effects.swell.amplitud: ", "did you mean amplitude?"},
      {"[effects.mist]\ndensity = 1.5\n", "s.toml:2: effects.mist.density: 1.5 is not a number from 0 to 1",
       ""},
      {"[layers]\ncolour = false\n", "s.toml:2: layers.colour: ", "did you mean color?"},
      {"[region]\nside = '3 km'\n", "s.toml:1: region: center is missing", "write center ="},
      {"[region]\ncenter = '46,7'\nside = 0\n", "s.toml:3: region.side: 0 is not", ""},
      {"[region]\ncenter = '46,7'\nside = '3 km'\nspacing = '0.5 m'\n",
       "s.toml:4: region.spacing: it makes more than 4097 posts a side", "give a larger one"},
      {"[region]\ncenter = '46,7'\nside = '3 km'\nspacing = '400 m'\n",
       "s.toml:4: region.spacing: it makes less than 17 posts a side", "give a smaller one"},
      {"[region]\ncenter = '46,7'\nerror = -1\n", "s.toml:3: region.error: -1 is not", ""},
      {"[region]\ncenter = '46,7'\nmaterial = true\n",
       "s.toml:3: region.material: ", "did you mean materials?"},
      {"[layers]\ncolor = 0\n", "s.toml:2: layers.color: 0 is not true or false", ""},
      {"[layers]\ncolor = false\n", "s.toml:1: layers: the built-in planet has no layers", ""},
      {"effects = 1\n", "s.toml:1: effects: 1 is not a table", ""},
      {"\"a\\u0007\\nb\" = 1\n", "s.toml:1: a  b: ", ""},
  };
  for (const auto& [text, begin, part] : cases) expect_refused(text, begin, part);
}

TEST(Scene, FilesAndPlanetsCountFromItsFolder) {
  const tests::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "earth");
  std::ofstream(folder / "earth/planet.json") << "{}";
  std::ofstream(folder / "way.csv") << "lat,lon,alt\n1,2,3\n1,3,3\n";
  std::ofstream(folder / "s.toml")
      << "planet = 'earth'\n[layers]\ncolor = false\n[path]\nfile = 'way.csv'\nlift = '1 km'\n";
  const Scene scene = read_scene(folder / "s.toml", {});
  EXPECT_EQ(scene.planet, (folder / "earth").string());
  EXPECT_TRUE(scene.layers.heights && !scene.layers.colors && scene.layers.insets);
  ASSERT_EQ(scene.path->keys.size(), 2u);
  EXPECT_EQ(scene.path->keys[1].place.h_m, 1003.0);
}

TEST(Scene, FilesThatCannotBeReadAreRefused) {
  const tests::TemporaryFolder folder;
  scene_tests::expect_refusal([&] { read_scene(folder / "none.toml", {}); }, (folder / "none.toml").string());
  scene_tests::expect_refusal([&] { read_scene(folder.path(), {}); }, folder.path().string(), "folder");
  std::ofstream(folder / "deep.toml") << "a = " << std::string(100'000, '[');
  scene_tests::expect_refusal([&] { read_scene(folder / "deep.toml", {}); }, (folder / "deep.toml").string());
}

TEST(Scene, TheExamplesAreScenes) {
  std::size_t count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(GLOBE_SOURCE_DIR) / "scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    EXPECT_NO_THROW(read_scene(entry.path(), effects::effect_kinds())) << entry.path();
  }
  EXPECT_GE(count, 4u);
}

TEST(NearestWord, FindsSlipsAndNothingFarOff) {
  const std::vector<std::string> known{"amplitude", "size", "fov", "projection"};
  EXPECT_EQ(nearest_word("amplitud", known), "amplitude");
  EXPECT_EQ(nearest_word("szie", known), "size");
  EXPECT_EQ(nearest_word("fovv", known), "fov");
  EXPECT_EQ(nearest_word("colour", known), std::nullopt);
  EXPECT_EQ(nearest_word("x", {}), std::nullopt);
}

RC_GTEST_PROP(Scene, AnyTextIsReadOrRefused, (const std::string& text)) {
  try {
    parse(text);
  } catch (const Error& error) {
    RC_ASSERT(std::string(error.what()).find('\n') == std::string::npos);
  }
}

RC_GTEST_PROP(Scene, LengthsWithUnitsAreMetres, ()) {
  const double metres = *rc::gen::inRange(0, 1'000'000) / 64.0;
  const std::string text = std::to_string(metres);
  const auto amplitude = [&](const std::string& value) {
    return std::any_cast<double>(parse("[effects.swell]\namplitude = " + value + "\n").effects[0].parameters);
  };
  RC_ASSERT(amplitude(text) == metres);
  RC_ASSERT(amplitude("\"" + text + "m\"") == metres);
  RC_ASSERT(amplitude("\" " + text + "  km\"") == metres * 1000.0);
}

}  // namespace
}  // namespace globe::scene
