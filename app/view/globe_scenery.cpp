#include "app/view/globe_scenery.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/records.h"
#include "app/scene_argument.h"
#include "globe/base/error.h"
#include "globe/effects/list.h"
#include "globe/planet/interpolation.h"

namespace app::view {
namespace {

namespace render = globe::render;

const std::vector<std::string> kOffOn{"off", "on"};
const std::vector<std::string> kDetails{"16", "32", "64", "128", "256"};

std::size_t index_of(const std::vector<std::string>& words, const std::string& word) {
  const auto found = std::find(words.begin(), words.end(), word);
  return found == words.end() ? 0 : static_cast<std::size_t>(found - words.begin());
}

bool draws_sea(const std::string& effect) {
  const auto all = globe::effects::all_effects();
  return std::any_of(all.begin(), all.end(),
                     [&](const auto& entry) { return entry.kind.name == effect && entry.draws_sea; });
}

}  // namespace

GlobeScenery::GlobeScenery(std::string word, const ViewOptions& options,
                           std::optional<globe::scene::Scene> scene,
                           std::shared_ptr<const globe::planet::Surface> surface)
    : word_(std::move(word)), options_(options), scene_(std::move(scene)), surface_(std::move(surface)) {
  for (const auto& entry : globe::effects::all_effects()) {
    const std::string name(entry.kind.name);
    const bool asked = scene_ && std::any_of(scene_->effects.begin(), scene_->effects.end(),
                                             [&](const auto& effect) { return effect.name == name; });
    effects_.push_back({name, asked, asked, asked});
  }
  globe::scene::Scene plain = wanted();
  plain.effects.clear();
  plain.region.reset();
  make(plain);
  add_choices();
}

globe::scene::Scene GlobeScenery::wanted() const {
  globe::scene::Scene scene;
  if (scene_) scene = *scene_;
  for (const EffectChoice& effect : effects_) {
    if (effect.on && !effect.in_scene) add_effect(scene, effect.name);
    if (!effect.on && effect.in_scene)
      std::erase_if(scene.effects, [&](const auto& asked) { return asked.name == effect.name; });
  }
  return scene;
}

void GlobeScenery::complete() {
  if (!scene_ || (scene_->effects.empty() && !scene_->region)) return;
  region_ = region_of(scene_, surface_, options_.quiet);
  remake();
}

void GlobeScenery::remake() { make(wanted()); }

void GlobeScenery::make(const globe::scene::Scene& scene) {
  const render::RenderSettings settings = render_settings(options_);
  options_.sea_floor =
      globe::effects::draws_sea(scene) ? globe::planet::SeaFloor::kBare : globe::planet::SeaFloor::kFlooded;
  if (surface_->sea_floor() != options_.sea_floor) surface_ = open_planet(options_);
  std::vector<render::NamedEffect> made = effects_of(scene, *surface_, {});
  renderer_.reset();  // its textures are gone before the next one's are made
  renderer_ = std::make_unique<render::GlobeRenderer>(surface_, settings, std::move(made),
                                                      region_in_globe(region_, scene, settings));
  renderer_->show_as(settings.show, settings.wireframe, culling_);
  for (EffectChoice& effect : effects_) {
    effect.in_renderer = std::any_of(scene.effects.begin(), scene.effects.end(),
                                     [&](const auto& made_of) { return made_of.name == effect.name; });
  }
}

bool GlobeScenery::is_animated() const { return renderer_->moves() || options_.sun.speed != 0.0; }

void GlobeScenery::add_word_choice(const std::string& name, std::vector<std::string> words,
                                   std::string& option) {
  choices_.push_back({name, words, [words, &option] { return index_of(words, option); },
                      [this, words, &option](std::size_t k) {
                        const std::string before = std::exchange(option, words[k]);
                        try {
                          remake();
                        } catch (const globe::Error&) {
                          option = before;
                          remake();
                          throw;
                        }
                      }});
}

void GlobeScenery::add_choices() {
  const auto show = [this] { renderer_->show_as(show_of(options_), options_.wireframe, culling_); };
  choices_.push_back({"wireframe", kOffOn, [this] { return options_.wireframe ? 1u : 0u; },
                      [this, show](std::size_t k) {
                        options_.wireframe = k == 1;
                        show();
                      }});
  const std::vector<std::string> shows{"ground", "levels", "patches", "normals"};
  choices_.push_back({"show", shows, [this, shows] { return index_of(shows, options_.show); },
                      [this, shows, show](std::size_t k) {
                        options_.show = k == 0 ? "" : shows[k];
                        show();
                      }});
  choices_.push_back({"culling", kOffOn, [this] { return culling_ ? 1u : 0u; },
                      [this, show](std::size_t k) {
                        culling_ = k == 1;
                        show();
                      }});
  add_word_choice("morph", kOffOn, options_.morph);
  std::vector<std::string> details = kDetails;
  const std::string detail = std::to_string(options_.detail);
  if (std::find(details.begin(), details.end(), detail) == details.end()) details.push_back(detail);
  choices_.push_back({"detail", details,
                      [this, details] { return index_of(details, std::to_string(options_.detail)); },
                      [this, details](std::size_t k) {
                        options_.detail = std::stoi(details[k]);
                        remake();
                      }});
  add_word_choice("positions", {"exact", "quadratic", "chord", "float32"}, options_.positions);
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    choices_.push_back({effects_[k].name, kOffOn, [this, k] { return effects_[k].on ? 1u : 0u; },
                        [this, k](std::size_t word) { switch_effect(k, word == 1); }});
  }
}

