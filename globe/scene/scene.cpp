#include "globe/scene/scene.h"

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "globe/base/text_file.h"
#include "globe/scene/nearest_word.h"
#include "globe/scene/track_file.h"

namespace globe::scene {
namespace {

/// What a field of view may be, by projection (render/projection.h).
Range fov_range(const Picture& picture) {
  const std::string projection = picture.projection.value_or("perspective");
  return {0.01, projection == "fisheye" ? 360.0 : projection == "equirectangular" ? 180.0 : 170.0};
}

constexpr double kLongestPath = 1e9;  ///< seconds

bool is_procedural(const std::string& name) {
  constexpr std::string_view kName = "procedural";
  if (name == kName) return true;
  if (!name.starts_with(kName) || name.size() <= kName.size() + 1 || name[kName.size()] != ':') return false;
  std::uint64_t seed = 0;
  const char* last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + kName.size() + 1, last, seed);
  return end == last && error == std::errc();
}

std::string read_planet(Fields& fields) {
  std::string name = fields.text("planet").value_or("procedural");
  if (is_procedural(name)) return name;
  if (name.starts_with("procedural"))
    fields.refuse("planet", "the seed of \"" + name + "\" is not a whole number below 2^64",
                  "write \"procedural\" or \"procedural:7\"");
  const std::filesystem::path folder = fields.file_name().parent_path() / name;
  std::error_code ignored;
  if (!std::filesystem::exists(folder / "planet.json", ignored))
    fields.refuse("planet", "there is no planet in " + folder.string(),
                  "give a folder made by globe convert, from the scene's folder, or \"procedural\"");
  return folder.string();
}

planet::LayerChoice read_layers(Fields fields, const std::string& planet) {
  planet::LayerChoice layers;
  layers.heights = fields.flag("height").value_or(true);
  layers.colors = fields.flag("color").value_or(true);
  layers.insets = fields.flag("insets").value_or(true);
  fields.finish();
  if (is_procedural(planet))
    fields.refuse("", "the built-in planet has no layers to choose from", "leave it out, or give a planet");
  return layers;
}

void check_size(const Fields& fields, const std::string& text) {
  int width = 0, height = 0;
  const char* last = text.data() + text.size();
  const auto x = std::from_chars(text.data(), last, width);
  const auto y = x.ptr != last && *x.ptr == 'x'
                     ? std::from_chars(x.ptr + 1, last, height)
                     : std::from_chars_result{text.data(), std::errc::invalid_argument};
  constexpr int kLeast = 16, kMost = 16384;
  if (x.ec != std::errc() || y.ec != std::errc() || y.ptr != last || std::min(width, height) < kLeast ||
      std::max(width, height) > kMost)
    fields.refuse("size", '"' + text + "\" is not a picture size of 16 to 16384 pixels a side",
                  "write \"WxH\", such as \"1280x720\"");
}

Picture read_picture(Fields fields) {
  Picture picture;
  picture.size = fields.text("size");
  if (picture.size) check_size(fields, *picture.size);
  picture.projection = fields.choice("projection", {"perspective", "fisheye", "equirectangular"});
  picture.fov_deg = fields.angle_deg("fov", fov_range(picture));
  picture.axis = fields.choice("axis", {"zenith", "look"});
  picture.faces = fields.integer("faces", 16, 16384);
  picture.samples = fields.integer("samples", 1, 4);
  if (picture.samples && *picture.samples != 1 && *picture.samples != 4)
    fields.refuse("samples", std::to_string(*picture.samples) + " is not 1 or 4", "write 1 or 4");
  if (fields.color("background")) picture.background = fields.text("background");
  picture.detail = fields.integer("detail", 16, 1024);
  picture.exaggeration = fields.number("exaggeration", {0.0, 100.0});
  picture.morph = fields.flag("morph");
  picture.positions = fields.choice("positions", {"exact", "quadratic", "chord", "float32"});
  picture.window = fields.choice("window", {"plain", "hexagon"});
  fields.finish();
  return picture;
}

std::optional<Look> read_look(Fields& fields) {
  const auto look = fields.look("look");
  if (!look) return std::nullopt;
  return Look{look->heading_deg, look->pitch_deg};
}

double read_roll(Fields& fields) { return fields.angle_deg("roll", {-180.0, 180.0}).value_or(0.0); }

StandingCamera read_camera(Fields fields, Picture& picture) {
  StandingCamera camera;
  camera.at = fields.required("at", fields.place("at"), "write at = \"LAT,LON,ALT\"");
  camera.agl = fields.flag("agl").value_or(false);
  camera.look = read_look(fields);
  camera.roll_deg = read_roll(fields);
  if (camera.roll_deg != 0.0 && !camera.look)
    fields.refuse("roll", "a camera without a look", "write look = \"HEADING,PITCH\" too");
  if (const auto fov = fields.angle_deg("fov", fov_range(picture))) {
    if (picture.fov_deg) fields.refuse("fov", "[picture] has a fov too", "leave one of them out");
    picture.fov_deg = fov;
  }
  fields.finish();
  return camera;
}

PathKey read_key(Fields& fields, bool agl) {
  PathKey key;
  key.line = fields.line();
  const geo::Point at = fields.required("at", fields.place("at"), "write at = \"LAT,LON,ALT\"");
  if (!at.has_alt) fields.refuse("at", "the altitude is missing", "write at = \"LAT,LON,ALT\"");
  key.place = at.position;
  key.time_s =
      fields.required("time", fields.duration_s("time"), "write seconds, or a text such as \"2 min\"");
  key.above_ground = fields.flag("agl").value_or(agl);
  key.look = read_look(fields);
  key.stop = fields.flag("stop").value_or(false);
  key.roll_deg = read_roll(fields);
  key.jump = fields.flag("jump").value_or(false);
  fields.finish();
  return key;
}

Path read_path(Fields fields) {
  Path path;
  path.file = fields.file_name();
  path.duration_s = fields.duration_s("duration", {1e-3, kLongestPath});
  path.fps = fields.number("fps", {0.1, 1000.0});
  path.frames = fields.integer("frames", 1, 1'000'000);
  path.low_pitch_deg = fields.angle_deg("pitch", {-90.0, 90.0}).value_or(path.low_pitch_deg);
  const std::optional<bool> agl = fields.flag("agl");
  const auto file = fields.file("file");
  const auto lift_m = fields.length_m("lift", {-1e5, 1e8});
  std::vector<Fields> keys = fields.tables("keys");
  if (file.has_value() == !keys.empty())
    fields.refuse("", file ? "there are keys and a file both" : "there are neither keys nor a file",
                  "write [[path.keys]] for each place, or file = \"tour.kml\"");
  fields.finish();
  if (file) {
    path.file = *file;
    path.keys = read_track_file(*file, agl);
    for (PathKey& key : path.keys) key.place.h_m += lift_m.value_or(0.0);
    return path;
  }
  if (lift_m) fields.refuse("lift", "only places of a file are lifted", "leave it out");
  if (keys.size() == 1)
    fields.refuse("keys", "a path of one place leads nowhere", "give two or more, or a [camera]");
  for (Fields& key : keys) path.keys.push_back(read_key(key, agl.value_or(false)));
  require_path(path.keys, fields.file_name().string());
  return path;
}

constexpr double kWidestRegion = 1e6, kClosestPosts = 0.01;  ///< metres
constexpr int kMostPosts = 4097, kLeastCells = 16;           ///< a side

Region read_region(Fields fields) {
  Region region;
  region.center = fields.required("center", fields.place("center"), "write center = \"LAT,LON\"").position;
  region.side_m = fields.length_m("side", {1.0, kWidestRegion}).value_or(region.side_m);
  region.spacing_m = fields.length_m("spacing", {kClosestPosts, kWidestRegion});
  if (region.spacing_m && region.side_m / *region.spacing_m > kMostPosts - 1)
    fields.refuse("spacing", "it makes more than 4097 posts a side", "give a larger one, or a smaller side");
  if (region.spacing_m && region.side_m / *region.spacing_m < kLeastCells)
    fields.refuse("spacing", "it makes less than 17 posts a side", "give a smaller one, or a larger side");
  region.error_px = fields.number("error", {0.0, 1000.0}).value_or(region.error_px);
  region.shadows = fields.flag("shadows").value_or(region.shadows);
  region.materials = fields.flag("materials").value_or(region.materials);
  fields.finish();
  return region;
}

Sun read_sun(Fields fields) {
  Sun sun;
  sun.time = fields.date("time");
  if (const auto overhead = fields.place("overhead")) sun.overhead = overhead->position;
  const auto azimuth = fields.angle_deg("azimuth", {-360.0, 360.0});
  const auto altitude = fields.angle_deg("altitude", {-90.0, 90.0});
  const auto speed = fields.number("speed", {-1e6, 1e6});
  fields.finish();
  if (azimuth.has_value() != altitude.has_value())
    fields.refuse(azimuth ? "azimuth" : "altitude", "azimuth and altitude belong together",
                  "give both or none");
  if (azimuth) sun.position = Sun::Position{*azimuth, *altitude};
  if (int{sun.time.has_value()} + int{sun.overhead.has_value()} + int{sun.position.has_value()} > 1)
    fields.refuse("", "the sun is said to stand in two places",
                  "give one of time, overhead, or azimuth and altitude");
  if (speed && !sun.time) fields.refuse("speed", "a sun without a time stands still", "give a time too");
  sun.speed = speed.value_or(0.0);
  return sun;
}

Effect read_effect(const std::string& name, const std::string& key, const Fields& parent, Fields fields,
                   std::span<const EffectKind> known) {
  const auto kind =
      std::find_if(known.begin(), known.end(), [&](const EffectKind& k) { return k.name == name; });
  if (kind == known.end()) {
    std::vector<std::string> names;
    for (const EffectKind& one : known) names.emplace_back(one.name);
    const auto nearest = nearest_word(name, names);
    parent.refuse(key, "there is no effect \"" + name + '"',
                  nearest         ? "did you mean \"" + *nearest + "\"?"
                  : names.empty() ? "leave it out; this program has none"
                                  : "known: " + listed(names));
  }
  Effect effect{name, fields.line(), kind->read(fields)};
  fields.finish();
  return effect;
}

/// [[effects]] with a name each, or [effects.NAME].
std::vector<Effect> read_effects(Fields& scene, const Value& value, std::span<const EffectKind> known) {
  std::vector<Effect> effects;
  if (std::holds_alternative<Array>(value.is)) {
    for (Fields& fields : scene.tables("effects")) {
      const std::string name = fields.required("name", fields.text("name"), "write name = \"NAME\"");
      effects.push_back(read_effect(name, "name", fields, fields, known));
    }
    return effects;
  }
  std::optional<Fields> table = scene.table("effects");
  for (const std::string& name : table->keys())
    effects.push_back(read_effect(name, name, *table, *table->table(name), known));
  return effects;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::filesystem::path& file,
                  std::span<const EffectKind> known) {
  const Value document = parse_document(text, file.string());
  Fields fields(document, file);
  Scene scene;
  scene.file = file;
  scene.planet = read_planet(fields);
  if (const auto layers = fields.table("layers")) scene.layers = read_layers(*layers, scene.planet);
  if (const auto picture = fields.table("picture")) scene.picture = read_picture(*picture);
  const auto camera = fields.table("camera");
  const auto path = fields.table("path");
  if (camera && path)
    fields.refuse("path", "there is a [camera] too", "leave one of them out: a camera stands or moves");
  if (camera) scene.camera = read_camera(*camera, scene.picture);
  if (path) scene.path = read_path(*path);
  if (const auto region = fields.table("region")) scene.region = read_region(*region);
  if (const auto sun = fields.table("sun")) scene.sun = read_sun(*sun);
  if (const Value* effects = std::get<Table>(document.is).find("effects"))
    scene.effects = read_effects(fields, *effects, known);
  fields.finish();
  return scene;
}

Scene read_scene(const std::filesystem::path& file, std::span<const EffectKind> known) {
  return parse_scene(read_text_file(file, kLongestDocument), file, known);
}

}  // namespace globe::scene
