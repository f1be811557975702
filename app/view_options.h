#pragma once

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/mark_options.h"
#include "app/optics.h"
#include "globe/geo/ellipsoid.h"
#include "globe/geo/utc.h"
#include "globe/planet/surface.h"
#include "globe/render/globe_renderer.h"
#include "globe/scene/scene.h"

namespace app {

/// What says which planet a camera sees and how: options that `pick` shares with `shot` and `fly`.
struct CameraOptions {
  std::string planet;
  std::string look;
  std::string size;  ///< empty: what is usual for the projection
  OpticsOptions optics;
  std::string time;
  std::string overhead;   ///< --sun
  globe::scene::Sun sun;  ///< a scene's, where there is no time
  int detail = 64;
  std::string morph = "on";
  double exaggeration = 1.0;
  globe::planet::LayerChoice layers;  ///< a scene's
  bool agl = false;
};

/// Where the camera looks, how, and by what light: what any ground is seen with.
void add_eye_options(CLI::App& command, CameraOptions& options);
/// The same and the planet, and how finely it is drawn.
void add_camera_options(CLI::App& command, CameraOptions& options);

/// Detail and morphing. Throws UsageError.
globe::clipmap::Settings clipmap_settings(const CameraOptions& options);

/// The options that `shot` and `fly` share (COMMANDS.md, Pictures).
struct ViewOptions : CameraOptions {
  std::string output;
  int samples = 1;
  std::string background;
  bool wireframe = false;
  std::string show;
  std::string positions = "exact";
  std::string window = "plain";
  bool overwrite = false;
  bool quiet = false;
  std::string device = "auto";
  int memory_mb = 640;
  std::vector<std::string> with, without;  ///< effects besides those of a scene, and its own left out
  MarkOptions marks;
  /// Bare where an effect of the scene draws the sea.
  globe::planet::SeaFloor sea_floor = globe::planet::SeaFloor::kFlooded;
};

/// What becomes of pixels, of any ground; the device and the memory.
void add_picture_options(CLI::App& command, ViewOptions& options);
/// What is shown.
void add_look_options(CLI::App& command, ViewOptions& options);
/// The file and what is shown in it.
void add_output_options(CLI::App& command, ViewOptions& options);
/// What frames are drawn with, whatever becomes of them.
void add_drawing_options(CLI::App& command, ViewOptions& options);
/// The same and what `shot` and `fly` need for files and looks.
void add_view_options(CLI::App& command, ViewOptions& options);

/// Opens the planet as it is to be drawn, with --memory for its data where there is such an option. Throws
/// what open_planet (app/planet_argument.h) throws.
std::shared_ptr<const globe::planet::Surface> open_planet(const CameraOptions& options);
std::shared_ptr<const globe::planet::Surface> open_planet(const ViewOptions& options);

/// "HEADING,PITCH" or "HEADING,PITCH,ROLL". Throws UsageError unless both are numbers and the pitch lies in
/// [-90, 90].
Look parse_look(const std::string& text);

struct Size {
  int width = 0;
  int height = 0;
};
/// "WxH", 16 to 16384 a side. Throws UsageError.
Size parse_size(const std::string& text);
/// Of a picture, or what is usual for its projection.
Size size_of(const CameraOptions& options, const Optics& optics);

/// Settings of a renderer from the options. Throws UsageError.
globe::render::RenderSettings render_settings(const ViewOptions& options);

globe::render::Show show_of(const ViewOptions& options);
/// Throws UsageError.
std::optional<glm::vec3> background_of(const ViewOptions& options);

/// Where the sun stands, from second to second of a flight.
class Sunlight {
 public:
  explicit Sunlight(const glm::dvec3& direction) : direction_(direction) {}
  Sunlight(const globe::geo::UtcDate& date, double speed);

  /// Unit vector toward it, ECEF.
  glm::dvec3 at(double seconds) const;
  /// What effects are told of that second: without a date the sky stands with the spring equinox over 0 E.
  globe::render::Instant instant(double seconds) const;

 private:
  glm::dvec3 direction_{1, 0, 0};
  std::optional<globe::geo::UtcDate> date_;  ///< at 0 seconds; none: it stands
  double speed_ = 0;
};

/// The sun of --sun or --time, or as a scene has it, or at 10:00 local solar time at the target. Throws
/// UsageError for a time on a planet where it says nothing.
Sunlight sun_for(const CameraOptions& options, const globe::planet::Surface& surface,
                 const globe::geo::Geodetic& target);
/// @param body  as PlanetInfo::body has it
Sunlight sun_for(const CameraOptions& options, const std::string& body, const globe::geo::Geodetic& target);

}  // namespace app
