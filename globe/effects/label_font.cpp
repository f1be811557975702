#include "globe/effects/label_font.h"

#include <ft2build.h>
#include <unistr.h>

#include <algorithm>
#include <cmath>

#include "globe/base/error.h"
#include FT_FREETYPE_H
#include FT_GLYPH_H
#include FT_STROKER_H

namespace globe::effects {
namespace {

constexpr FT_Int32 kLoad = FT_LOAD_TARGET_LIGHT | FT_LOAD_NO_BITMAP;
constexpr double kUnit = 64.0;  ///< FreeType's, of a pixel

int pixels(FT_Pos units) { return static_cast<int>((units + 32) >> 6); }

std::vector<FT_ULong> codes_of(const std::string& text) {
  std::vector<FT_ULong> codes;
  const auto* at = reinterpret_cast<const std::uint8_t*>(text.data());
  for (std::size_t left = text.size(); left > 0;) {
    ucs4_t code = 0;
    const int length = u8_mbtouc(&code, at, left);
    codes.push_back(code == 0xfffd ? '?' : code);
    at += length;
    left -= static_cast<std::size_t>(length);
  }
  return codes;
}

/// A glyph that is its own owner.
struct GlyphDeleter {
  void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
};
using Glyph = std::unique_ptr<FT_GlyphRec_, GlyphDeleter>;

}  // namespace

struct LabelFont::State {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  FT_Stroker stroker = nullptr;
  int around = 0;          ///< pixels for the halo on each side
  int up = 0, height = 0;  ///< of a line of text without them

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (stroker != nullptr) FT_Stroker_Done(stroker);
    if (face != nullptr) FT_Done_Face(face);
    if (library != nullptr) FT_Done_FreeType(library);
  }

  /// Calls `use` with each glyph's number and where it begins, pixels; gives the whole width.
  template <class Use>
  int for_each_glyph(const std::string& text, const Use& use) const {
    int pen = 0;
    FT_UInt before = 0;
    for (const FT_ULong code : codes_of(text)) {
      const FT_UInt glyph = FT_Get_Char_Index(face, code);
      FT_Vector kerning{0, 0};
      if (before != 0) FT_Get_Kerning(face, before, glyph, FT_KERNING_DEFAULT, &kerning);
      pen += pixels(kerning.x);
      if (FT_Load_Glyph(face, glyph, kLoad) != 0) continue;
      use(pen);
      pen += pixels(face->glyph->advance.x);
      before = glyph;
    }
    return pen;
  }

  /// Paints the glyph loaded last into one channel.
  void paint(bool halo, int x, TextPicture& picture) const {
    FT_Glyph made = nullptr;
    if (FT_Get_Glyph(face->glyph, &made) != 0) return;
    if (halo && FT_Glyph_Stroke(&made, stroker, 1) != 0) return FT_Done_Glyph(made);
    if (FT_Glyph_To_Bitmap(&made, FT_RENDER_MODE_NORMAL, nullptr, 1) != 0) return FT_Done_Glyph(made);
    const Glyph owner(made);
    const auto* bitmap = reinterpret_cast<FT_BitmapGlyph>(made);  // FT_Glyph_To_Bitmap makes it one
    for (int row = 0; row < static_cast<int>(bitmap->bitmap.rows); ++row) {
      const int to_row = around + up - bitmap->top + row;
      if (to_row < 0 || to_row >= picture.height) continue;
      for (int column = 0; column < static_cast<int>(bitmap->bitmap.width); ++column) {
        const int to = around + x + bitmap->left + column;
        if (to < 0 || to >= picture.width) continue;
        std::uint8_t& texel =
            picture.texels[2 * static_cast<std::size_t>(to_row * picture.width + to) + (halo ? 1u : 0u)];
        texel = std::max(texel, bitmap->bitmap.buffer[row * bitmap->bitmap.pitch + column]);
      }
    }
  }
};

LabelFont::LabelFont(const std::filesystem::path& file, double size_px, double halo_px)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  if (FT_Init_FreeType(&s.library) != 0)
    throw Error("FreeType", "it does not start", "check the installation");
  if (FT_New_Face(s.library, file.c_str(), 0, &s.face) != 0 ||
      FT_Set_Char_Size(s.face, 0, static_cast<FT_F26Dot6>(std::lround(size_px * kUnit)), 72, 72) != 0)
    throw Error(
        file.string(), "it is no font that can be read",
        file == kUsualFont ? "install the package fonts-dejavu-core" : "give a TrueType or OpenType font");
  if (FT_Stroker_New(s.library, &s.stroker) != 0)
    throw Error("FreeType", "it draws no outlines", "check the installation");
  FT_Stroker_Set(s.stroker, static_cast<FT_Fixed>(std::lround(halo_px * kUnit)), FT_STROKER_LINECAP_ROUND,
                 FT_STROKER_LINEJOIN_ROUND, 0);
  s.around = static_cast<int>(std::ceil(halo_px)) + 1;
  s.up = pixels(s.face->size->metrics.ascender);
  s.height = s.up - pixels(s.face->size->metrics.descender);
}

LabelFont::LabelFont(LabelFont&& other) noexcept = default;
LabelFont::~LabelFont() = default;

glm::ivec2 LabelFont::size_of(const std::string& text) const {
  const int width = state_->for_each_glyph(text, [](int) {});
  return {std::max(width, 0) + 2 * state_->around, state_->height + 2 * state_->around};
}

TextPicture LabelFont::draw(const std::string& text) const {
  const glm::ivec2 size = size_of(text);
  TextPicture picture{size.x, size.y, {}};
  picture.texels.resize(2 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  state_->for_each_glyph(text, [&](int x) {
    state_->paint(true, x, picture);
    state_->paint(false, x, picture);
  });
  // The halo is drawn as an outline: thick letters are open inside.
  for (std::size_t k = 0; k < picture.texels.size(); k += 2)
    picture.texels[k + 1] = std::max(picture.texels[k], picture.texels[k + 1]);
  return picture;
}

}  // namespace globe::effects
