#pragma once

#include "globe/clipmap/morph.h"

namespace globe::render {

/// Which level is shown as the finest, and how far it is still morphed into the one below, frame by frame,
/// where levels arrive late.
///
/// A level that is there when it is first wanted fades in by height, as clipmap::finest_level says. One that
/// comes late morphs in over a few frames, and the next finer one is admitted when that is over: rims of a
/// level meet unmorphed ground only (DESIGN section 5). Many that wait morph in faster each.
class Admission {
 public:
  /// The next frame.
  ///
  /// @param wanted     for its camera
  /// @param available  finest level there is
  /// @returns at most that level and at least that fade
  clipmap::FinestLevel next(const clipmap::FinestLevel& wanted, int available);

  /// A frame that waited for all it needs.
  void show(const clipmap::FinestLevel& wanted);

 private:
  clipmap::FinestLevel shown_{-1, 0.0f};
  int wanted_before_ = -1;
  bool late_ = false;  ///< the shown level morphs in by frames
};

}  // namespace globe::render
