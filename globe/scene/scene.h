#pragma once

#include <any>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "globe/geo/point.h"
#include "globe/planet/dataset.h"
#include "globe/scene/fields.h"
#include "globe/scene/path_key.h"

namespace globe::scene {

/// [picture]: what the options of the same names say on the command line (COMMANDS.md, Pictures). What is not
/// there is not said.
struct Picture {
  std::optional<std::string> size;  ///< "WxH"
  std::optional<double> fov_deg;
  std::optional<std::string> projection;
  std::optional<std::string> axis;
  std::optional<int> faces;
  std::optional<int> samples;
  std::optional<std::string> background;  ///< "RRGGBB"
  std::optional<int> detail;
  std::optional<double> exaggeration;
  std::optional<bool> morph;
  std::optional<std::string> positions;
  std::optional<std::string> window;
};

/// [camera]: one that stands.
struct StandingCamera {
  geo::Point at;
  bool agl = false;  ///< the altitude counts from the ground
  std::optional<Look> look;
  double roll_deg = 0;  ///< as PathKey has it; REQUIRES: look
};

/// [path]: one that moves.
struct Path {
  std::vector<PathKey> keys;         ///< make a path (require_path), unless they are in a file
  std::filesystem::path file;        ///< where messages say they come from
  std::optional<double> duration_s;  ///< of the whole path, whatever its times say
  std::optional<double> fps;         ///< frames a second of a film
  std::optional<int> frames;         ///< of a film
  double low_pitch_deg = -10.0;      ///< of places without a look, low down
};

/// [region]: a square part of the planet whose ground is drawn by geomipmapping (flat/) in place of the
/// globe's.
struct Region {
  geo::Geodetic center;
  double side_m = 40e3;
  std::optional<double> spacing_m;  ///< between posts; 1/1024 of the side without
  double error_px = 1.0;            ///< most that its mesh may be off on screen
  bool shadows = true;              ///< its ground throws some
  bool materials = false;           ///< grass, stone and mud, a pass each
};

/// [sun]: at most one of the three.
struct Sun {
  std::optional<std::string> time;        ///< ISO 8601
  std::optional<geo::Geodetic> overhead;  ///< where it stands in the zenith
  struct Position {
    double azimuth_deg = 0;  ///< clockwise from north
    double altitude_deg = 0;
  };
  std::optional<Position> position;  ///< in the sky of the camera's place, or of the path's last one
  double speed = 0;                  ///< seconds of the sun's time to one of the path's; only with `time`
};

/// An effect that a scene asks for, with what its own reader made of its parameters.
struct Effect {
  std::string name;
  int line = 0;
  std::any parameters;
};

/// An effect that there is: its name in scenes, and who reads its table. The reader asks for its keys only;
/// unknown ones are refused by read_scene.
struct EffectKind {
  std::string_view name;
  std::any (*read)(Fields& fields);
};

/// What a scene file says.
struct Scene {
  std::filesystem::path file;
  std::string planet;  ///< a folder, or procedural[:SEED]
  planet::LayerChoice layers;
  Picture picture;
  std::optional<StandingCamera> camera;
  std::optional<Path> path;
  std::optional<Region> region;
  Sun sun;
  std::vector<Effect> effects;  ///< in the file's order
};

/// Reads a scene (README, Scenes). Relative paths in it count from its folder.
///
/// Throws Error of one line, "FILE:LINE: KEY: WHY; WHAT TO DO", for what is no scene: unknown keys, wrong
/// types and ranges, files that are not there, a camera and a path both, effects not among the known ones.
/// @param known  the effects that there are
Scene read_scene(const std::filesystem::path& file, std::span<const EffectKind> known);

/// The same of a text; `file` is for messages and relative paths.
Scene parse_scene(const std::string& text, const std::filesystem::path& file,
                  std::span<const EffectKind> known);

}  // namespace globe::scene
