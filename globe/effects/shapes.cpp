#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "globe/base/error.h"
#include "globe/effects/entry.h"
#include "globe/effects/ground_in_view.h"
#include "globe/effects/map_eye.h"
#include "globe/effects/mark_parameters.h"
#include "globe/effects/shape_cells.h"
#include "globe/effects/shape_lines.h"
#include "globe/effects/uniform_block.h"
#include "globe/geo/geojson.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace globe::effects {
namespace {

constexpr std::size_t kMostFilled = 8;  ///< layers, in shaders/effects/shapes.glsl
constexpr double kFarthest_deg = 3600;  ///< from Greenwich
constexpr double kFar_m = 60e3;         ///< of the eye: there the planet's highest mountain is low
constexpr double kSteepest = 2.0;       ///< rise over run of the ground under a piece of a line
constexpr double kCoarser = 0.03;       ///< that the ground drawn may be off, of its distance
constexpr float kHaloOpacity = 0.55f;

ShapeLayer read_layer(scene::Fields& fields) {
  ShapeLayer layer;
  layer.file = fields.required("file", fields.file("file"), "write file = \"NAME.geojson\"");
  if (const auto color = fields.color("color")) layer.color = *color;
  layer.width_px = fields.number("width", {0.0, 100.0}).value_or(layer.width_px);
  layer.fill = fields.number("fill", {0.0, 1.0}).value_or(layer.fill);
  layer.point_px = fields.number("points", {0.0, 100.0}).value_or(layer.point_px);
  layer.halo_px = fields.number("halo", {0.0, 20.0}).value_or(layer.halo_px);
  return layer;
}

ShapesParameters read_shapes(scene::Fields& fields) {
  ShapesParameters parameters;
  parameters.error_px = fields.number("error", {0.01, 10.0}).value_or(parameters.error_px);
  std::vector<scene::Fields> layers = fields.tables("layers");
  if (layers.empty() || fields.has("file")) parameters.layers.push_back(read_layer(fields));
  for (scene::Fields& layer : layers) {
    parameters.layers.push_back(read_layer(layer));
    layer.finish();
  }
  return parameters;
}

/// Mirrors `Shapes` in shaders/effects/shapes.glsl (std140).
struct ShapesBlock {
  MapEye eye;
  std::array<glm::vec4, kMostFilled> color;
  std::array<glm::ivec4, kMostFilled> table;
  glm::dvec2 eye_deg;
  glm::ivec4 layers;
};

/// A layer as it is read.
struct Layer {
  ShapeLayer look;
  std::vector<ShapeLine> lines;
  std::vector<glm::dvec3> points;           ///< normals
  std::vector<ShapeCells::Rings> polygons;  ///< until their table is made

  bool has_pass() const { return !lines.empty() || !points.empty(); }
};

bool on_antimeridian(double lon_deg) { return std::remainder(lon_deg - 180.0, 360.0) == 0.0; }

/// The border of a feature's polygons, without what is none: a pole, and the antimeridian where polygons that
/// were cut there meet (as region::MapPolygon has it).
class Border {
 public:
  void add_ring(const ShapeCells::Ring& ring) {
    std::vector<MapCorner> line;
    const auto end_line = [&] {
      if (line.size() > 1) lines_.push_back(std::move(line));
      line = {};
    };
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const MapCorner &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const bool pole = a.lat_deg == b.lat_deg && std::abs(a.lat_deg) == 90.0;
      const bool seam = a.lon_deg == b.lon_deg && on_antimeridian(a.lon_deg);
      if (seam) {
        ++seam_[std::min(a.lat_deg, b.lat_deg)];
        --seam_[std::max(a.lat_deg, b.lat_deg)];
      }
      if (pole || seam) {
        end_line();
      } else {
        if (line.empty()) line.push_back(a);
        line.push_back(b);
      }
    }
    end_line();
  }

  std::vector<std::vector<MapCorner>> lines() && {
    int depth = 0;
    double south = -90.0;
    for (const auto& [lat, change] : seam_) {
      if (depth % 2 != 0) lines_.push_back({{south, 180.0}, {lat, 180.0}});
      depth += change;
      south = lat;
    }
    return std::move(lines_);
  }

 private:
  std::vector<std::vector<MapCorner>> lines_;
  std::map<double, int>
      seam_;  ///< how often the antimeridian is an edge, by the latitudes where that changes
};

std::vector<MapCorner> corners_of(const geo::Geometry::Line& places, const std::string& where) {
  std::vector<MapCorner> corners;
  corners.reserve(places.size());
  for (const geo::Geodetic& place : places) {
    if (std::abs(place.lon_deg) > kFarthest_deg)
      throw Error(where, "a longitude is beyond 3600 degrees", "give longitudes within 180 degrees");
    const MapCorner corner{place.lat_deg, place.lon_deg};
    if (corners.empty() || corners.back().lat_deg != corner.lat_deg ||
        corners.back().lon_deg != corner.lon_deg)
      corners.push_back(corner);
  }
  return corners;
}

