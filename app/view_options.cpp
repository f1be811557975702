#include "app/view_options.h"

#include <array>
#include <charconv>
#include <cmath>

#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "globe/base/error.h"
#include "globe/geo/sun.h"

namespace app {
namespace {

using globe::UsageError;

std::optional<double> to_double(std::string_view text) {
  double value = 0;
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> to_int(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

glm::vec3 parse_color(const std::string& text) {
  unsigned value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (text.size() != 6 || error != std::errc() || end != text.data() + text.size()) {
    throw UsageError("--background " + text, "not a colour",
                     "write six hexadecimal digits RRGGBB, such as ff00ff");
  }
  return glm::vec3(static_cast<float>(value >> 16 & 255u), static_cast<float>(value >> 8 & 255u),
                   static_cast<float>(value & 255u)) /
         255.0f;
}

}  // namespace

void add_eye_options(CLI::App& command, CameraOptions& options) {
  command.add_flag("--agl", options.agl, "altitudes count from the ground");
  command.add_option("--look", options.look,
                     "HEADING,PITCH[,ROLL] in degrees; a pitch of -90 looks down, 0 level");
  command.add_option("--size", options.size,
                     "WxH in pixels (default: 1280x720; fisheye 1024x1024, equirectangular 2048x1024)");
  add_optics_options(command, options.optics);
  command.add_option("--time", options.time,
                     "UTC date and time of the sun, ISO 8601 (default: 10:00 local solar time, 21 March)");
  command
      .add_option("--sun", options.overhead,
                  "LAT,LON: where the sun stands in the zenith, in place of a time")
      ->excludes("--time");
  command.add_option("--exaggeration", options.exaggeration, "draw heights so many times as high")
      ->capture_default_str()
      ->check(in_range(0.0, 100.0));
}

void add_camera_options(CLI::App& command, CameraOptions& options) {
  command
      .add_option("PLANET", options.planet,
                  "folder made by globe convert, procedural[:SEED], or a scene, SCENE.toml")
      ->required();
  add_eye_options(command, options);
  command.add_option("--detail", options.detail, "side of the hexagons in cells, 16 to 1024")
      ->capture_default_str();
  command.add_option("--morph", options.morph, "off: levels change at once, to see what morphing is for")
      ->capture_default_str()
      ->check(CLI::IsMember({"on", "off"}));
}

globe::clipmap::Settings clipmap_settings(const CameraOptions& options) {
  globe::clipmap::Settings settings = globe::clipmap::Settings::for_detail(options.detail);
  settings.morph = options.morph == "on";
  return settings;
}

void add_picture_options(CLI::App& command, ViewOptions& options) {
  command.add_option("--samples", options.samples, "samples a pixel")
      ->capture_default_str()
      ->check(CLI::IsMember({1, 4}));
  command.add_option("--background", options.background, "RRGGBB: nothing but ground before this colour");
  command.add_flag("--quiet", options.quiet, "warnings and errors only");
  command.add_option("--device", options.device, "auto, software, or the number of an EGL device")
      ->capture_default_str();
  command.add_option("--memory", options.memory_mb, "MB of decoded maps and of ground made of them to keep")
      ->capture_default_str()
      ->check(CLI::Range(64, 1 << 20));
}

void add_drawing_options(CLI::App& command, ViewOptions& options) {
  add_camera_options(command, options);
  add_picture_options(command, options);
  add_mark_options(command, options.marks);
  command
      .add_option("--positions", options.positions,
                  "places of vertices: exact; or, to see what accuracy costs, quadratic, chord or float32")
      ->capture_default_str();
  command
      .add_option(
          "--window", options.window,
          "how vertices lie in GPU memory: plain squares; or hexagon, 6 % less in all, the same picture")
      ->capture_default_str();
  command.add_option("--with", options.with,
                     "an effect as it usually is, besides those of a scene: sea, clouds, atmosphere, ...");
  command.add_option("--without", options.without, "an effect of the scene that is left out");
}

void add_look_options(CLI::App& command, ViewOptions& options) {
  command.add_flag("--wireframe", options.wireframe, "draw the triangles");
  command.add_option("--show", options.show, "levels, patches, normals or depth")
      ->check(CLI::IsMember({"levels", "patches", "normals", "depth"}));
}

void add_output_options(CLI::App& command, ViewOptions& options) {
  command.add_option("-o,--output", options.output, "file to write")->required();
  add_look_options(command, options);
  command.add_flag("--overwrite", options.overwrite, "replace existing output");
}

void add_view_options(CLI::App& command, ViewOptions& options) {
  add_drawing_options(command, options);
  add_output_options(command, options);
}

std::shared_ptr<const globe::planet::Surface> open_planet(const ViewOptions& options) {
  const std::size_t bytes = static_cast<std::size_t>(options.memory_mb) << 20;
  return open_planet(options.planet, bytes / 5 * 2, bytes / 5 * 3, options.exaggeration, options.sea_floor,
                     options.layers);
}

std::shared_ptr<const globe::planet::Surface> open_planet(const CameraOptions& options) {
  return open_planet(options.planet, kDatasetCache, globe::planet::Surface::kDefaultCache,
                     options.exaggeration, globe::planet::SeaFloor::kFlooded, options.layers);
}

Look parse_look(const std::string& text) {
  std::array<std::optional<double>, 3> angles;
  std::string_view rest = text;
  std::size_t count = 0;
  for (std::size_t comma = 0; comma != std::string_view::npos && count < angles.size(); ++count) {
    comma = rest.find(',');
    angles[count] = to_double(rest.substr(0, comma));
    if (comma != std::string_view::npos) rest.remove_prefix(comma + 1);
    if (count + 1 == angles.size() && comma != std::string_view::npos) angles[0].reset();
  }
  const auto [heading, pitch, roll] = angles;
  if (!heading || !pitch || std::abs(*pitch) > 90.0 || (count == 3 && !roll)) {
    throw UsageError("--look " + text, "not a heading, a pitch in [-90, 90] and perhaps a roll",
                     "write HEADING,PITCH or HEADING,PITCH,ROLL in degrees, such as 45,-10");
  }
  return {*heading, *pitch, roll.value_or(0.0)};
}

Size parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  const auto width = to_int(std::string_view(text).substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : to_int(std::string_view(text).substr(x + 1));
  if (!width || !height || *width < 16 || *height < 16 || *width > 16384 || *height > 16384) {
    throw UsageError("--size " + text, "not a picture size of 16 to 16384 pixels a side",
                     "write WxH, such as 1280x720");
  }
  return {*width, *height};
}

Size size_of(const CameraOptions& options, const Optics& optics) {
  return parse_size(options.size.empty() ? optics.usual_size() : options.size);
}

globe::render::RenderSettings render_settings(const ViewOptions& options) {
  globe::render::RenderSettings settings;
  settings.clipmap = clipmap_settings(options);
  const auto positions = globe::clipmap::positions_by_name(options.positions);
  if (!positions) {
    throw UsageError("--positions " + options.positions, "no such way to place vertices",
                     "give exact, quadratic, chord or float32");
  }
  settings.clipmap.positions = *positions;
  const auto windows = globe::clipmap::windows_by_name(options.window);
  if (!windows) throw UsageError("--window " + options.window, "no such window", "give plain or hexagon");
  if (*windows == globe::clipmap::Windows::kHexagon && globe::clipmap::is_interpolated(*positions)) {
    throw UsageError("--window hexagon",
                     "with --positions " + options.positions + " there are no positions to store",
                     "leave one of the two out");
  }
  settings.clipmap.windows = *windows;
  settings.wireframe = options.wireframe;
  settings.show = show_of(options);
  settings.background = background_of(options);
  return settings;
}

globe::render::Show show_of(const ViewOptions& options) {
  if (options.show == "levels") return globe::render::Show::kLevels;
  if (options.show == "patches") return globe::render::Show::kPatches;
  if (options.show == "normals") return globe::render::Show::kNormals;
  return globe::render::Show::kGround;
}

std::optional<glm::vec3> background_of(const ViewOptions& options) {
  if (options.background.empty()) return std::nullopt;
  return parse_color(options.background);
}

Sunlight::Sunlight(const globe::geo::UtcDate& date, double speed)
    : direction_(globe::geo::sun_direction(date)), date_(date), speed_(speed) {}

glm::dvec3 Sunlight::at(double seconds) const {
  if (!date_ || speed_ == 0.0 || seconds == 0.0) return direction_;
  return globe::geo::sun_direction(globe::geo::later_by(*date_, speed_ * seconds));
}

globe::render::Instant Sunlight::instant(double seconds) const {
  if (!date_) return {seconds};
  return {seconds, globe::geo::ecef_from_celestial(globe::geo::later_by(*date_, speed_ * seconds))};
}

Sunlight sun_for(const CameraOptions& options, const globe::planet::Surface& surface,
                 const globe::geo::Geodetic& target) {
  return sun_for(options, surface.info().body, target);
}

Sunlight sun_for(const CameraOptions& options, const std::string& body, const globe::geo::Geodetic& target) {
  namespace geo = globe::geo;
  const globe::scene::Sun& sun = options.sun;
  if (!options.overhead.empty()) {
    const geo::Geodetic over = globe::geo::parse_point(options.overhead).position;
    return Sunlight(geo::normal_from_degrees(over.lat_deg, over.lon_deg));
  }
  if (options.time.empty() && sun.overhead)
    return Sunlight(geo::normal_from_degrees(sun.overhead->lat_deg, sun.overhead->lon_deg));
  if (options.time.empty() && sun.position) {
    const geo::LocalFrame frame = geo::local_frame(target.lat_deg, target.lon_deg);
    return Sunlight(geo::look_direction(frame, sun.position->azimuth_deg, sun.position->altitude_deg));
  }
  const std::string time = options.time.empty() ? sun.time.value_or("") : options.time;
  if (time.empty()) return Sunlight(geo::morning_sun(target.lon_deg));
  if (body == "moon" || body == "mars") {
    throw UsageError("--time " + time,
                     "the sun's place is computed for the Earth only, this planet is the " + body,
                     "leave the time out");
  }
  return {geo::parse_utc(time, "--time"), options.time.empty() ? sun.speed : 0.0};
}

}  // namespace app
