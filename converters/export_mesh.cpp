#include "converters/export_mesh.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include "converters/local_mesh.h"
#include "converters/map_sampler.h"
#include "converters/srgb.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/planet/grid.h"

namespace converters {
namespace {

using globe::planet::Surface;
using SurfacePointer = std::shared_ptr<const Surface>;
using Bytes = std::vector<unsigned char>;

constexpr int kMaxPicture = 4096;  ///< pixels a side

/// The planet's colors over the mesh's map.
Bytes picture_of(const SurfacePointer& surface, MapWindow window, const ExportOptions& options) {
  const int level = default_level(*surface, MapContent::kColors, options.extent);
  const double pixels_a_degree = globe::planet::nodes_per_side(level) / 90.0;
  const auto side = [&](double degrees) {
    return static_cast<int>(std::clamp(std::ceil(degrees * pixels_a_degree), 1.0, double(kMaxPicture)));
  };
  window.width = options.size ? options.size->width : side(window.step_x_deg);
  window.height = options.size ? options.size->height : side(window.step_y_deg);
  window.step_x_deg /= window.width;
  window.step_y_deg /= window.height;
  const auto values = node_colors(surface, area_level(window, level));
  const MapSampler sampler(*values, Sampling::kArea, window);
  std::vector<float> pixels(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height) *
                            3);
  sampler.sample(0, 0, window.width, window.height, pixels.data());
  Bytes srgb(pixels.size());
  std::transform(pixels.begin(), pixels.end(), srgb.begin(), srgb_byte_from_linear);