Layer read_file(const ShapeLayer& look, const geo::Ellipsoid& ellipsoid) {
  Layer layer{look, {}, {}, {}};
  const auto half_width = static_cast<float>(0.5 * look.width_px);
  bool found = false;
  geo::visit_geojson(look.file, [&](geo::Feature&& feature) {
    const std::string where = look.file.string() + ", feature " + std::to_string(feature.number);
    found = found || !feature.geometry.empty();
    for (const geo::Geodetic& point : feature.geometry.points) {
      const MapCorner at = corners_of({point}, where).front();
      if (look.point_px > 0.0) layer.points.push_back(geo::normal_from_degrees(at.lat_deg, at.lon_deg));
    }
    std::vector<std::vector<MapCorner>> lines;
    for (const geo::Geometry::Line& line : feature.geometry.lines) {
      // Of one place alone: a point as wide as the line.
      lines.push_back(corners_of(line, where));
    }
    Border border;
    for (const geo::Geometry::Rings& rings : feature.geometry.polygons) {
      ShapeCells::Rings& polygon = layer.polygons.emplace_back();
      for (const geo::Geometry::Line& ring : rings) {
        polygon.push_back(corners_of(ring, where));
        border.add_ring(polygon.back());
      }
    }
    for (std::vector<MapCorner>& line : std::move(border).lines()) lines.push_back(std::move(line));
    for (std::vector<MapCorner>& line : lines) {
      if (look.width_px > 0.0) layer.lines.emplace_back(ellipsoid, std::move(line), half_width);
    }
  });
  if (!found) throw Error(look.file.string(), "it has no points, lines or polygons", "give a file with some");
  return layer;
}

/// Points, lines and polygons of GeoJSON files on whatever surface is drawn.
///
/// What is inside polygons is decided for each pixel of the ground in its own program. Lines and points are
/// boxes about short pieces of them, drawn over the surface, whose pixels are kept where the surface drawn
/// there lies on the line: at any level of detail, and on water.
class Shapes final : public render::Effect {
 public:
  Shapes(const ShapesParameters& parameters, const planet::Surface& surface)
      : error_px_(parameters.error_px), heights_(drawn_heights(surface)) {
    for (const ShapeLayer& look : parameters.layers) {
      Layer& layer = layers_.emplace_back(read_file(look, surface.ellipsoid()));
      if (look.fill > 0.0 && !layer.polygons.empty()) {
        if (filled_.size() == kMostFilled)
          throw Refused{"more than 8 of its files have polygons to fill", "give some of them fill = 0"};
        filled_.push_back({look, ShapeCells(layer.polygons), {}});
      }
      layer.polygons = {};
    }
  }

  render::EffectShader shader() const override {
    render::EffectShader shader;
    if (filled_.empty()) return shader;
    shader.file = "effects/shapes.glsl";
    shader.adds_light = true;
    return shader;
  }

  render::Stage stage() const override {
    const bool any =
        std::any_of(layers_.begin(), layers_.end(), [](const Layer& layer) { return layer.has_pass(); });
    return any ? render::Stage::kLayer : render::Stage::kNone;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    if (!filled_.empty()) return {true, "ground is in view"};
    const ViewOfLines lines(view, heights_, error_px_);
    for (const Layer& layer : layers_) {
      for (const ShapeLine& line : layer.lines)
        if (line.may_be_seen(lines.view)) return {true, "lines or points are in view"};
      for (const glm::dvec3& u : layer.points)
        if (lines.may_see(u)) return {true, "lines or points are in view"};
    }
    return {false, "none of them is in view"};
  }

  void compile(const render::EffectHost& /*host*/) override {
    gl::ProgramSources sources;
    sources.files = {"effects/shapes_line.vert", "effects/shapes_line.frag"};
    program_ = gl::Program(sources);
    sources.files = {"effects/shapes_point.vert", "effects/shapes_point.frag"};
    point_program_ = gl::Program(sources);
    sources.files = {"wide_view.vert", "effects/shapes_halo.frag"};
    halo_program_ = gl::Program(sources);
    point_array_ = gl::VertexArray::create();
    point_array_.set_attribute(0, {0, 4, GL_FLOAT, 0, gl::Attribute::Kind::kFloat});
    array_ = gl::VertexArray::create();
    for (GLuint k = 0; k < sizeof(Arc) / sizeof(glm::vec4); ++k)
      array_.set_attribute(
          0, {k, 4, GL_FLOAT, static_cast<GLuint>(k * sizeof(glm::vec4)), gl::Attribute::Kind::kFloat});
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    if (filled_.empty()) return;
    if (tables_.size() == 0) make_tables();
    const geo::Geodetic eye = geo::geodetic_from_ecef(view.surface.ellipsoid(), view.camera.position);
    ShapesBlock block{};
    block.eye = map_eye(view.surface.ellipsoid(), eye);
    for (std::size_t k = 0; k < filled_.size(); ++k) {
      block.color[k] = glm::vec4(filled_[k].look.color, static_cast<float>(filled_[k].look.fill));
      block.table[k] = filled_[k].words;
    }
    block.eye_deg = {eye.lon_deg, eye.lat_deg};
    block.layers.x = static_cast<int>(filled_.size());
    block_.bind(block, bindings.block);
    tables_.bind_base(GL_SHADER_STORAGE_BUFFER, bindings.block);
  }

