#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "globe/htm/region.h"

namespace globe::htm {

/// All that is not in a region. The border, which is a line, goes with the region.
class Complement final : public Region {
 public:
  /// REQUIRES: not null.
  explicit Complement(std::shared_ptr<const Region> region) : region_(std::move(region)) {}

  bool contains(const dvec3& u) const override { return !region_->contains(u); }

  Relation relation(const Corners& trixel) const override {
    const Relation relation = region_->relation(trixel);
    if (relation == Relation::kTouches) return relation;
    return relation == Relation::kInside ? Relation::kDisjoint : Relation::kInside;
  }

  std::vector<dvec3> border_points() const override { return region_->border_points(); }

 private:
  std::shared_ptr<const Region> region_;
};

}  // namespace globe::htm
