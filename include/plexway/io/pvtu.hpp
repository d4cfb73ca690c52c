#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include <plexway/executors/joined_rows.hpp>

namespace plexway::io {

/// The files that a .pvtu names (VTK's partitioned unstructured grid), in order. Throws InputError
/// "FILE:LINE: cause" or "FILE: cause" when it is missing, malformed or names none, or one
/// twice, NotBuiltError without libpugixml.
[[nodiscard]] std::vector<std::filesystem::path> read_pvtu(const std::filesystem::path& file);

/// One of these files, the number-th, as a part of a surface: its triangles and polygons (cut into
/// fans) and its points, with their numbers in the whole if it has point data that VTK takes for
/// global ids, GlobalPointIds, or `original` as this library writes it. Ghost cells (vtkGhostType)
/// are left out. Throws InputError as read_mixed does, and for cells of other kinds.
[[nodiscard]] SurfaceFilePart read_surface_part(const std::filesystem::path& file,
                                                std::size_t number);

}  // namespace plexway::io
