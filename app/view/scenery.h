#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/view_options.h"
#include "globe/geo/ellipsoid.h"
#include "globe/render/surface_renderer.h"

namespace app::view {

/// One thing that a person can set while looking: one of some words.
struct Choice {
  std::string name;
  std::vector<std::string> words;  ///< "off" and "on": a switch
  std::function<std::size_t()> get;
  /// Throws globe::Error when it cannot be had here; nothing has changed then.
  std::function<void(std::size_t)> set;

  bool is_switch() const { return words.size() == 2 && words[0] == "off" && words[1] == "on"; }
};

/// What a window shows: a planet, with its scene, or a local region.
class Scenery {
 public:
  Scenery() = default;
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;
  virtual ~Scenery() = default;

  virtual const globe::geo::Ellipsoid& ellipsoid() const = 0;
  /// The one of now: a choice may make another.
  virtual globe::render::SurfaceRenderer& renderer() = 0;
  const globe::render::SurfaceRenderer& renderer() const { return const_cast<Scenery*>(this)->renderer(); }
  /// As the choices have left them.
  virtual const ViewOptions& options() const = 0;
  /// As PlanetInfo::body has it.
  virtual std::string body() const = 0;
  /// Whether time changes the picture.
  virtual bool is_animated() const = 0;

  /// Makes what takes long and a first picture does without; until then there is that only.
  virtual void complete() = 0;

  /// What can be set, in the order of an overlay; the same ones all the time.
  virtual const std::vector<Choice>& choices() const = 0;

  /// Words after "globe" that make the same picture, with the choices as they are, camera and sun left out.
  virtual std::vector<std::string> shot_words() const = 0;

  /// Height of the ground, or of the sea over it, above the ellipsoid, by the data, metres.
  virtual double ground_m(double lat_deg, double lon_deg) const = 0;

  /// Name under which the last view is remembered.
  virtual std::string name() const = 0;
};

}  // namespace app::view
