#include "tests/bench/submission/upload_ways.h"

#include <epoxy/gl.h>

#include <cstring>

#include "globe/gl/sync.h"
#include "globe/gl/texture.h"

namespace bench {
namespace {

using globe::clipmap::LevelUpdate;
using globe::clipmap::NodeRect;
using globe::clipmap::Settings;
using globe::gl::Texture;

/// Calls send(texture, rectangle, texels, bytes) for all that an update brings.
struct Windows {
  explicit Windows(const Settings& settings)
      : positions(Texture::array(GL_RGBA32F, settings.window(), settings.window(), 4)),
        coarse(Texture::array(GL_RGBA32F, settings.window(), settings.window(), 4)),
        lit(Texture::array(GL_RGBA8, settings.shading_window(), settings.shading_window(), 4)),
        water(Texture::array(GL_R8, settings.shading_window(), settings.shading_window(), 4)) {}

  template <class Send>
  void for_each(const LevelUpdate& update, const Send& send) {
    const auto all = [&](Texture& texture, int d, const NodeRect& nodes, const auto& texels) {
      send(texture, globe::gl::TexelBox{nodes.i0, nodes.j0, nodes.width(), nodes.height(), d, 0},
           texels.data(), texels.size() * sizeof(texels[0]));
    };
    for (const auto& block : update.vertex_blocks) {
      all(positions, block.d, block.nodes, block.position);
      all(coarse, block.d, block.nodes, block.coarse);
    }
    for (const auto& block : update.shading_blocks) {
      all(lit, block.d, block.nodes, block.lit);
      all(water, block.d, block.nodes, block.water);
    }
  }

  std::vector<std::uint8_t> read() const {
    std::vector<std::uint8_t> bytes;
    for (const Texture* texture : {&positions, &coarse, &lit, &water}) {
      for (int layer = 0; layer < 4; ++layer) {
        const auto part = texture->read<std::uint8_t>({0, 0, texture->width(), texture->height(), layer, 0});
        bytes.insert(bytes.end(), part.begin(), part.end());
      }
    }
    return bytes;
  }

  Texture positions, coarse, lit, water;
};

struct Direct {
  Windows windows;
  std::shared_ptr<const LevelUpdate> update;

  void operator()() {
    windows.for_each(*update, [](Texture& texture, const auto& box, const void* texels, std::size_t) {
      texture.upload_wrapped(box, texels);
    });
  }
};

/// One buffer object, given new storage for each block so that nothing waits for its last use.
struct PixelBuffer {
  PixelBuffer(const Settings& settings, std::shared_ptr<const LevelUpdate> of)
      : windows(settings), update(std::move(of)) {
    glCreateBuffers(1, &buffer);
  }
  PixelBuffer(const PixelBuffer&) = delete;
  PixelBuffer& operator=(const PixelBuffer&) = delete;
  ~PixelBuffer() { glDeleteBuffers(1, &buffer); }

  void operator()() {
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    windows.for_each(*update, [&](Texture& texture, const auto& box, const void* texels, std::size_t bytes) {
      glNamedBufferData(buffer, static_cast<GLsizeiptr>(bytes), texels, GL_STREAM_DRAW);
      texture.upload_wrapped(box, nullptr);
    });
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  }

  Windows windows;
  std::shared_ptr<const LevelUpdate> update;
  GLuint buffer = 0;
};

/// A ring of three parts, mapped once; a part is written again when a fence says that it was read.
struct Mapped {
  static constexpr std::size_t kPart = std::size_t{16} << 20;

  Mapped(const Settings& settings, std::shared_ptr<const LevelUpdate> of)
      : windows(settings), update(std::move(of)) {
    constexpr GLbitfield kAccess = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    glCreateBuffers(1, &buffer);
    glNamedBufferStorage(buffer, 3 * kPart, nullptr, kAccess);
    memory = static_cast<std::byte*>(glMapNamedBufferRange(buffer, 0, 3 * kPart, kAccess));
  }
  Mapped(const Mapped&) = delete;
  Mapped& operator=(const Mapped&) = delete;
  ~Mapped() { glDeleteBuffers(1, &buffer); }

  void operator()() {
    part = (part + 1) % 3;
    if (used[part]) fence[part].wait();
    std::size_t at = part * kPart;
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer);
    windows.for_each(*update, [&](Texture& texture, const auto& box, const void* texels, std::size_t bytes) {
      std::memcpy(memory + at, texels, bytes);
      // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset into the bound buffer
      texture.upload_wrapped(box, reinterpret_cast<const void*>(at));
      at += (bytes + 255) / 256 * 256;
    });
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    fence[part] = globe::gl::Sync::create();
    used[part] = true;
  }

  Windows windows;
  std::shared_ptr<const LevelUpdate> update;
  GLuint buffer = 0;
  std::byte* memory = nullptr;
  std::size_t part = 0;
  std::array<globe::gl::Sync, 3> fence;
  std::array<bool, 3> used{};
};

template <class Way>
UploadWay way_of(const std::string& name, const std::shared_ptr<Way>& way) {
  return {name, [way] { (*way)(); }, [way] { return way->windows.read(); }};
}

}  // namespace

std::vector<UploadWay> upload_ways(const Settings& settings, std::shared_ptr<const LevelUpdate> update) {
  return {way_of("from memory", std::make_shared<Direct>(Direct{Windows(settings), update})),
          way_of("pixel buffer", std::make_shared<PixelBuffer>(settings, update)),
          way_of("persistently mapped", std::make_shared<Mapped>(settings, update))};
}

}  // namespace bench
