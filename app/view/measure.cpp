#include "app/view/measure.h"

namespace app::view {

void Measure::set_on(bool on) {
  on_ = on;
  if (on) return;
  begin_.reset();
  line_.reset();
}

bool Measure::add_place(const globe::geo::Geodetic& place) {
  if (!begin_) {
    line_.reset();
    begin_ = place;
    return false;
  }
  line_ = MeasuredLine{
      *begin_, place, solver_.inverse(*begin_, place), solver_.places_along(*begin_, place, kPlaces), {}};
  begin_.reset();
  return true;
}

}  // namespace app::view