  void draw(const render::EffectView& view) override {
    find_arcs(view);
    if (arcs_.empty() && points_.empty()) return;
    const gl::Framebuffer& picture = view.target;
    picture.resolve();
    picture.bind();
    // The depth that is looked up is that of the picture drawn into: nothing writes it.
    glDepthMask(GL_FALSE);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);  // the far sides of boxes: an eye may stand in one
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glTextureBarrier();
    picture.depth().bind(0);
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      draw_lines(view, layers_[k].look, ranges_[k]);
      draw_points(view, layers_[k].look, point_ranges_[k]);
    }
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_CLAMP);
    glEnable(GL_DEPTH_TEST);
  }

  int passes() const override {
    return static_cast<int>(std::count_if(layers_.begin(), layers_.end(),
                                          [](const Layer& layer) { return layer.has_pass(); })) *
           3;
  }
  std::size_t gpu_bytes() const override {
    return block_.bytes() + tables_.size() + instances_.size() + point_instances_.size();
  }

 private:
  struct Filled {
    ShapeLayer look;
    ShapeCells cells;
    glm::ivec4 words;  ///< of the shader's block
  };
  /// Of the arcs.
  struct Range {
    GLuint first = 0;
    GLsizei count = 0;
  };

  /// What lines are told of a view; refers to its own members.
  struct ViewOfLines {
    ViewOfLines(const render::EffectView& of, const glm::dvec2& heights, double error_px)
        : frustum(of.camera.forward, of.camera.right, of.camera.up, of.camera.tan_x(), of.camera.tan_y()),
          horizon(of.surface.ellipsoid(), heights.x, of.camera.position),
          view{of.surface.ellipsoid(),
               of.camera.position,
               frustum,
               horizon,
               2.0 * of.camera.tan_y() / of.target.height(),
               error_px,
               of.height_m - of.above_ground_m,
               of.above_ground_m,
               heights.x,
               heights.y,
               {}} {
      const double far_m = kFar_m * geo::small_body_scale(of.surface.ellipsoid());
      view.ground = [&of, heights, far_m](const glm::dvec3& u, double within_m,
                                          double distance_m) -> glm::dvec2 {
        const planet::Surface& surface = of.surface;
        const double slack =
            kSteepest * within_m * std::max(surface.exaggeration(), 1.0) + kCoarser * distance_m;
        if (distance_m > far_m || 2.0 * slack > heights.y - heights.x) return heights;
        const double h = ground_height(of, u, distance_m);
        const double wave = surface.has_bare_floor() && h < planet::kHighestWave ? planet::kHighestWave : 0.0;
        return {std::max(surface.mesh_height(h) - slack, heights.x),
                std::min(surface.drawn_height(h) + wave + slack, heights.y)};
      };
    }
    /// Whether any height of a place may be seen.
    bool may_see(const glm::dvec3& u) const {
      const glm::dvec3 centre =
          geo::ecef_from_normal(view.ellipsoid, u, 0.5 * (view.lowest_m + view.highest_m));
      return frustum.sees(centre - view.eye, 0.5 * (view.highest_m - view.lowest_m)) &&
             horizon.sees(centre, 0.5 * (view.highest_m - view.lowest_m), view.highest_m);
    }

    ViewOfLines(const ViewOfLines&) = delete;
    ViewOfLines& operator=(const ViewOfLines&) = delete;
    ~ViewOfLines() = default;

    clipmap::Frustum frustum;
    clipmap::Horizon horizon;
    LineView view;
  };

  void draw_lines(const render::EffectView& view, const ShapeLayer& look, const Range& range) {
    if (range.count == 0) return;
    array_.set_vertices(0, instances_, 0, sizeof(Arc), 1);
    array_.bind();
    program_.use();
    const auto draw = [&](const glm::vec3& color, float opacity, double wider_px) {
      program_.set(0, glm::vec4(color, opacity));
      program_.set(1, glm::vec4(glm::dvec4(2.0 * view.camera.tan_y() / view.target.height(), wider_px,
                                           view.target.width(), view.target.height())));
      glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 14, range.count, range.first);
    };
    if (look.halo_px > 0.0) {
      // What pieces share of it is dark once: the darkest of each pixel first, in its alpha, then all at
      // once.
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
      glBlendEquation(GL_MIN);
      draw(glm::vec3(0.0f), -kHaloOpacity, look.halo_px);
      glBlendEquation(GL_FUNC_ADD);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
      glBlendFunc(GL_ZERO, GL_DST_ALPHA);
      glDisable(GL_CULL_FACE);
      halo_program_.use();
      glDrawArrays(GL_TRIANGLES, 0, 3);
      glEnable(GL_CULL_FACE);
      glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
      view.target.clear_color(0.0f, 0.0f, 0.0f, 1.0f);
      glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
      glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
      program_.use();
    }
    draw(look.color, 1.0f, 0.0);
  }

  void draw_points(const render::EffectView& view, const ShapeLayer& look, const Range& range) {
    if (range.count == 0) return;
    point_array_.set_vertices(0, point_instances_, 0, sizeof(glm::vec4), 1);
    point_array_.bind();
    point_program_.use();
    point_program_.set(0, glm::vec4(look.color, kHaloOpacity));
    point_program_.set(1,
                       glm::vec4(glm::dvec4(look.halo_px, view.target.width(), view.target.height(), 0.0)));
    glDisable(GL_CULL_FACE);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, range.count, range.first);
    glEnable(GL_CULL_FACE);
  }

  template <class T>
  static void upload(const std::vector<T>& values, gl::Buffer& buffer) {
    const std::size_t bytes = values.size() * sizeof(T);
    if (bytes > buffer.size()) buffer = gl::Buffer(bytes + bytes / 2);
    if (bytes > 0) buffer.upload(0, values.data(), bytes);
  }

  void find_arcs(const render::EffectView& view) {
    arcs_.clear();
    ranges_.clear();
    points_.clear();
    point_ranges_.clear();
    const ViewOfLines lines(view, heights_, error_px_);
    for (const Layer& layer : layers_) {
      const std::size_t first = arcs_.size(), first_point = points_.size();
      for (const ShapeLine& line : layer.lines) line.add_arcs(lines.view, arcs_);
      for (const glm::dvec3& u : layer.points) {
        if (!lines.may_see(u)) continue;
        const glm::dvec3 low = geo::surface_point(lines.view.ellipsoid, u) - lines.view.eye;
        const double distance = std::max(glm::length(low + u * lines.view.ground_m), lines.view.above_m);
        const double h = view.surface.drawn_height(ground_height(view, u, distance));
        const glm::dvec3 at = low + u * h;
        if (glm::dot(at, view.camera.forward) > 0.0)
          points_.emplace_back(glm::vec4(glm::dvec4(at, layer.look.point_px)));
      }
      ranges_.push_back({static_cast<GLuint>(first), static_cast<GLsizei>(arcs_.size() - first)});
      point_ranges_.push_back(
          {static_cast<GLuint>(first_point), static_cast<GLsizei>(points_.size() - first_point)});
    }
    upload(arcs_, instances_);
    upload(points_, point_instances_);
  }

  void make_tables() {
    std::vector<glm::uvec2> words;
    for (Filled& filled : filled_) {
      filled.words.x = static_cast<int>(words.size());
      words.insert(words.end(), filled.cells.cells().begin(), filled.cells.cells().end());
      filled.words.y = static_cast<int>(words.size());
      const std::vector<glm::dvec4>& edges = filled.cells.edges();
      words.resize(words.size() + 4 * edges.size());
      if (!edges.empty())
        std::memcpy(words.data() + filled.words.y, edges.data(), edges.size() * sizeof(glm::dvec4));
    }
    tables_ = gl::Buffer::of(words);
  }

  double error_px_;
  glm::dvec2 heights_;  ///< lowest and highest ground, as drawn
  std::vector<Layer> layers_;
  std::vector<Filled> filled_;
  std::vector<Arc> arcs_;                     ///< of the view being drawn
  std::vector<glm::vec4> points_;             ///< as shaders/effects/shapes_point.vert takes them
  std::vector<Range> ranges_, point_ranges_;  ///< of the layers
  gl::Program program_, point_program_, halo_program_;
  gl::VertexArray array_, point_array_;
  gl::Buffer instances_, point_instances_, tables_;
  UniformBlock<ShapesBlock> block_;
};

}  // namespace

EffectEntry shapes() { return entry_of<ShapesParameters, Shapes, read_shapes>("shapes"); }

}  // namespace globe::effects
