#include <cstddef>
#include <cstdint>
#include <string>

#include "app/parse_options.h"
#include "app/view_options.h"
#include "globe/base/error.h"
#include "globe/geo/sun.h"

namespace {

template <typename Parse>
void try_to(const Parse& parse) {
  try {
    parse();
  } catch (const globe::Error&) {
  }
}

}  // namespace

/// Every option that is more than a number or a word: refused or taken, never worse.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try_to([&] { app::parse_look(text); });
  try_to([&] { app::parse_size(text); });
  try_to([&] {
    app::ViewOptions options;
    options.background = text;
    app::render_settings(options);
  });
  try_to([&] { globe::geo::sun_direction(text); });
  try_to([&] { app::parse_ellipsoid(text); });
  try_to([&] { app::parse_extent(text); });
  return 0;
}
