#pragma once

#include <memory>
#include <optional>

#include "app/flat_region.h"
#include "app/view/scenery.h"
#include "globe/render/globe_renderer.h"
#include "globe/scene/scene.h"

namespace app::view {

/// A planet, alone or as a scene has it.
class GlobeScenery : public Scenery {
 public:
  /// A GL context must be current and stay so.
  /// @param word     for the planet or scene, as it was given
  /// @param surface  that the options name
  GlobeScenery(std::string word, const ViewOptions& options, std::optional<globe::scene::Scene> scene,
               std::shared_ptr<const globe::planet::Surface> surface);

  const globe::geo::Ellipsoid& ellipsoid() const override { return surface_->ellipsoid(); }
  globe::render::SurfaceRenderer& renderer() override { return *renderer_; }
  const ViewOptions& options() const override { return options_; }
  std::string body() const override { return surface_->info().body; }
  bool is_animated() const override;
  void complete() override;
  const std::vector<Choice>& choices() const override { return choices_; }
  std::vector<std::string> shot_words() const override;
  double ground_m(double lat_deg, double lon_deg) const override;
  std::string name() const override;

 private:
  /// An effect as it was asked for at first, and as it is now.
  struct EffectChoice {
    std::string name;
    bool in_scene = false;
    bool on = false;
    bool in_renderer = false;
  };

  void remake();
  void make(const globe::scene::Scene& scene);
  void add_choices();
  void add_word_choice(const std::string& name, std::vector<std::string> words, std::string& option);
  void switch_effect(std::size_t index, bool on);
  globe::scene::Scene wanted() const;

  std::string word_;
  ViewOptions options_;
  std::optional<globe::scene::Scene> scene_;
  bool culling_ = true;
  std::vector<EffectChoice> effects_;
  std::vector<Choice> choices_;
  std::shared_ptr<const globe::planet::Surface> surface_;
  std::optional<FlatRegion> region_;
  std::unique_ptr<globe::render::GlobeRenderer> renderer_;
};

}  // namespace app::view
