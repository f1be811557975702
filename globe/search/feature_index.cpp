#include "globe/search/feature_index.h"

#include "globe/search/open_database.h"
#include "globe/search/search.h"

namespace globe::search {

FeatureIndex::FeatureIndex(const std::filesystem::path& path)
    : database_(std::make_unique<OpenDatabase>(path)) {}
FeatureIndex::~FeatureIndex() = default;
FeatureIndex::FeatureIndex(FeatureIndex&&) noexcept = default;

const geo::Ellipsoid& FeatureIndex::ellipsoid() const { return database_->about.ellipsoid; }
std::uint64_t FeatureIndex::size() const { return database_->about.points + database_->about.shapes; }

std::vector<Hit> FeatureIndex::find(const Query& query) { return Search(*database_, query).run(); }

FoundFeature FeatureIndex::read(const Hit& hit) {
  Statement& row =
      hit.htm == 0 ? database_->one_shape.with(hit.id) : database_->one_point.with(hit.htm, hit.id);
  if (!row.step()) throw database_->damage("a feature is missing");
  FoundFeature feature{std::string(row.bytes(4)), std::string(row.bytes(5))};
  row.reset();
  return feature;
}

}  // namespace globe::search
