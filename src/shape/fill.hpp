#pragma once

#include <string>

#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/read_options.hpp>

namespace plexway {

/// Throws NotBuiltError, naming the package, where this build has no TetGen; `what` starts the
/// message.
void require_tetgen(const std::string& what);

/// Whether the extension of `file` is one of TetGen's boundaries, .poly and .smesh; and whether it
/// is OpenVDB's.
bool is_poly(const std::string& file);
bool is_vdb(const std::string& file);

/// The solid inside a surface, or inside what a `.poly` or `.smesh` describes. Throws InputError
/// "FILE: cause", NotBuiltError as `require_tetgen`, and Error at the time limit.
io::Tets fill_surface(const std::string& file, const io::Triangles& surface,
                      const ReadOptions& options);
io::Tets fill_poly(const std::string& file, const ReadOptions& options);

}  // namespace plexway
