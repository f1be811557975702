#include "globe/effects/cloud_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "globe/geo/ellipsoid.h"

namespace globe::effects {
namespace {

constexpr int kSide = 64;

/// Share of the sphere where a cover is above a value.
double share_above(const CloudCover& cover, float value) {
  double above = 0.0, all = 0.0;
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < cover.side; ++row) {
      for (int column = 0; column < cover.side; ++column) {
        const glm::dvec3 d = cube_direction(face, column, row, cover.side);
        const double area = std::pow(glm::dot(d, d), -1.5);
        all += area;
        if (cover.at(face, column, row) > value) above += area;
      }
    }
  }
  return above / all;
}

TEST(CloudMap, FacesAgreeOnTheirBorders) {
  const CloudCover cover = made_up_cover(7, kSide);
  for (int face = 0; face < 6; ++face) {
    for (int k = 0; k < kSide; ++k) {
      for (const auto& [column, row] :
           {std::pair(0, k), std::pair(kSide - 1, k), std::pair(k, 0), std::pair(k, kSide - 1)}) {
        const glm::dvec3 inside = cube_direction(face, column, row, kSide);
        // A little over the edge, on the face beside.
        const int axis = face / 2;
        glm::dvec3 beside = inside;
        beside[axis] *= 1.0 - 1e-9;
        EXPECT_NEAR(cover.at(beside), cover.at(face, column, row), 1e-4)
            << face << ' ' << column << ' ' << row;
      }
    }
  }
}

TEST(CloudMap, AnyShareOfTheSphereIsCoveredAsAskedFor) {
  const CloudCover cover = made_up_cover(3, kSide);
  for (const float share : {0.1f, 0.5f, 0.8f}) EXPECT_NEAR(share_above(cover, 1.0f - share), share, 0.005);
}

TEST(CloudMap, OtherSeedsMakeOtherWeather) {
  EXPECT_EQ(made_up_cover(3, 16).values, made_up_cover(3, 16).values);
  EXPECT_NE(made_up_cover(3, 16).values, made_up_cover(4, 16).values);
}

TEST(CloudMap, GradientsAreThoseOfTheSphere) {
  // Along an axis, half the way from 0 to 1: the gradient of 0.5 + 0.5 axis.d is half the part of the axis
  // that is level.
  const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, -2.0, 0.5));
  CloudCover cover{kSide, std::vector<float>(6 * kSide * kSide)};
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < kSide; ++row) {
      for (int column = 0; column < kSide; ++column)
        cover.at(face, column, row) = static_cast<float>(
            0.5 + 0.5 * glm::dot(axis, glm::normalize(cube_direction(face, column, row, kSide))));
    }
  }
  const auto levels = cloud_texels(cover);
  ASSERT_EQ(levels.size(), 6u);  // 64, 32, ... 2
  const std::vector<std::uint8_t>& texels = levels.front();
  constexpr double kStep = 128.0 * 2.0 / 255.0;  // of eight bits
  for (int face = 0; face < 6; ++face) {
    for (int row = 1; row < kSide; row += 9) {
      for (int column = 1; column < kSide; column += 7) {
        const glm::dvec3 d = glm::normalize(cube_direction(face, column, row, kSide));
        const glm::dvec3 expected = 0.5 * (axis - d * glm::dot(d, axis));
        const std::uint8_t* texel = texels.data() + 4 * ((face * kSide + row) * kSide + column);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR((texel[c + 1] / 255.0 - 0.5) * 256.0, expected[c], kStep)
              << face << ' ' << column << ' ' << row;
      }
    }
  }
}

TEST(CloudMap, ACityOfAPictureLiesWhereItsPixelDoes) {
  LatLongImage image{360, 180, 1, std::vector<std::uint8_t>(360 * 180, 0)};
  image.pixels[static_cast<std::size_t>(90 - 48) * 360 + 180 + 11] = 255;  // 47.5 N, 11.5 E
  EXPECT_NEAR(image.at(47.5, 11.5)[0], 255.0, 1e-3);
  EXPECT_NEAR(image.at(47.5, 12.0)[1], 127.5, 1e-3);
  EXPECT_NEAR(image.at(47.5, 13.0)[2], 0.0, 1e-3);
  const CloudCover cover = cover_of(image, 512);
  EXPECT_GT(cover.at(geo::normal_from_degrees(47.5, 11.5)), 0.8f);
  EXPECT_LT(cover.at(geo::normal_from_degrees(49.0, 11.5)), 0.01f);
}

TEST(LatLongImage, GoesAroundTheDateLine) {
  LatLongImage image{4, 2, 1, {10, 0, 0, 30, 10, 0, 0, 30}};
  EXPECT_NEAR(image.at(0.0, 180.0)[0], 20.0, 1e-4);
  EXPECT_NEAR(image.at(0.0, -180.0)[0], 20.0, 1e-4);
  EXPECT_NEAR(image.at(90.0, -135.0)[0], 10.0, 1e-4);
}

TEST(CloudDetail, IsOfMeanZeroSoThatFarAwayItMakesNoDifference) {
  constexpr int kTexels = 128;
  const std::vector<std::uint8_t> texels = cloud_detail(1, kTexels);
  double sum = 0.0;
  for (std::size_t k = 0; k < texels.size(); k += 4) sum += texels[k] / 255.0 - 0.5;
  EXPECT_NEAR(sum / (kTexels * kTexels), 0.0, 0.005);
}

}  // namespace
}  // namespace globe::effects
