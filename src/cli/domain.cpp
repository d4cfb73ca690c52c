#include "domain.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <system_error>
#include <utility>

#include <plexway/io/field.hpp>

#include "closest_point.hpp"
#include "io/extension.hpp"
#include "openvdb_functions.hpp"
#include "simplex_edges.hpp"

namespace plexway::cli {
namespace {

enum class Kind { surface, solid, wireframe, cloud };  // in the order of Domain::Shape
constexpr std::array<const char*, 4> kind_names = {"surface", "solid", "wireframe", "cloud"};

std::optional<Kind> asked_for(const std::string& as) {
  if (as.empty()) return std::nullopt;
  if (as == "surface") return Kind::surface;
  if (as == "solid") return Kind::solid;
  if (as == "wireframe") return Kind::wireframe;
  if (as == "cloud") return Kind::cloud;
  throw UsageError("--as " + as + ": no such kind; the kinds are surface, solid, cloud, wireframe");
}

bool has_extension(const std::filesystem::path& file, std::span<const std::string_view> known) {
  const std::string extension = io::lower_extension(file);
  return std::find(known.begin(), known.end(), extension) != known.end();
}

// Whether an .obj has a statement that starts with this letter.
bool has_statement(const std::string& file, char letter) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const std::size_t at = line.find_first_not_of(" \t");
    if (at != line.npos && line[at] == letter && at + 1 < line.size() &&
        (line[at + 1] == ' ' || line[at + 1] == '\t'))
      return true;
  }
  return false;
}

// An .obj may be either of two. Only one that cannot be read as a surface is looked at again.
Domain::Shape read_obj(const std::string& file, std::optional<Kind> asked) {
  if (asked == Kind::wireframe && has_statement(file, 'l')) return io::read_edges(file);
  try {
    return io::read_triangles(file);
  } catch (const InputError&) {
    if (asked == Kind::surface || has_statement(file, 'f') || !has_statement(file, 'l')) throw;
  }
  return io::read_edges(file);
}

Domain::Shape read(const std::string& file, std::optional<Kind> asked) {
  const bool triangles = has_extension(file, io::triangle_extensions());
  const bool lines = has_extension(file, io::edge_extensions());
  if (triangles && lines) return read_obj(file, asked);
  if (triangles) return io::read_triangles(file);
  if (lines) return io::read_edges(file);
  if (has_extension(file, io::tet_extensions())) return io::read_tets(file);
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw InputError(file + ": is a directory, not a file");
  const std::string extension = std::filesystem::path(file).extension().string();
  throw InputError(
      file + ": " + (extension.empty() ? "no extension" : "unknown extension '" + extension + "'") +
      "; known are .obj .off .ply .stl .gii for surfaces, .node .ele .mesh .msh .vtu .vtk "
      ".poly .smesh .vdb for solids, .edges .obj for wireframes, .xyz .pcd .ply for clouds");
}

// A .ply is a cloud where it is asked to be one, or where it cannot be a surface.
bool is_read_as_cloud(const std::string& file, std::optional<Kind> asked) {
  if (is_cloud_file(file)) return true;
  if (asked == Kind::cloud) return has_extension(file, io::point_extensions());
  return !asked && io::is_ply_cloud(file);
}

bool can_be(Kind natural, Kind wanted) {
  if (natural == wanted || natural == Kind::surface) return true;
  return natural == Kind::solid && wanted == Kind::wireframe;
}

[[noreturn]] void cannot_be(const std::string& file, Kind natural, Kind wanted) {
  throw InputError(file + ": is a " + kind_names[static_cast<std::size_t>(natural)] +
                   ", which cannot be taken as a " + kind_names[static_cast<std::size_t>(wanted)]);
}

}  // namespace

