#pragma once

namespace globe::flat {

/// Hands on the two triangles of a cell of posts, each counter-clockwise seen from above.
/// @param north_east  split from the south-western corner to the north-eastern one, else from the
///                    south-eastern to the north-western
template <class Corner, class Add>
void split_cell(bool north_east, const Corner& sw, const Corner& se, const Corner& nw, const Corner& ne,
                const Add& add) {
  if (north_east) {
    add(sw, se, ne);
    add(sw, ne, nw);
  } else {
    add(sw, se, nw);
    add(se, ne, nw);
  }
}

}  // namespace globe::flat
