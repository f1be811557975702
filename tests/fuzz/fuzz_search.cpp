#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/search/feature_index.h"
#include "globe/search/index_writer.h"
#include "tests/fuzz/scratch_file.h"

namespace {

/// A database with a bit of everything, to begin from.
std::string database() {
  const fuzz::ScratchFile file("seed.db");
  globe::search::IndexWriter writer(file.path(), globe::geo::kWgs84, true);
  for (int k = 0; k < 40; ++k) {
    globe::search::NewFeature feature;
    feature.geometry.points.push_back({2.0 * k - 40.0, 9.0 * k, 0.0});
    if (k % 4 == 0) feature.geometry.lines.push_back({{0, 0, 0}, {1.0 + k, 1, 0}});
    feature.name = "name " + std::to_string(k);
    feature.properties = "{\"k\":" + std::to_string(k) + "}";
    writer.add(std::move(feature));
  }
  writer.finish();
  std::ifstream stream(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

/// A damaged database is refused, or answers places on the planet. The bytes are changes to a good one, three
/// each: where (two) and what; the first tells how much is cut off its end.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string good = database();
  static const fuzz::ScratchFile file("fuzz.db");
  if (size < 1) return 0;
  std::string bytes = good.substr(0, good.size() - (data[0] < 250 ? 0 : 1000 * (data[0] - 249U)));
  for (std::size_t k = 1; k + 2 < size; k += 3) {
    const std::size_t at = (data[k] * 256U + data[k + 1]) % bytes.size();
    bytes[at] = static_cast<char>(data[k + 2]);
  }
  file.write(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  try {
    globe::search::FeatureIndex index(file.path());
    std::vector<globe::search::Query> queries(4);
    queries[1].near = globe::geo::Geodetic{0.5, 0.5, 0};
    queries[1].radius_m = 3e6;
    queries[2].near = queries[1].near;
    queries[2].count = 3;
    queries[3].name_prefix = "name 1";
    queries[3].properties.emplace_back("k", "12");
    for (const globe::search::Query& query : queries) {
      for (const globe::search::Hit& hit : index.find(query)) {
        if (!(std::abs(hit.lat_deg) <= 90.0) || !(std::abs(hit.lon_deg) <= 180.0)) std::abort();
        static_cast<void>(index.read(hit));
      }
    }
  } catch (const globe::Error&) {
  }
  return 0;
}