Domain Domain::load(const std::string& file, const std::string& as, const FillOptions& fill,
                    const CloudArguments& cloud, ProgressLine& progress) {
  const std::optional<Kind> asked = asked_for(as);
  check(fill);
  check(cloud);
  Domain domain;
  domain.file_ = file;
  domain.voxel_ = fill.volume.voxel.value_or(0);
  if (!fill.volume.grid.empty() && !is_vdb(file))
    throw UsageError("--grid needs a .vdb: other files have no grids");
  progress.phase("reading " + file);
  const Stopwatch loading;
  const bool is_cloud = is_read_as_cloud(file, asked);
  CloudFile points;
  if (is_cloud)
    points = read_cloud(file);
  else if (!is_poly(file) && !is_vdb(file))
    domain.shape_ = read(file, asked);
  domain.load_seconds_ = loading.seconds();
  const Kind natural = is_cloud                        ? Kind::cloud
                       : is_poly(file) || is_vdb(file) ? Kind::solid
                                                       : static_cast<Kind>(domain.shape_.index());
  const Kind wanted = asked.value_or(natural);
  const bool surface_of_vdb = is_vdb(file) && wanted == Kind::surface;
  if (!can_be(natural, wanted) && !surface_of_vdb) cannot_be(file, natural, wanted);
  if (fill.volume.repair && (natural != Kind::surface || wanted == Kind::cloud))
    throw UsageError("--repair needs a surface, and takes it as a surface or as a solid");
  if (cloud.given() && wanted != Kind::cloud)
    throw UsageError(
        "--k, --neighbour-radius, --max-normal-angle, --voxel, --denoise and --smooth need "
        "a cloud: a file of points, or a surface with --as cloud");

  const bool wants_solid = natural == Kind::surface && wanted == Kind::solid;
  // Without a word about how TetGen should do it, a repaired solid is cut from its level set.
  const bool cut = is_vdb(file) || (fill.volume.repair && !(wants_solid && fill.given()));
  const bool fills = is_poly(file) || (wants_solid && !cut);
  if (fill.given() && !fills)
    throw UsageError(
        "--max-volume, --quality, --keep-surface, --max-seconds and --hole need a surface to fill: "
        "give one with --as solid");
  if (fill.volume.voxel && !cut && !fill.volume.repair && !fill.volume.writes_volume &&
      wanted != Kind::cloud)
    throw UsageError("--voxel needs a cloud, --repair, or a .vdb to read or to write");
  if (cut || fill.volume.repair)
    domain.load_level_set(
        file,
        fills || wanted == Kind::surface || (natural == Kind::surface && wanted != Kind::solid),
        fill.volume, progress);
  if (fills) {
    require_tetgen(as.empty() ? file : "--as " + as);
    progress.phase("filling " + file + " with tetrahedra");
    const Stopwatch meshing;
    domain.shape_ =
        is_poly(file) ? fill_poly(file, fill, progress)
                      : fill_surface(file, std::get<io::Triangles>(domain.shape_), fill, progress);
    domain.mesh_seconds_ = meshing.seconds();
  }
  if (wanted == Kind::wireframe) {
    if (const auto* surface = std::get_if<io::Triangles>(&domain.shape_))
      domain.shape_ = edges_of(*surface);
    else if (const auto* solid = std::get_if<io::Tets>(&domain.shape_))
      domain.shape_ = edges_of(*solid);
  }
  if (wanted == Kind::cloud) {
    if (!is_cloud) points.points.positions = std::get<io::Triangles>(domain.shape_).positions;
    const Stopwatch looking;
    CloudArguments arguments = cloud;
    arguments.voxel = fill.volume.voxel;
    domain.shape_ = make_cloud(file, std::move(points), arguments, progress);
    domain.neighbour_seconds_ = looking.seconds();
  }
  return domain;
}

void Domain::load_level_set(const std::string& file, bool surface, const VolumeOptions& volume,
                            ProgressLine& progress) {
  const double voxel = volume.voxel.value_or(0);
  const Stopwatch meshing;
  if (is_vdb(file)) {
    const OpenvdbFunctions& openvdb = openvdb_functions(file);
    progress.phase("cutting " + file);
    try {
      if (surface)
        shape_ = openvdb.surface_of_file(file, volume.grid, voxel, level_set_note_);
      else
        shape_ = openvdb.solid_of_file(file, volume.grid, voxel, level_set_note_);
    } catch (const InputError& error) {
      const std::string cause = error.what();
      throw InputError(cause.starts_with(file) ? cause : file + ": " + cause);
    }
  } else {
    const OpenvdbFunctions& openvdb = openvdb_functions("--repair");
    progress.phase("repairing " + file);
    const auto broken = std::get<io::Triangles>(std::move(shape_));
    try {
      if (surface)
        shape_ = openvdb.repaired(broken, voxel, level_set_note_);
      else
        shape_ = openvdb.solid_inside(broken, voxel, level_set_note_);
    } catch (const InputError& error) {
      throw InputError(file + ": cannot be repaired: " + error.what());
    }
  }
  if (!surface) mesh_seconds_ = meshing.seconds();
}

