#include "converters/local_mesh.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>

#include "converters/export_mesh.h"
#include "globe/base/error.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace converters {
namespace {

using globe::geo::dvec3;
using globe::geo::Geodetic;
using globe::planet::Surface;

std::shared_ptr<const Surface> rough_planet(const std::filesystem::path& folder, int level) {
  tests::write_node_planet(folder, level, globe::geo::kWgs84, tests::hashed_heights(5, -100.0, 4000.0));
  return tests::open_surface(folder);
}

/// ECEF metres of a place in the mesh's frame.
dvec3 ecef_of(const Surface& surface, const LocalMesh& mesh, const glm::vec3& position) {
  const auto frame = globe::geo::local_frame(mesh.origin.lat_deg, mesh.origin.lon_deg);
  return globe::geo::ecef_from_geodetic(surface.ellipsoid(), mesh.origin) +
         static_cast<double>(position.x) * frame.east + static_cast<double>(position.y) * frame.up -
         static_cast<double>(position.z) * frame.north;
}

/// How often each edge is used, by its ends.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges_of(const LocalMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    for (std::size_t c = 0; c < 3; ++c)
      ++edges[std::minmax(mesh.indices[k + c], mesh.indices[k + (c + 1) % 3])];
  }
  return edges;
}

class LocalMeshTest : public testing::TestWithParam<Extent> {
 protected:
  tests::TemporaryFolder folder_;
  std::shared_ptr<const Surface> planet_ = rough_planet(folder_ / "planet", 7);
};

TEST_P(LocalMeshTest, IsOneClosedPatchOfTheGround) {
  const LocalMesh mesh = make_local_mesh(*planet_, GetParam(), std::nullopt);
  EXPECT_EQ(mesh.level, 7);
  const auto edges = edges_of(mesh);
  for (const auto& [ends, uses] : edges) ASSERT_LE(uses, 2);
  const auto vertices = static_cast<long>(mesh.positions.size());
  EXPECT_EQ(vertices - static_cast<long>(edges.size()) + static_cast<long>(mesh.indices.size() / 3), 1)
      << "one piece without holes";
  double worst_m = 0;
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const dvec3 ecef = ecef_of(*planet_, mesh, mesh.positions[k]);
    const Geodetic at = globe::geo::geodetic_from_ecef(planet_->ellipsoid(), ecef);
    const dvec3 u = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    worst_m = std::max(worst_m, std::abs(at.h_m - planet_->height(u, 7)));
    // On the map: west to east, north to south.
    const glm::vec2 place = mesh.places[k];
    ASSERT_TRUE(place.x >= 0.0F && place.x <= 1.0F && place.y >= 0.0F && place.y <= 1.0F);
    ASSERT_NEAR(mesh.map.north_deg - static_cast<double>(place.y) * mesh.map.step_y_deg, at.lat_deg, 1e-4);
    if (std::abs(at.lat_deg) < 89.9999) {
      const double east = mesh.map.west_deg + static_cast<double>(place.x) * mesh.map.step_x_deg - at.lon_deg;
      ASSERT_NEAR(east - 360.0 * std::round(east / 360.0), 0.0, 1e-4 / std::cos(at.lat_deg * 0.01745));
    }
  }
  EXPECT_LT(worst_m, 3.0) << "floats some 2000 km from the origin, on slopes";
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    const auto corner = [&](std::size_t c) { return dvec3(mesh.positions[mesh.indices[k + c]]); };
    const dvec3 up = ecef_of(*planet_, mesh, mesh.positions[mesh.indices[k]]);
    const auto frame = globe::geo::local_frame(mesh.origin.lat_deg, mesh.origin.lon_deg);
    const dvec3 here{glm::dot(up, frame.east), glm::dot(up, frame.up), -glm::dot(up, frame.north)};
    const dvec3 face = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
    ASSERT_GT(glm::dot(face, here), 0.0) << "counter-clockwise from above";
    ASSERT_GT(glm::dot(dvec3(mesh.normals[mesh.indices[k]]), here), 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Regions, LocalMeshTest,
                         testing::Values(Extent{5, 43, 17, 49}, Extent{170, -20, 195, 10},
                                         Extent{-5, -5, 5, 5}, Extent{80, 20, 100, 60},
                                         Extent{10, 70, 100, 90}),
                         [](const auto& region) { return std::to_string(region.index); });

TEST(LocalMesh, RefusesWhatIsTooLargeOrEmpty) {
  const tests::TemporaryFolder folder;
  const auto planet = rough_planet(folder / "planet", 4);
  EXPECT_THROW(make_local_mesh(*planet, {0, 0, 100, 10}, std::nullopt), globe::UsageError);
  EXPECT_THROW(make_local_mesh(*planet, {0, 0, 80, 60}, 14), globe::UsageError);
  EXPECT_THROW(make_local_mesh(*planet, {0.1, 0.1, 0.2, 0.2}, std::nullopt), globe::Error);
  EXPECT_GT(make_local_mesh(*planet, {0.1, 0.1, 0.2, 0.2}, 14).indices.size(), 100U);
}

TEST(ExportMesh, WritesAFileThatOthersRead) {
  const tests::TemporaryFolder folder;
  ExportOptions options;
  options.output = folder / "mesh.glb";
  options.extent = {10, 10, 14, 13};
  options.level = 9;
  options.size = {32, 24};
  std::string bytes;
  for (int run = 0; run < 2; ++run) {
    export_mesh(Surface::builtin(2), options, {});
    std::ifstream stream(options.output, std::ios::binary);
    const std::string now{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(run == 0 || now == bytes);
    bytes = now;
    options.overwrite = true;
  }
  tinygltf::Model model;
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(
      [](tinygltf::Image*, const int, std::string*, std::string*, int, int, const unsigned char* data,
         int size, void*) { return size > 8 && std::memcmp(data, "\x89PNG", 4) == 0; },
      nullptr);
  std::string error, warning;
  ASSERT_TRUE(reader.LoadBinaryFromFile(&model, &error, &warning, options.output.string())) << error;
  const LocalMesh mesh = make_local_mesh(*Surface::builtin(2), options.extent, options.level);
  const tinygltf::Primitive& triangles = model.meshes.at(0).primitives.at(0);
  EXPECT_EQ(model.accessors.at(static_cast<std::size_t>(triangles.indices)).count, mesh.indices.size());
  for (const char* attribute : {"POSITION", "NORMAL", "TEXCOORD_0"}) {
    EXPECT_EQ(model.accessors.at(static_cast<std::size_t>(triangles.attributes.at(attribute))).count,
              mesh.positions.size());
  }
  const tinygltf::BufferView& positions = model.bufferViews.at(static_cast<std::size_t>(
      model.accessors.at(static_cast<std::size_t>(triangles.attributes.at("POSITION"))).bufferView));
  EXPECT_EQ(std::memcmp(model.buffers.at(0).data.data() + positions.byteOffset, mesh.positions.data(),
                        positions.byteLength),
            0);
  EXPECT_EQ(model.asset.extras.Get("origin_lat_deg").GetNumberAsDouble(), 11.5);
  EXPECT_EQ(model.asset.extras.Get("level").GetNumberAsInt(), 9);
}

}  // namespace
}  // namespace converters
