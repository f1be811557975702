#include "app/view/flat_scenery.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/records.h"

namespace app::view {
namespace {

const std::vector<std::string> kSwitch{"off", "on"};

}  // namespace

FlatScenery::FlatScenery(std::vector<std::string> given, const FlatOptions& options, FlatRegion region)
    : words_(std::move(given)),
      options_(options),
      region_(std::move(region)),
      colors_(globe::flat::post_colors(*region_.terrain, region_.knowledge)) {
  remake();
  add_choices();
}

void FlatScenery::remake() {
  renderer_.reset();  // its buffers are gone before the next one's are made
  renderer_ = std::make_unique<globe::flat::GeomipmapRenderer>(region_.terrain, colors_,
                                                               geomipmap_settings(options_, region_));
}

void FlatScenery::add_choices() {
  const auto add = [this](const char* name, const std::vector<std::string>& words, std::string& option) {
    choices_.push_back({name, words,
                        [words, &option] {
                          const auto found = std::find(words.begin(), words.end(), option);
                          return found == words.end() ? 0 : static_cast<std::size_t>(found - words.begin());
                        },
                        [this, words, &option](std::size_t k) {
                          option = words[k];
                          remake();
                        }});
  };
  choices_.push_back({"wireframe", kSwitch, [this] { return options_.wireframe ? 1u : 0u; },
                      [this](std::size_t k) {
                        options_.wireframe = k == 1;
                        remake();
                      }});
  add("show", {"", "levels", "patches", "normals"}, options_.show);
  add("lod", kSwitch, options_.lod);
  add("culling", kSwitch, options_.culling);
  add("morph", {"off", "cpu", "gpu"}, options_.morph_by);
  add("shadows", kSwitch, options_.shadows);
  add("materials", kSwitch, options_.materials);
  choices_.push_back({"cloud shadows", kSwitch, [this] { return options_.cloud_shadows > 0.0 ? 1u : 0u; },
                      [this](std::size_t k) {
                        options_.cloud_shadows = k == 1 ? 0.5 : 0.0;
                        remake();
                      }});
}

std::vector<std::string> FlatScenery::shot_words() const {
  std::vector<std::string> words{"flat", "shot"};
  words.insert(words.end(), words_.begin(), words_.end());
  const auto say = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  const auto number = [](double value) { return number_text(value, std::nullopt); };
  // Where nothing says where a region lies, it lies around the camera.
  const bool is_map = std::filesystem::is_regular_file(words_.front());
  if (!is_map && std::find(words_.begin(), words_.end(), "--center") == words_.end()) {
    const globe::geo::Geodetic& middle = region_.terrain->frame().origin();
    say("--center", number(middle.lat_deg) + "," + number(middle.lon_deg));
  }
  say("--error", number(options_.error_px));
  say("--lod", options_.lod);
  say("--culling", options_.culling);
  say("--morph", options_.morph_by);
  say("--shadows", options_.shadows);
  say("--materials", options_.materials);
  if (options_.cloud_shadows > 0.0) say("--cloud-shadows", number(options_.cloud_shadows));
  say("--pvs", options_.pvs);
  if (options_.exaggeration != 1.0) say("--exaggeration", number(options_.exaggeration));
  say("--samples", std::to_string(options_.samples));
  say("--background", options_.background);
  if (options_.wireframe) words.emplace_back("--wireframe");
  say("--show", options_.show);
  return words;
}

double FlatScenery::ground_m(double lat_deg, double lon_deg) const {
  const globe::flat::TangentFrame& frame = region_.terrain->frame();
  const glm::dvec3 foot = frame.local_from_geodetic({lat_deg, lon_deg, 0.0});
  const double z = region_.terrain->z_at(foot.x, foot.y);
  return frame.geodetic_from_local({foot.x, foot.y, z}).h_m;
}

std::string FlatScenery::name() const {
  std::string name = "flat";
  for (const std::string& word : words_)
    name += ' ' + (std::filesystem::exists(word) ? std::filesystem::absolute(word).lexically_normal().string()
                                                 : word);
  return name;
}

}  // namespace app::view
