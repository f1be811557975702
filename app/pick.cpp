#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/flat_region.h"
#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/records.h"
#include "app/scene_argument.h"
#include "app/standing_camera.h"
#include "app/view_options.h"
#include "flat/drawn_region.h"
#include "flat/rim.h"
#include "globe/base/error.h"
#include "globe/clipmap/cut.h"
#include "globe/clipmap/drawn_surface.h"
#include "globe/clipmap/ground_below.h"
#include "globe/render/camera.h"
#include "globe/render/globe_renderer.h"
#include "globe/render/region_below.h"

namespace app {
namespace {

namespace flat = globe::flat;
namespace geo = globe::geo;
namespace render = globe::render;
using globe::clipmap::DrawnPoint;

struct PickOptions {
  CameraOptions camera;
  StandOptions stand;
  std::vector<std::string> pixels;
  RecordOptions records;
};

/// Column and row, from the top left.
struct Pixel {
  int x = 0;
  int y = 0;
};

/// "X,Y" or "X Y", inside the picture. Throws UsageError.
Pixel parse_pixel(std::string text, const Size& size) {
  const std::string given = text;
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(parse_number(word).value_or(std::nan("")));
  if (numbers.size() != 2 || numbers[0] != std::floor(numbers[0]) || numbers[1] != std::floor(numbers[1])) {
    throw globe::UsageError("pixel " + given, "not a column and a row",
                            "write X,Y in whole pixels from the top left, such as 640,360");
  }
  if (numbers[0] < 0 || numbers[1] < 0 || numbers[0] >= size.width || numbers[1] >= size.height) {
    throw globe::UsageError("pixel " + given, "outside the picture",
                            "give 0,0 to " + std::to_string(size.width - 1) + "," +
                                std::to_string(size.height - 1) + ", or another --size");
  }
  return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

/// Looks through pixels of a picture at the ground that it shows.
class Picker {
 public:
  Picker(const std::shared_ptr<const globe::planet::Surface>& surface, const PickOptions& options,
         const std::optional<globe::scene::Scene>& scene, const Optics& optics, const Size& size)
      : ellipsoid_(surface->ellipsoid()),
        size_(size),
        projection_(optics.projection),
        region_(region_of(scene, surface, true)) {
    const auto settings = clipmap_settings(options.camera);
    const int max_level = render::RenderSettings{}.max_level;
    const auto above = [&](const glm::dvec3& position) {
      return render::height_above_ground(
          settings, *surface, position, max_level, true,
          region_ ? flat::region_below(*region_->terrain, position) : render::RegionBelow{});
    };
    const Standpoint stand = standpoint(options.stand, options.camera, scene, surface, max_level, above);
    camera_ =
        optics.camera(ellipsoid_, stand.place, stand.look, static_cast<double>(size.width) / size.height);
    double away_m = std::max(above(camera_.position), globe::clipmap::least_above_ground(ellipsoid_));
    near_m_ = render::near_distance(ellipsoid_, away_m);
    if (region_) {
      room_ = flat::room_of(*region_->terrain);
      const glm::dvec4 inside = room_.inside_m(camera_.position);
      away_m = std::max(away_m, std::min({inside.x, inside.y, inside.z, inside.w}));
    }
    const auto complete =
        globe::clipmap::complete_state(settings, *surface, camera_.position, away_m, max_level);
    surface_.emplace(complete.settings, surface, complete.state, complete.shown.level, complete.shown.fade);
    if (!region_) return;
    drawn_region_.emplace(
        region_->terrain, flat::make_rim(*region_->terrain, [&](const globe::clipmap::CuttingPlane& plane) {
          return globe::clipmap::cut(complete.settings, *complete.state, complete.shown, plane);
        }));
  }

  std::optional<DrawnPoint> at(const Pixel& pixel) const {
    const std::optional<glm::dvec3> direction = render::direction_through(
        projection_, camera_, (pixel.x + 0.5) / size_.width, (pixel.y + 0.5) / size_.height);
    if (!direction)
      throw globe::UsageError("pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y),
                              "outside the field of view", "give one that the picture fills");
    // Faces of a cube have their near planes as far off as a pinhole camera.
    const glm::dvec3 along =
        glm::abs(glm::dvec3(glm::dot(*direction, camera_.right), glm::dot(*direction, camera_.up),
                            glm::dot(*direction, camera_.forward)));
    const double ahead =
        projection_ == render::Projection::kPerspective ? along.z : std::max({along.x, along.y, along.z});
    const globe::clipmap::Ray ray(camera_.position, *direction);
    if (!drawn_region_) return surface_->first_hit(ray, near_m_ / ahead);
    const auto hit = flat::first_hit(*surface_, *drawn_region_, room_, ray, near_m_ / ahead);
    if (!hit) return std::nullopt;
    if (hit->globe) return hit->globe;
    return DrawnPoint{camera_.position + hit->distance_m * *direction, hit->distance_m, region_->level, 0.0};
  }

 private:
  geo::Ellipsoid ellipsoid_;
  Size size_;
  render::Projection projection_;
  render::Camera camera_;
  double near_m_ = 0;
  std::optional<globe::clipmap::DrawnSurface> surface_;
  std::optional<FlatRegion> region_;
  render::Room room_;
  std::optional<flat::DrawnRegion> drawn_region_;
};

/// One answer as a line: the ground's place, or sky.
std::string json_line(const geo::Geodetic& place, const std::optional<DrawnPoint>& found,
                      const std::string& datum, const std::optional<int>& precision) {
  nlohmann::ordered_json object;
  for (const char* key : {"lat", "lon", "height_m", "distance_m", "level", "alpha"}) object[key] = nullptr;
  if (found) {
    object["lat"] = shown(place.lat_deg, precision);
    object["lon"] = shown_longitude(place.lon_deg, precision);
    object["height_m"] = shown(place.h_m, precision);
    object["distance_m"] = shown(found->distance_m, precision);
    object["level"] = found->level;
    object["alpha"] = shown(found->alpha, precision);
  }
  object["sky"] = !found;
  object["datum"] = datum;
  return object.dump();
}

std::string csv_line(const geo::Geodetic& place, const std::optional<DrawnPoint>& found,
                     const std::string& datum, const std::optional<int>& precision) {
  if (!found) return ",,,,,,true," + datum;
  std::string line;
  for (const double value : {shown(place.lat_deg, precision), shown_longitude(place.lon_deg, precision),
                             place.h_m, found->distance_m})
    line += number_text(value, precision) + ',';
  return line + std::to_string(found->level) + ',' + number_text(found->alpha, precision) + ",false," + datum;
}

std::string text_line(const geo::Geodetic& place, const std::optional<DrawnPoint>& found,
                      const std::string& datum, const std::optional<int>& precision) {
  if (!found) return "sky";
  std::string line;
  for (const double value : {shown(place.lat_deg, precision), shown_longitude(place.lon_deg, precision),
                             place.h_m, found->distance_m})
    line += number_text(value, precision) + ' ';
  return line + std::to_string(found->level) + ' ' + number_text(found->alpha, precision) + ' ' + datum;
}

int run(PickOptions options, const CLI::App& command) {
  const std::optional<globe::scene::Scene> scene = take_scene(command, options.camera);
  const Optics optics = optics_of(options.camera.optics);
  const Size size = size_of(options.camera, optics);
  if (!options.camera.look.empty()) parse_look(options.camera.look);
  for (const std::string& pixel : options.pixels) parse_pixel(pixel, size);
  const geo::Geodetic sunny = target_of(options.stand, scene);
  const auto surface = open_planet(options.camera);
  warn_of_unknown_datum(*surface, options.camera.planet);
  sun_for(options.camera, *surface, sunny);  // refuses a --time that shot would refuse
  const Picker picker(surface, options, scene, optics, size);
  const auto& precision = options.records.precision;
  const auto answer = [&](const std::string& record) {
    const std::optional<DrawnPoint> found = picker.at(parse_pixel(record, size));
    const geo::Geodetic place =
        found ? geo::geodetic_from_ecef(surface->ellipsoid(), found->position) : geo::Geodetic{};
    const std::string& datum = surface->info().vertical_datum;
    if (options.records.json) return json_line(place, found, datum, precision);
    return options.records.csv ? csv_line(place, found, datum, precision)
                               : text_line(place, found, datum, precision);
  };
  return answer_records(options.pixels, options.records, "lat,lon,height_m,distance_m,level,alpha,sky,datum",
                        answer, Threads::kAll);
}

}  // namespace

void add_pick(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<PickOptions>();
  CLI::App* command = program.add_subcommand("pick", "the ground that a pixel of a picture shows");
  add_camera_options(*command, options->camera);
  add_stand_options(*command, options->stand);
  command
      ->add_option("--pixel", options->pixels,
                   "X,Y from the top left, once or more; without it: a pixel a line from standard input")
      ->take_all();
  add_record_options(*command, options->records);
  command->footer(
      "Text: LAT LON HEIGHT_M DISTANCE_M LEVEL ALPHA DATUM, or sky.  The camera is that of globe shot with "
      "the\n"
      "same words, the ray goes through the middle of the pixel, and the ground is the surface of triangles "
      "that\n"
      "the picture shows, morphing included, in double precision.  DISTANCE_M is along the ray.  ALPHA is "
      "how "
      "far\n"
      "the ground of LEVEL has turned into that of the coarser level: where it is 0, globe height --drawn "
      "--level\n"
      "LEVEL gives the same height.\n"
      "Example: globe pick procedural --at 46,7,4000 --look 120,-10 --size 1280x720 --pixel 640,360 --json");
  command->callback([options, command, &exit_status] { exit_status = run(*options, *command); });
}

}  // namespace app