  Bytes png;
  OIIO::Filesystem::IOVecOutput memory(png);
  const auto output = OIIO::ImageOutput::create("picture.png");
  OIIO::ImageSpec spec(window.width, window.height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  if (!output || !output->set_ioproxy(&memory) || !output->open("picture.png", spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, srgb.data()) || !output->close()) {
    throw globe::Error(options.output.string(), "its picture cannot be compressed", "check the memory");
  }
  return png;
}

/// Appends an array to the file's one buffer; gives the number of its view.
template <typename T>
int add_view(tinygltf::Model& model, const T* first, std::size_t count, int target) {
  Bytes& data = model.buffers[0].data;
  data.resize((data.size() + 3) / 4 * 4);
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = data.size();
  view.byteLength = count * sizeof(T);
  view.target = target;
  const auto* bytes = reinterpret_cast<const unsigned char*>(first);
  data.insert(data.end(), bytes, bytes + view.byteLength);
  model.bufferViews.push_back(view);
  return static_cast<int>(model.bufferViews.size()) - 1;
}

template <typename T>
int add_array(tinygltf::Model& model, const std::vector<T>& values, int component, int type, int target) {
  tinygltf::Accessor accessor;
  accessor.bufferView = add_view(model, values.data(), values.size(), target);
  accessor.componentType = component;
  accessor.type = type;
  accessor.count = values.size();
  model.accessors.push_back(accessor);
  return static_cast<int>(model.accessors.size()) - 1;
}

tinygltf::Value text(const std::string& value) { return tinygltf::Value(value); }

void describe(const LocalMesh& mesh, const Surface& surface, tinygltf::Asset& asset) {
  asset.version = "2.0";
  asset.generator = "globe";
  tinygltf::Value::Array credits;
  for (const std::string& credit : surface.info().credits) credits.push_back(text(credit));
  asset.extras = tinygltf::Value(tinygltf::Value::Object{
      {"planet", text(surface.info().name)},
      {"level", tinygltf::Value(mesh.level)},
      {"origin_lat_deg", tinygltf::Value(mesh.origin.lat_deg)},
      {"origin_lon_deg", tinygltf::Value(mesh.origin.lon_deg)},
      {"origin_height_m", tinygltf::Value(mesh.origin.h_m)},
      {"frame", text("metres from the origin on the ellipsoid: x east, y up, z south")},
      {"ellipsoid_a_m", tinygltf::Value(surface.ellipsoid().a)},
      {"ellipsoid_f", tinygltf::Value(surface.ellipsoid().f)},
      {"vertical_datum", text(surface.info().vertical_datum)},
      {"credits", tinygltf::Value(credits)}});
}

tinygltf::Model model_of(const LocalMesh& mesh, const Surface& surface, const Bytes& picture) {
  tinygltf::Model model;
  describe(mesh, surface, model.asset);
  model.buffers.emplace_back();
  tinygltf::Primitive triangles;
  triangles.mode = TINYGLTF_MODE_TRIANGLES;
  triangles.attributes["POSITION"] = add_array(model, mesh.positions, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                               TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  glm::vec3 low = mesh.positions[0], high = low;
  for (const glm::vec3& position : mesh.positions) {
    low = {std::min(low.x, position.x), std::min(low.y, position.y), std::min(low.z, position.z)};
    high = {std::max(high.x, position.x), std::max(high.y, position.y), std::max(high.z, position.z)};
  }
  model.accessors.back().minValues.assign(&low.x, &low.x + 3);
  model.accessors.back().maxValues.assign(&high.x, &high.x + 3);
  triangles.attributes["NORMAL"] = add_array(model, mesh.normals, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                             TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
  triangles.indices = add_array(model, mesh.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  tinygltf::Material material;
  material.pbrMetallicRoughness.metallicFactor = 0.0;
  material.pbrMetallicRoughness.roughnessFactor = 1.0;
  if (!picture.empty()) {
    triangles.attributes["TEXCOORD_0"] = add_array(model, mesh.places, TINYGLTF_COMPONENT_TYPE_FLOAT,
                                                   TINYGLTF_TYPE_VEC2, TINYGLTF_TARGET_ARRAY_BUFFER);
    tinygltf::Image image;
    image.mimeType = "image/png";
    image.bufferView = add_view(model, picture.data(), picture.size(), 0);
    model.images.push_back(image);
    tinygltf::Sampler sampler;
    sampler.wrapS = sampler.wrapT = TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    model.samplers.push_back(sampler);
    tinygltf::Texture texture;
    texture.source = 0;
    texture.sampler = 0;
    model.textures.push_back(texture);
    material.pbrMetallicRoughness.baseColorTexture.index = 0;
  } else {
    material.pbrMetallicRoughness.baseColorFactor = {0.6, 0.6, 0.6, 1.0};
  }
  model.materials.push_back(material);
  triangles.material = 0;
  tinygltf::Mesh ground;
  ground.primitives.push_back(triangles);
  model.meshes.push_back(ground);
  tinygltf::Node node;
  node.mesh = 0;
  model.nodes.push_back(node);
  tinygltf::Scene scene;
  scene.nodes = {0};
  model.scenes.push_back(scene);
  model.defaultScene = 0;
  return model;
}

}  // namespace

void export_mesh(const SurfacePointer& surface, const ExportOptions& options,
                 const ConvertListener& listener) {
  if (!surface->has_heights())
    throw globe::Error(surface->info().name, "the planet has no heights",
                       "convert it again with a height map");
  globe::PendingFile file(options.output, options.overwrite);
  const LocalMesh mesh = make_local_mesh(*surface, options.extent, options.level);
  const bool colored = surface->has_colors() || !surface->has_data();
  const Bytes picture = colored ? picture_of(surface, mesh.map, options) : Bytes{};
  if (listener.note) {
    listener.note("mesh of " + surface->info().name + ": level " + std::to_string(mesh.level) + ", " +
                  std::to_string(mesh.positions.size()) + " vertices, " +
                  std::to_string(mesh.indices.size() / 3) + " triangles" + (colored ? ", in color" : ""));
  }
  const tinygltf::Model model = model_of(mesh, *surface, picture);
  std::ofstream stream(file.temporary(), std::ios::binary);
  const bool written = tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, stream, false, true);
  if (!written || !stream.flush()) {
    throw globe::Error(options.output.string(), "cannot be written (the disk did not take it all)",
                       "check the space left on the disk");
  }
  stream.close();
  file.publish();
}

}  // namespace converters