std::string_view Domain::kind() const { return kind_names[shape_.index()]; }

std::string_view Domain::simplex_name() const {
  constexpr std::array<std::string_view, 4> names = {"triangles", "tetrahedra", "edges",
                                                     "triangles"};
  return names[shape_.index()];
}

std::size_t Domain::vertices() const {
  if (const auto* wireframe = std::get_if<io::Edges>(&shape_)) return wireframe->vertices;
  return positions().size();
}

std::size_t Domain::simplices() const {
  if (const auto* surface = std::get_if<io::Triangles>(&shape_)) return surface->triangles.size();
  if (const auto* solid = std::get_if<io::Tets>(&shape_)) return solid->tets.size();
  if (const auto* wireframe = std::get_if<io::Edges>(&shape_)) return wireframe->edges.size();
  return 0;
}

std::span<const std::uint32_t> Domain::corners(std::size_t simplex) const {
  if (const auto* surface = std::get_if<io::Triangles>(&shape_)) return surface->triangles[simplex];
  if (const auto* solid = std::get_if<io::Tets>(&shape_)) return solid->tets[simplex];
  return std::get<io::Edges>(shape_).edges[simplex];
}

std::span<const std::array<double, 3>> Domain::positions() const {
  if (cloud() != nullptr) return cloud()->points.positions;
  if (const auto* surface = std::get_if<io::Triangles>(&shape_)) return surface->positions;
  if (const auto* solid = std::get_if<io::Tets>(&shape_)) return solid->positions;
  return std::get<io::Edges>(shape_).positions;
}

PointSource Domain::closest(const std::array<double, 3>& point) const {
  if (cloud() != nullptr) return PointSource::at(nearest_point(*cloud(), point));
  const SimplexPoint found = std::visit(
      [&](const auto& shape) -> SimplexPoint {
        if constexpr (std::is_same_v<std::decay_t<decltype(shape)>, Cloud>)
          return {};
        else
          return closest_point(shape, point);
      },
      shape_);
  const auto at = corners(found.simplex);
  for (std::size_t i = 0; i < at.size(); ++i) {
    // Nearer to the corner than a rounding error of the coordinates.
    if (found.barycentric[i] >= 1 - 1e-12) return PointSource::at(at[i]);
  }
  return PointSource::in(static_cast<Index>(found.simplex), found.barycentric);
}

std::array<double, 3> Domain::position(const PointSource& source) const {
  const auto place = positions();
  if (source.vertex != none) return place[source.vertex];
  std::array<double, 3> at = {0, 0, 0};
  const auto ends = corners(source.simplex);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) at[k] += source.barycentric[i] * place[ends[i]][k];
  }
  return at;
}

void Domain::write_field(const std::filesystem::path& out, std::span<const double> distance,
                         std::span<const std::int32_t> label) const {
  if (is_vdb(out.string())) {
    const auto* solid = std::get_if<io::Tets>(&shape_);
    if (solid == nullptr)
      throw UsageError(out.string() + ": only the field of a solid fits a .vdb");
    if (openvdb_functions(out.string()).write_field(out, *solid, distance, label, voxel_) == 0)
      throw UsageError(out.string() +
                       ": no voxel has its centre in the solid: choose a smaller --voxel");
    return;
  }
  using io::write_field;  // and the one of clouds
  std::visit([&](const auto& shape) { write_field(out, shape, distance, label); }, shape_);
}

std::span<const std::string_view> Domain::field_extensions() const {
  static const std::vector<std::string_view> of_solids = [] {
    const auto known = io::field_extensions();
    std::vector<std::string_view> all(known.begin(), known.end());
    all.push_back(".vdb");
    return all;
  }();
  if (cloud() != nullptr) return cloud_field_extensions();
  return std::holds_alternative<io::Tets>(shape_) ? of_solids : io::field_extensions();
}

}  // namespace plexway::cli
