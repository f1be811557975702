#pragma once

#include <memory>

#include "converters/export_map.h"

namespace converters {

/// Writes the ground of a region as a binary glTF (.glb): one indexed mesh with normals (local_mesh.h), and
/// the planet's colors as an embedded PNG where it has any. asset.extras name the origin, the frame and the
/// level.
///
/// Of the options: output, extent, level, size (of the picture; default: a pixel for each cell of the colors,
/// at most 4096 a side) and overwrite. Same planet, same bytes. Throws what make_local_mesh throws, and
/// globe::Error when the disk does not take the file.
void export_mesh(const std::shared_ptr<const globe::planet::Surface>& surface, const ExportOptions& options,
                 const ConvertListener& listener);

}  // namespace converters
