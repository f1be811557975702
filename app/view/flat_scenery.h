#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/flat_options.h"
#include "app/view/scenery.h"
#include "flat/geomipmap_renderer.h"

namespace app::view {

/// A local region.
class FlatScenery : public Scenery {
 public:
  /// A GL context must be current and stay so.
  /// @param words  for the region and which part of it, as they were given
  FlatScenery(std::vector<std::string> words, const FlatOptions& options, FlatRegion region);

  const globe::geo::Ellipsoid& ellipsoid() const override { return region_.terrain->frame().ellipsoid(); }
  globe::render::SurfaceRenderer& renderer() override { return *renderer_; }
  const ViewOptions& options() const override { return options_; }
  std::string body() const override { return region_.body; }
  bool is_animated() const override { return options_.cloud_shadows > 0.0; }
  void complete() override {}
  const std::vector<Choice>& choices() const override { return choices_; }
  std::vector<std::string> shot_words() const override;
  double ground_m(double lat_deg, double lon_deg) const override;
  std::string name() const override;

 private:
  void remake();
  void add_choices();

  std::vector<std::string> words_;
  FlatOptions options_;
  FlatRegion region_;
  std::vector<glm::vec4> colors_;
  std::vector<Choice> choices_;
  std::unique_ptr<globe::flat::GeomipmapRenderer> renderer_;
};

}  // namespace app::view
