#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "globe/base/angles.h"
#include "globe/clipmap/culling.h"
#include "globe/effects/entry.h"
#include "globe/effects/graticule.h"
#include "globe/effects/ground_in_view.h"
#include "globe/effects/label_atlas.h"
#include "globe/effects/label_layout.h"
#include "globe/effects/mark_parameters.h"
#include "globe/effects/named_places.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace globe::effects {
namespace {

constexpr std::size_t kMost = 400;        ///< labels that a view is laid out with, those that matter most
constexpr double kRaised_px = 6.0;        ///< what has to be seen of a place, above the ground
constexpr double kSmallest_px = 12.0;     ///< area or line that is named
constexpr double kBeside_px = 7.0;        ///< from a point to its name
constexpr double kHalo = 0.12;            ///< around letters, of their size
constexpr double kAtEdge_px = 12.0;       ///< from the picture's edge, in which labels fade
constexpr int kSteps = 24;                ///< of a line of sight
constexpr double kCoarser = 4.0;          ///< its ground, than what is drawn
constexpr int kLinesAround = 10;          ///< meridians and parallels that are named either way
constexpr double kWholePlanet_m = 1e12;   ///< what a line of a graticule is as large as
constexpr double kLastMeridian_deg = 80;  ///< latitude at which meridians are named at most

LabelsParameters read_labels(scene::Fields& fields) {
  LabelsParameters parameters;
  if (const auto file = fields.file("file")) parameters.files.push_back(*file);
  parameters.property = fields.text("property").value_or("");
  parameters.priority = fields.text("priority").value_or("");
  if (fields.flag("graticule").value_or(false)) parameters.graticule.emplace();
  const auto step = fields.angle_deg("step", {1.0 / 360'000.0, 90.0});
  if (step && !parameters.graticule)
    fields.refuse("step", "it is the graticule's", "give graticule = true too");
  if (step && !divides_quarter(*step))
    fields.refuse("step", "it does not divide 90 degrees", "give a step such as 10, 0.5, or \"1 arcmin\"");
  if (step) parameters.graticule->step_deg = step;
  if (const auto color = fields.color("color")) parameters.color = *color;
  parameters.size_px = fields.number("size", {6.0, 100.0}).value_or(parameters.size_px);
  if (const auto font = fields.file("font")) parameters.font = *font;
  if (parameters.files.empty() && !parameters.graticule)
    fields.refuse("", "there is nothing to name", "give file = \"NAME.geojson\", or graticule = true");
  return parameters;
}

/// Mirrors the attributes of shaders/effects/labels.vert.
struct LabelInstance {
  glm::vec4 place;
  glm::vec4 source;
  float share;
};

/// A text and the place on the planet that it belongs to.
struct Label {
  std::string text;
  NamedPlace::Kind kind = NamedPlace::Kind::kPoint;
  glm::dvec3 u{0.0};
  double size_m = 0;  ///< of what it names
  double wish = 1;
};

/// Names at their places. Where there is no room for all, those that matter more are shown; what the ground
/// or the horizon hides is not named.
class Labels final : public render::Effect {
 public:
  Labels(const LabelsParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters),
        atlas_(LabelFont(parameters.font.empty() ? kUsualFont : parameters.font, parameters.size_px,
                         kHalo * parameters.size_px)),
        heights_(drawn_heights(surface)) {
    const double degree_m = surface.ellipsoid().mean_radius() * kDegree;
    for (const std::filesystem::path& file : parameters.files) {
      for (NamedPlace& place : read_named_places(file, parameters.property, parameters.priority))
        names_.push_back({std::move(place.name), place.kind,
                          geo::normal_from_degrees(place.lat_deg, place.lon_deg), place.size_deg * degree_m,
                          1.0});
    }
  }

  render::Stage stage() const override { return render::Stage::kLens; }

  render::Verdict judge(const render::EffectView& view) const override {
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    if (parameters_.graticule) return {true, "ground is in view"};
    const Sight sight(view, heights_);
    const bool any =
        std::any_of(names_.begin(), names_.end(), [&](const Label& label) { return sight.may_see(label); });
    return {any, any ? "names are in view" : "none of its places is in view"};
  }

  void compile(const render::EffectHost& /*host*/) override {
    gl::ProgramSources sources;
    sources.files = {"effects/labels.vert", "effects/labels.frag"};
    program_ = gl::Program(sources);
    array_ = gl::VertexArray::create();
    array_.set_attribute(0, {0, 4, GL_FLOAT, offsetof(LabelInstance, place), gl::Attribute::Kind::kFloat});
    array_.set_attribute(0, {1, 4, GL_FLOAT, offsetof(LabelInstance, source), gl::Attribute::Kind::kFloat});
    array_.set_attribute(0, {2, 1, GL_FLOAT, offsetof(LabelInstance, share), gl::Attribute::Kind::kFloat});
  }

  void draw(const render::EffectView& view) override {
    const std::vector<LabelInstance> shown = laid_out(view);
    if (shown.empty()) return;
    const std::size_t bytes = shown.size() * sizeof(LabelInstance);
    if (bytes > instances_.size()) instances_ = gl::Buffer(bytes + bytes / 2);
    instances_.upload(0, shown.data(), bytes);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    array_.set_vertices(0, instances_, 0, sizeof(LabelInstance), 1);
    array_.bind();
    atlas_.texture().bind(0);
    program_.use();
    program_.set(
        0, glm::vec2(static_cast<float>(view.target.width()), static_cast<float>(view.target.height())));
    program_.set(1, glm::vec4(parameters_.color, 1.0f));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(shown.size()));
    glEnable(GL_DEPTH_TEST);
  }

  std::size_t gpu_bytes() const override { return instances_.size() + atlas_.bytes(); }

 private:
  /// A place as a view has it.
  struct Seen {
    glm::dvec3 relative{0.0};  ///< metres from the eye
    double distance_m = 0;
    glm::dvec2 pixel{0.0};  ///< from the picture's left and top
  };

  /// Where places are in a view.
  class Sight {
   public:
    Sight(const render::EffectView& view, const glm::dvec2& heights)
        : view_(view),
          heights_(heights),
          frustum_(view.camera.forward, view.camera.right, view.camera.up, view.camera.tan_x(),
                   view.camera.tan_y()),
          horizon_(view.surface.ellipsoid(), heights.x, view.camera.position),
          pixel_(2.0 * view.camera.tan_y() / view.target.height()) {}

    /// False only when it is out of view or behind the horizon.
    bool may_see(const Label& label) const {
      const glm::dvec3 centre = place(label.u, 0.5 * (heights_.x + heights_.y));
      const double radius = 0.5 * (heights_.y - heights_.x);
      return frustum_.sees(centre - view_.camera.position, radius) &&
             horizon_.sees(centre, radius, heights_.y);
    }

    std::optional<Seen> find(const Label& label) const {
      if (!may_see(label)) return std::nullopt;
      const glm::dvec3 low = place(label.u, heights_.x) - view_.camera.position;
      const double about = std::max(glm::length(low) - (heights_.y - heights_.x), view_.above_ground_m);
      const double h = view_.surface.drawn_height(ground_height(view_, label.u, about));
      Seen seen;
      seen.relative = place(label.u, h) - view_.camera.position;
      seen.distance_m = glm::length(seen.relative);
      const render::Camera& camera = view_.camera;
      const double ahead = glm::dot(seen.relative, camera.forward);
      if (ahead <= 0.0) return std::nullopt;
      const glm::dvec2 at(glm::dot(seen.relative, camera.right) / (ahead * camera.tan_x()),
                          glm::dot(seen.relative, camera.up) / (ahead * camera.tan_y()));
      if (std::abs(at.x) > 1.0 || std::abs(at.y) > 1.0) return std::nullopt;
      seen.pixel = {(0.5 + 0.5 * at.x) * view_.target.width(), (0.5 - 0.5 * at.y) * view_.target.height()};
      return seen;
    }

    /// How far a place is seen over the ground before it: 0 hidden, 1 clear of it by some pixels.
    double clear(const Label& label, const Seen& seen) const {
      const geo::Ellipsoid& ellipsoid = view_.surface.ellipsoid();
      const glm::dvec3 to = seen.relative + label.u * (kRaised_px * pixel_ * seen.distance_m);
      double least_px = kRaised_px;
      for (int k = 1; k < kSteps; ++k) {
        // Closer together toward the place: what is near it hides it more easily.
        const double back = 1.0 - static_cast<double>(k) / kSteps, s = 1.0 - back * back;
        const geo::Geodetic at = geo::geodetic_from_ecef(ellipsoid, view_.camera.position + to * s);
        if (at.h_m > heights_.y) continue;
        const glm::dvec3 u = geo::normal_from_degrees(at.lat_deg, at.lon_deg);
        const double distance = s * seen.distance_m;
        const double ground = view_.surface.drawn_height(
            ground_height(view_, u, kCoarser * std::max(distance, view_.above_ground_m)));
        least_px = std::min(least_px, (at.h_m - ground) / (pixel_ * distance));
      }
      return glm::smoothstep(0.0, 3.0, least_px);
    }

    double pixel() const { return pixel_; }

   private:
    glm::dvec3 place(const glm::dvec3& u, double h_m) const {
      return geo::ecef_from_normal(view_.surface.ellipsoid(), u, h_m);
    }

    const render::EffectView& view_;
    glm::dvec2 heights_;
    clipmap::Frustum frustum_;
    clipmap::Horizon horizon_;
    double pixel_;
  };

  std::vector<LabelInstance> laid_out(const render::EffectView& view) {
    const Sight sight(view, heights_);
    const glm::dvec2 picture(view.target.width(), view.target.height());
    std::vector<const Label*> labels;
    std::vector<Seen> places;
    std::vector<LabelBox> boxes;
    const std::vector<Label> lines = graticule_labels(view);
    for (const std::vector<Label>* list : std::initializer_list<const std::vector<Label>*>{&names_, &lines}) {
      for (const Label& label : *list) {
        if (boxes.size() == kMost) break;
        const std::optional<Seen> seen = sight.find(label);
        if (!seen) continue;
        const LabelBox box = box_of(label, *seen, sight.pixel(), picture);
        if (box.wish <= 0.0) continue;
        labels.push_back(&label);
        places.push_back(*seen);
        boxes.push_back(box);
      }
    }
    const std::vector<double> shares =
        label_shares(boxes, [&](std::size_t k) { return sight.clear(*labels[k], places[k]); });
    std::vector<LabelInstance> shown;
    const auto collect = [&] {
      shown.clear();
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (shares[k] <= 0.0) continue;
        const glm::vec4 source(atlas_.place_of(labels[k]->text));
        shown.push_back(
            {glm::vec4(glm::vec2(boxes[k].low), source.z, source.w), source, static_cast<float>(shares[k])});
      }
    };
    collect();
    // Twice at most: what does not fit into the texture at once has no place on the screen either.
    if (atlas_.is_anew()) collect();
    return shown;
  }

  LabelBox box_of(const Label& label, const Seen& seen, double pixel, const glm::dvec2& picture) {
    const glm::dvec2 size(atlas_.size_of(label.text));
    if (size.x == 0.0) return {{}, {}, 0.0};
    glm::dvec2 low = seen.pixel - 0.5 * size;
    double wish = label.wish;
    if (label.kind == NamedPlace::Kind::kPoint) {
      low.x = seen.pixel.x + kBeside_px;
    } else {
      const double size_px = label.size_m / (seen.distance_m * pixel);
      wish *= glm::smoothstep(kSmallest_px, 2.0 * kSmallest_px, size_px);
      if (label.kind == NamedPlace::Kind::kLine) low.y = seen.pixel.y - size.y - 0.5 * kBeside_px;
    }
    low = glm::floor(low + 0.5);
    LabelBox box{low, low + size, wish};
    const double inside = std::min({box.low.x, box.low.y, picture.x - box.high.x, picture.y - box.high.y});
    box.wish *= glm::smoothstep(0.0, kAtEdge_px, inside);
    return box;
  }

  /// The lines about the middle of what is seen, between those that cross them.
  std::vector<Label> graticule_labels(const render::EffectView& view) const {
    std::vector<Label> labels;
    if (!parameters_.graticule) return labels;
    const geo::Ellipsoid& ellipsoid = view.surface.ellipsoid();
    const double ground_m = view.height_m - view.above_ground_m;
    const GraticuleSteps steps = parameters_.graticule->step_deg
                                     ? fixed_steps(*parameters_.graticule->step_deg)
                                     : steps_in_view(ellipsoid, view.camera, ground_m);
    double hit = -1.0;
    for (const double y : {0.55, 0.75, 0.95}) {
      if (hit >= 0.0) break;
      hit = geo::ray_ellipsoid(ellipsoid, ground_m, view.camera.position,
                               render::direction_through(view.camera, 0.5, y));
      if (hit >= 0.0) {
        const geo::Geodetic middle = geo::geodetic_from_ecef(
            ellipsoid, view.camera.position + render::direction_through(view.camera, 0.5, y) * hit);
        add_lines(middle, steps.step_arcsec, 1.0 - steps.finer_share, labels);
        if (steps.finer_share > 0.0) add_lines(middle, steps.finer_arcsec, steps.finer_share, labels);
      }
    }
    return labels;
  }

  /// @param share  of the labels
  static void add_lines(const geo::Geodetic& middle, double step, double share, std::vector<Label>& labels) {
    if (share <= 0.0) return;
    const double lat = middle.lat_deg * 3600.0 / step, lon = middle.lon_deg * 3600.0 / step;
    const double last = kLastMeridian_deg * 3600.0 / step;
    const auto add = [&](std::string text, double at_lat, double at_lon, double wish) {
      labels.push_back(
          {std::move(text), NamedPlace::Kind::kPoint,
           geo::normal_from_degrees(std::clamp(at_lat * step / 3600.0, -90.0, 90.0), at_lon * step / 3600.0),
           kWholePlanet_m, wish});
    };
    // Halfway between two lines, the nearer the more: as the view moves on the next place takes over.
    for (const double place : {std::floor(lon) - 0.5, std::floor(lon) + 0.5, std::floor(lon) + 1.5}) {
      const double wish = share * (1.0 - glm::smoothstep(0.35, 0.65, std::abs(place - lon)));
      for (int k = -kLinesAround; k <= kLinesAround && wish > 0.0; ++k) {
        const double line = std::round(lat) + k;
        if (std::abs(line * step) < 90.0 * 3600.0) add(latitude_text(line * step, step), line, place, wish);
      }
    }
    for (const double place : {std::floor(lat) - 0.5, std::floor(lat) + 0.5, std::floor(lat) + 1.5}) {
      const double wish = share * (1.0 - glm::smoothstep(0.35, 0.65, std::abs(place - lat)));
      for (int k = -kLinesAround; k <= kLinesAround && wish > 0.0; ++k) {
        const double line = std::round(lon) + k;
        add(longitude_text(line * step, step), std::clamp(place, -last, last), line, wish);
      }
    }
  }

  LabelsParameters parameters_;
  LabelAtlas atlas_;
  glm::dvec2 heights_;
  std::vector<Label> names_;  ///< those that matter most first
  gl::Program program_;
  gl::VertexArray array_;
  gl::Buffer instances_;
};

}  // namespace

EffectEntry labels() { return entry_of<LabelsParameters, Labels, read_labels>("labels"); }

}  // namespace globe::effects
