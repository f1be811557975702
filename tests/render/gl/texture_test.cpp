#include "globe/gl/texture.h"

#include <cstdint>
#include <random>

#include "tests/render/gl_fixture.h"

namespace globe::gl {
namespace {

class TextureGlTest : public GlTest {};

struct FormatRow {
  const char* name;
  GLenum format;
  std::size_t bytes;
};

constexpr FormatRow kFormats[] = {
    {"R8", GL_R8, 1},
    {"RG8", GL_RG8, 2},
    {"RGBA8", GL_RGBA8, 4},
    {"SRGB8_ALPHA8", GL_SRGB8_ALPHA8, 4},
    {"R16", GL_R16, 2},
    {"RG16", GL_RG16, 4},
    {"RGBA16", GL_RGBA16, 8},
    {"R32F", GL_R32F, 4},
    {"RG32F", GL_RG32F, 8},
    {"RGB32F", GL_RGB32F, 12},
    {"RGBA32F", GL_RGBA32F, 16},
    {"R32I", GL_R32I, 4},
    {"R32UI", GL_R32UI, 4},
    {"R16UI", GL_R16UI, 2},
    {"R8UI", GL_R8UI, 1},
};

/// Bytes that are the same when read as floats: no NaN payload that a driver may change.
std::vector<std::uint8_t> noise(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::uint8_t> bytes(count);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(random() % 0x70);
  return bytes;
}

TEST_F(TextureGlTest, EveryFormatReadsBackWhatWasUploaded) {
  for (const FormatRow& row : kFormats) {
    SCOPED_TRACE(row.name);
    ASSERT_EQ(pixel_layout(row.format).bytes_per_texel, row.bytes);
    Texture texture = Texture::flat(row.format, 5, 3);
    EXPECT_EQ(texture.bytes(), 15 * row.bytes);
    const auto data = noise(15 * row.bytes, 1);
    texture.upload({0, 0, 5, 3}, data.data());
    EXPECT_EQ(texture.read<std::uint8_t>({0, 0, 5, 3}), data);
  }
}

TEST_F(TextureGlTest, SubImageTakesItsRowLengthFromTheCaller) {
  Texture texture = Texture::flat(GL_R32F, 4, 4);
  texture.upload({0, 0, 4, 4}, std::vector<float>(16, -1.0f).data());
  const std::vector<float> wide = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};  // rows of five
  texture.upload({1, 2, 2, 2}, wide.data(), 5);
  EXPECT_EQ(texture.read<float>({0, 0, 4, 4}),
            (std::vector<float>{-1, -1, -1, -1, -1, -1, -1, -1, -1, 0, 1, -1, -1, 5, 6, -1}));
}

TEST_F(TextureGlTest, LevelsAndLayersAreKeptApart) {
  Texture texture = Texture::array(GL_R8, 4, 4, 3, 2);
  for (int layer = 0; layer < 3; ++layer) {
    for (int level = 0; level < 2; ++level) {
      const std::vector<std::uint8_t> data(16, static_cast<std::uint8_t>(10 * layer + level));
      texture.upload({0, 0, 4 >> level, 4 >> level, layer, level}, data.data());
    }
  }
  for (int layer = 0; layer < 3; ++layer) {
    for (int level = 0; level < 2; ++level) {
      const auto seen = texture.read<std::uint8_t>({0, 0, 4 >> level, 4 >> level, layer, level});
      EXPECT_EQ(seen, std::vector<std::uint8_t>(seen.size(), static_cast<std::uint8_t>(10 * layer + level)));
    }
  }
}

int modulo(int x, int n) { return ((x % n) + n) % n; }

TEST_F(TextureGlTest, WrappedUploadPutsEachTexelAtItsToroidalAddress) {
  constexpr int kWidth = 7, kHeight = 5;
  std::mt19937 random(20090327);
  Texture texture = Texture::array(GL_R32F, kWidth, kHeight, 2);
  std::vector<float> expected(kWidth * kHeight, 0.0f);
  texture.upload({0, 0, kWidth, kHeight, 1}, expected.data());
  texture.upload({0, 0, kWidth, kHeight, 0}, expected.data());
  for (int round = 0; round < 300; ++round) {
    TexelBox box;
    box.x = static_cast<int>(random() % 41) - 20;
    box.y = static_cast<int>(random() % 41) - 20;
    box.width = 1 + static_cast<int>(random() % kWidth);
    box.height = 1 + static_cast<int>(random() % kHeight);
    box.layer = 1;
    const int row_length = box.width + static_cast<int>(random() % 3);
    std::vector<float> data(static_cast<std::size_t>(row_length) * static_cast<std::size_t>(box.height));
    for (float& value : data) value = static_cast<float>(random() % 100000);
    texture.upload_wrapped(box, data.data(), row_length);
    for (int j = 0; j < box.height; ++j) {
      for (int i = 0; i < box.width; ++i) {
        const int at = modulo(box.y + j, kHeight) * kWidth + modulo(box.x + i, kWidth);
        const int from = j * row_length + i;
        expected[static_cast<std::size_t>(at)] = data[static_cast<std::size_t>(from)];
      }
    }
    ASSERT_EQ(texture.read<float>({0, 0, kWidth, kHeight, 1}), expected) << "round " << round;
  }
  EXPECT_EQ(texture.read<float>({0, 0, kWidth, kHeight, 0}), std::vector<float>(kWidth * kHeight, 0.0f));
}

TEST_F(TextureGlTest, WrappedCopyTakesTheSameTexelsOfAnotherLayer) {
  constexpr int kWidth = 7, kHeight = 5;
  std::mt19937 random(20090328);
  Texture from = Texture::array(GL_RG32F, kWidth, kHeight, 3);
  Texture to = Texture::array(GL_RG32F, kWidth, kHeight, 4);
  const TexelBox whole{0, 0, kWidth, kHeight, 1};
  const auto source = noise(kWidth * kHeight * 8, 1);
  auto expected = noise(kWidth * kHeight * 8, 2);
  from.upload({0, 0, kWidth, kHeight, 2}, source.data());
  to.upload(whole, expected.data());
  for (int round = 0; round < 100; ++round) {
    const TexelBox box{static_cast<int>(random() % 41) - 20,
                       static_cast<int>(random() % 41) - 20,
                       1 + static_cast<int>(random() % kWidth),
                       1 + static_cast<int>(random() % kHeight),
                       1,
                       0};
    to.upload(whole, expected.data());
    to.copy_wrapped(from, 2, box);
    auto seen = expected;
    for (int j = box.y; j < box.y + box.height; ++j) {
      for (int i = box.x; i < box.x + box.width; ++i) {
        const auto texel = static_cast<std::ptrdiff_t>(8 * (modulo(j, kHeight) * kWidth + modulo(i, kWidth)));
        std::copy_n(source.begin() + texel, 8, seen.begin() + texel);
      }
    }
    ASSERT_EQ(to.read<std::uint8_t>(whole), seen) << "round " << round;
  }
}

TEST_F(TextureGlTest, MipmapsAverage) {
  Texture texture = Texture::flat(GL_R32F, 2, 2, 2);
  const std::vector<float> data = {1, 2, 3, 6};
  texture.upload({0, 0, 2, 2}, data.data());
  texture.generate_mipmaps();
  EXPECT_FLOAT_EQ(texture.read<float>({0, 0, 1, 1, 0, 1})[0], 3.0f);
}

}  // namespace
}  // namespace globe::gl
