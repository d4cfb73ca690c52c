#pragma once

#include <optional>
#include <string>
#include <vector>

#include <plexway/any/shape.hpp>

#include "cli/options/cloud_options.hpp"
#include "cli/options/fill_options.hpp"
#include "cli/report/progress.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// What a user hands to the tool.
using Domain = AnyShape;

/// Further files than INPUT, as typed.
struct PieceArguments {
  std::vector<std::string> more;
  std::optional<double> weld;
};

/// Adds MORE and --weld to a command.
void add_piece_options(CLI::App& command, PieceArguments& pieces);

/// What the library tells while it works, on the line; `progress` must stay.
[[nodiscard]] ReadProgress read_progress(ProgressLine& progress);

/// How INPUT is to be read. Throws UsageError for a kind that does not exist.
[[nodiscard]] ReadOptions read_options(const std::string& as, const FillArguments& fill,
                                       const CloudPreparation& cloud, ProgressLine& progress);

/// Reads INPUT as AnyShape::read does. Throws UsageError, too, for a kind that does not exist.
Domain load_domain(const std::string& file, const std::string& as, const FillArguments& fill,
                   const CloudPreparation& cloud, ProgressLine& progress,
                   const PieceArguments& pieces = {});

/// What INPUT may be, for the help of the commands.
inline constexpr const char* input_help =
    "a surface: .obj .off .ply .stl; a solid: .node .ele .mesh .msh .vtu .vtk,\n"
    ".poly .smesh through TetGen, and a level set .vdb through OpenVDB; a wireframe: .edges, or "
    ".obj with lines only;\n"
    "a cloud of points: .xyz, .ply without faces, and .pcd through PCL;\n"
    "simplices of dimension 1 to 4: .simplices";
inline constexpr const char* as_help =
    "what to take it as: surface, solid (fills a surface with tetrahedra),\n"
    "wireframe (the edges alone), cloud (the vertices of a surface alone) or mixed (all\n"
    "lines, triangles and tetrahedra of a .msh, .vtu or .vtk); default: what the extension\n"
    "says";

}  // namespace plexway::cli