void GlobeScenery::switch_effect(std::size_t index, bool on) {
  EffectChoice& effect = effects_[index];
  if (effect.on == on) return;
  if (effect.in_renderer && !renderer_->colors_ground(effect.name) && !draws_sea(effect.name)) {
    renderer_->switch_effect(effect.name, on);
    effect.on = on;
    return;
  }
  effect.on = on;
  try {
    remake();
  } catch (const globe::Error&) {
    effect.on = !on;
    remake();
    throw;
  }
}

std::vector<std::string> GlobeScenery::shot_words() const {
  std::vector<std::string> words{"shot", word_};
  const ViewOptions usual;
  const auto say = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  say("--detail", std::to_string(options_.detail));
  if (scene_ || options_.morph != usual.morph) say("--morph", options_.morph);
  if (options_.exaggeration != usual.exaggeration)
    say("--exaggeration", number_text(options_.exaggeration, std::nullopt));
  if (scene_ || options_.samples != usual.samples) say("--samples", std::to_string(options_.samples));
  if (!options_.background.empty()) say("--background", options_.background);
  if (options_.wireframe) words.emplace_back("--wireframe");
  if (!options_.show.empty()) say("--show", options_.show);
  if (scene_ || options_.positions != usual.positions) say("--positions", options_.positions);
  if (scene_ || options_.window != usual.window) say("--window", options_.window);
  for (const std::string& file : options_.marks.shapes) say("--shapes", file);
  if (options_.marks.graticule) {
    words.emplace_back("--graticule");
    if (!options_.marks.graticule->empty()) words.push_back(*options_.marks.graticule);
  }
  if (!options_.marks.labels.empty()) say("--labels", options_.marks.labels);
  for (const EffectChoice& effect : effects_) {
    // Those that options added are in the scene as it came here.
    const bool added = std::count(options_.with.begin(), options_.with.end(), effect.name) > 0;
    const bool left_out = std::count(options_.without.begin(), options_.without.end(), effect.name) > 0;
    if (effect.on && (added || !effect.in_scene)) say("--with", effect.name);
    if (!effect.on && (left_out || (effect.in_scene && !added))) say("--without", effect.name);
  }
  return words;
}

double GlobeScenery::ground_m(double lat_deg, double lon_deg) const {
  if (!surface_->has_heights()) return 0.0;
  const double ground =
      globe::planet::data_height_at(*surface_, globe::geo::normal_from_degrees(lat_deg, lon_deg),
                                    globe::planet::Interpolation::kLinear)
          .height_m;
  return surface_->drawn_height(ground);
}

std::string GlobeScenery::name() const {
  if (procedural_seed(word_)) return word_;
  return std::filesystem::absolute(word_).lexically_normal().string();
}

}  // namespace app::view
