#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/formats.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/io/mixed.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/shape/support.hpp>
#include <plexway/support.hpp>

#include "io/names.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/boundary.hpp"
#include "shape/files/files.hpp"
#include "shape/files/kept_build.hpp"
#include "shape/modules/module.hpp"
#include "shape/shape_state.hpp"
#include "shape/words.hpp"

namespace plexway {
using namespace detail;
namespace {

using Data = AnyShape::Data;

// Those whose readers go back and forth, or look for a second file beside it.
constexpr std::array<std::string_view, 4> tied_to_names = {".poly", ".smesh", ".vdb", ".pcd"};

MixedShape mixed_of(io::Mixed cells) {
  MixedShape shape;
  shape.parts = {{.first_vertex = 0,
                  .vertices = cells.positions.size(),
                  .edges = std::move(cells.edges),
                  .triangles = std::move(cells.triangles),
                  .tets = std::move(cells.tets)}};
  shape.positions = std::move(cells.positions);
  return shape;
}

// Of a file of cells what has most dimensions; nothing where there are points alone. Lines are
// rather a wireframe than edges of triangles where files draw both.
std::optional<Data> data_of(const std::string& file, io::Mixed cells, bool as_mixed,
                            bool as_wireframe, io::FileReport& report) {
  report = std::move(cells.report);
  if (as_mixed) return mixed_of(std::move(cells));
  const std::string extension = io::InputName(file).extension;
  const bool draws = extension == ".obj" || extension == ".ply";
  if (as_wireframe && draws && !cells.edges.empty()) cells.triangles.clear();
  if (!cells.tets.empty()) report.pass_over("triangles", cells.triangles.size());
  if (!cells.tets.empty() || !cells.triangles.empty())
    report.pass_over("lines", cells.edges.size());
  if (!cells.tets.empty()) return io::Tets{std::move(cells.positions), std::move(cells.tets)};
  if (!cells.triangles.empty())
    return io::Triangles{std::move(cells.positions), std::move(cells.triangles)};
  if (cells.edges.empty()) return std::nullopt;
  const std::size_t n = cells.positions.size();
  return io::Edges{std::move(cells.positions), std::move(cells.edges), {}, n};
}

// What a file holds but points, nothing for these.
std::optional<Data> read_data(const std::string& file, std::optional<DomainKind> asked,
                              io::FileReport& report) {
  const io::Format format = io::format_of(file);
  // A surface is no mixed domain.
  const bool as_mixed = asked == DomainKind::mixed && format.may_hold(DomainKind::solid);
  switch (format.reader) {
    case io::FileReader::edges: {
      io::Edges wires = io::read_edges(file);
      report = std::move(wires.report);
      return wires;
    }
    case io::FileReader::simplices:
      return io::read_simplices(file);
    default:
      return data_of(file, io::read_cells(file), as_mixed, asked == DomainKind::wireframe, report);
  }
}

// A .ply is a cloud where it is requested as one, or where it cannot be anything else: its normals
// are wanted then.
bool is_read_as_cloud(const std::string& file, std::optional<DomainKind> asked) {
  if (is_cloud_file(file)) return true;
  if (asked == DomainKind::cloud) return io::InputName(file).extension == ".ply";
  return !asked && io::is_ply_cloud(file);
}

FileForm form_of(const std::string& file) {
  return is_kept_build(file) ? FileForm::prepared
         : is_vdb(file)      ? FileForm::level_set
         : is_poly(file)     ? FileForm::boundary
                             : FileForm::plain;
}

// What is requested as files are read, by the names that the caller knows.
class Asked {
 public:
  explicit Asked(const ReadOptions& options) : options_(options) {}

  [[nodiscard]] std::string name(std::string_view field) const {
    return spelled(options_.spelling, field);
  }
  [[nodiscard]] std::string as(DomainKind kind) const {
    return name("as") + " " + std::string(kind_name(kind));
  }

  // What is supported with a file, or several, by the table (shape/support.hpp). In two parts: of
  // grids the form of a file tells before it is read.
  void check_grid(const FileUse& use) const {
    ask(!options_.volume.grid.empty(), Reading::grid, name("grid"), use);
  }
  void check(const std::string& file, FileUse use) const {
    use.repaired = options_.volume.repair;
    use.writes_volume = options_.volume.writes_volume;
    if (use.form == FileForm::prepared || use.several)
      ask(options_.as.has_value(), Reading::kind, file + ": " + name("as"), use);
    ask(options_.volume.repair, Reading::repair, name("repair"), use);
    ask(options_.cloud.given(), Reading::connecting,
        name("k") + ", " + name("neighbour_radius") + ", " + name("max_normal_angle") + ", " +
            name("denoise") + " and " + name("smooth") + " go with " + as(DomainKind::cloud),
        use);
    ask(options_.fill.given(), Reading::filling,
        name("max_volume") + ", " + name("quality") + ", " + name("keep_surface") + ", " +
            name("max_seconds") + " and " +
            name(options_.spelling == Spelling::flags ? "hole" : "holes") + " go with " +
            as(DomainKind::solid),
        use);
    ask(options_.volume.voxel.has_value(), Reading::voxel, name("voxel"), use);
    ask(options_.merge.has_value(), Reading::merging, name("merge"), use);
  }

  // Of a shape that is read strictly nothing may be left out, guessed or repaired.
  void require_strict(const AnyShape& shape) const {
    if (!options_.strict) return;
    std::string cause = shape.report().notes.empty() ? "" : shape.report().notes.front();
    if (!shape.collapsed().empty()) cause = collapsed_sentence(shape);
    if (!cause.empty())
      throw InputError(shape.file().string() + ": " + cause + ", which " + name("strict") +
                       " refuses");
  }

 private:
  static void ask(bool given, Reading reading, const std::string& names, const FileUse& use) {
    if (given) require(names, support(reading, use));
  }

  const ReadOptions& options_;
};

void check_kind(const std::string& file, const FileUse& use) {
  require_input(file + ": is a " + std::string(kind_noun(use.held)) +
                    ", which cannot be taken as a " + std::string(kind_noun(use.wanted)),
                support(Reading::kind, use));
}

// May what a file holds be a part of a mixed domain?
void check_part(const std::string& file, FileUse use) {
  use.several = true;
  require_input(file, support(Reading::joining, use));
}

// One more file of a mixed domain.
template <class Kind>
void append(Kind data, const std::string& file, MixedShape& shape) {
  MixedShape::Part part;
  std::vector<std::array<double, 3>> positions;
  if constexpr (!std::is_same_v<Kind, SimplexShape> && !std::is_same_v<Kind, CloudShape>)
    positions = std::move(data.positions);
  if constexpr (std::is_same_v<Kind, io::Triangles>) {
    part.triangles = std::move(data.triangles);
  } else if constexpr (std::is_same_v<Kind, io::Tets>) {
    part.tets = std::move(data.tets);
  } else if constexpr (std::is_same_v<Kind, io::Edges>) {
    check_part(file, {.held = DomainKind::wireframe,
                      .wanted = DomainKind::mixed,
                      .positions = !positions.empty()});
    part.edges = std::move(data.edges);
  } else if constexpr (std::is_same_v<Kind, MixedShape>) {
    part = std::move(data.parts.front());
  } else {
    check_part(
        file, {.held = std::is_same_v<Kind, CloudShape> ? DomainKind::cloud : DomainKind::simplices,
               .wanted = DomainKind::mixed});
  }
  part.first_vertex = shape.positions.size();
  part.vertices = positions.size();
  if (part.first_vertex + part.vertices >= none)
    throw InputError(file + ": more vertices in all than 32 bits count");
  const auto move = [&](auto& rows) {
    for (auto& row : rows)
      for (Index& v : row) v += static_cast<Index>(part.first_vertex);
  };
  move(part.edges), move(part.triangles), move(part.tets);
  shape.positions.insert(shape.positions.end(), positions.begin(), positions.end());
  shape.parts.push_back(std::move(part));
}

// Makes a shape of a file; what is requested is in `options`.
class ShapeFile {
 public:
  ShapeFile(std::string file, const ReadOptions& options)
      : file_(std::move(file)), options_(options), asked_(options) {}

  AnyShape read();

 private:
  void begin(const std::string& what) const {
    if (options_.progress.stage) options_.progress.stage(what);
  }
  void take_level_set(bool surface);
  void fill();

  std::string file_;
  const ReadOptions& options_;
  const Asked asked_;
  AnyShape::State state_;
};

AnyShape ShapeFile::read() {
  const VolumeOptions& volume = options_.volume;
  const std::optional<DomainKind> asked = options_.as;
  check(options_);
  state_.file = file_;
  state_.voxel = volume.voxel.value_or(0);
  const FileForm form = form_of(file_);
  const FileUse unread{DomainKind::solid, DomainKind::solid, form};
  asked_.check_grid(unread);
  if (form == FileForm::prepared) {
    asked_.check(file_, unread);
    AnyShape::State kept = read_kept_build(std::filesystem::path(file_));
    if (volume.voxel) kept.voxel = *volume.voxel;
    return AnyShape::of(std::move(kept));
  }
  // As in vdb:-.
  if (std::find(tied_to_names.begin(), tied_to_names.end(), io::InputName(file_).extension) !=
          tied_to_names.end() &&
      std::filesystem::path(file_).extension() != io::InputName(file_).extension)
    throw InputError(file_ + ": a " + io::InputName(file_).extension +
                     " must be a file with that extension: it is not read from end to end, or not "
                     "alone");
  begin("reading " + file_);
  const Stopwatch loading;
  bool is_cloud = is_read_as_cloud(file_, asked);
  CloudFile points;
  if (!is_cloud && !is_poly(file_) && !is_vdb(file_)) {
    if (auto data = read_data(file_, asked, state_.report))
      state_.data = *std::move(data);
    else
      is_cloud = true;
  }
  if (is_cloud) {
    points = read_cloud(file_);
    state_.report = std::move(points.points.report);
  }
  state_.load_seconds = loading.seconds();
  const DomainKind natural = is_cloud ? DomainKind::cloud
                             : is_poly(file_) || is_vdb(file_)
                                 ? DomainKind::solid
                                 : static_cast<DomainKind>(state_.data.index());
  const DomainKind wanted = asked.value_or(natural);
  const FileUse use{natural, wanted, form};
  check_kind(file_, use);
  asked_.check(file_, use);

  const bool wants_solid = natural == DomainKind::surface && wanted == DomainKind::solid;
  // Without a word about how TetGen should do it, a repaired solid is cut from its level set.
  const bool cut = is_vdb(file_) || (volume.repair && !(wants_solid && options_.fill.given()));
  const bool fills = is_poly(file_) || (wants_solid && !cut);
  if (cut || volume.repair)
    take_level_set(fills || wanted == DomainKind::surface ||
                   (natural == DomainKind::surface && wanted != DomainKind::solid));
  if (fills) fill();
  if (wanted == DomainKind::wireframe && natural != DomainKind::wireframe) {
    AnyShape::State filled;
    filled.data = std::move(state_.data);
    state_.data = edges_of(AnyShape::of(std::move(filled)));
  }
  if (wanted == DomainKind::cloud) {
    if (!is_cloud) points.points.positions = std::get<io::Triangles>(state_.data).positions;
    const Stopwatch looking;
    state_.data = make_cloud(file_, std::move(points), options_);
    state_.neighbour_seconds = looking.seconds();
  }
  if (options_.merge) merge_vertices(state_, *options_.merge);
  AnyShape shape = AnyShape::of(std::move(state_));
  asked_.require_strict(shape);
  return shape;
}

void ShapeFile::fill() {
  require_tetgen(options_.as ? asked_.as(*options_.as) : file_);
  begin("filling " + file_ + " with tetrahedra");
  const Stopwatch meshing;
  state_.data = is_poly(file_)
                    ? fill_poly(file_, options_)
                    : fill_surface(file_, std::get<io::Triangles>(state_.data), options_);
  state_.mesh_seconds = meshing.seconds();
}

void ShapeFile::take_level_set(bool surface) {
  const double voxel = options_.volume.voxel.value_or(0);
  std::string& note = state_.level_set_note;
  const Stopwatch meshing;
  if (is_vdb(file_)) {
    const OpenvdbFunctions& openvdb = openvdb_functions(file_);
    begin("cutting " + file_);
    try {
      const std::string& grid = options_.volume.grid;
      if (surface)
        state_.data = openvdb.surface_of_file(file_, grid, voxel, note);
      else
        state_.data = openvdb.solid_of_file(file_, grid, voxel, note);
    } catch (const InputError& error) {
      const std::string cause = error.what();
      throw InputError(cause.starts_with(file_) ? cause : file_ + ": " + cause);
    }
  } else {
    const OpenvdbFunctions& openvdb = openvdb_functions(asked_.name("repair"));
    begin("repairing " + file_);
    const auto broken = std::get<io::Triangles>(std::move(state_.data));
    try {
      if (surface)
        state_.data = openvdb.repaired(broken, voxel, note);
      else
        state_.data = openvdb.solid_inside(broken, voxel, note);
    } catch (const InputError& error) {
      throw InputError(file_ + ": cannot be repaired: " + error.what());
    }
  }
  if (!surface) state_.mesh_seconds = meshing.seconds();
}

}  // namespace

AnyShape AnyShape::read(std::span<const std::filesystem::path> files, double tolerance,
                        const ReadOptions& options) {
  const Asked asked(options);
  check(options);
  if (!(tolerance >= 0) || std::isinf(tolerance))
    throw UsageError(asked.name("weld") + " must be a number >= 0");
  std::string names;
  for (const std::filesystem::path& path : files)
    names += (names.empty() ? "" : ", ") + path.string();
  const FileUse parts{
      .held = DomainKind::mixed, .wanted = options.as.value_or(DomainKind::mixed), .several = true};
  asked.check_grid(parts);
  asked.check(names, parts);
  State state;
  MixedShape shape;
  shape.tolerance = tolerance;
  const Stopwatch loading;
  for (const std::filesystem::path& path : files) {
    const std::string file = path.string();
    if (options.progress.stage) options.progress.stage("reading " + file);
    const bool points = is_cloud_file(file) || io::is_ply_cloud(file);
    check_part(file, {.held = points ? DomainKind::cloud : DomainKind::surface,
                      .wanted = DomainKind::mixed,
                      .form = form_of(file)});
    io::FileReport report;
    auto data = read_data(file, DomainKind::mixed, report);
    if (!data) check_part(file, {.held = DomainKind::cloud, .wanted = DomainKind::mixed});
    std::visit([&](auto&& part) { append(std::move(part), file, shape); }, *std::move(data));
    state.report.split_polygons += report.split_polygons;
    state.report.split_cells += report.split_cells;
    for (const auto& [what, count] : report.passed_over) state.report.pass_over(what, count);
    for (const std::string& note : report.notes) state.report.notes.push_back(file + ": " + note);
  }
  state.load_seconds = loading.seconds();
  state.file = names;
  state.data = std::move(shape);
  AnyShape made = of(std::move(state));
  asked.require_strict(made);
  return made;
}

AnyShape AnyShape::read(const std::filesystem::path& file, const ReadOptions& options) {
  return ShapeFile(file.string(), options).read();
}

std::vector<std::int64_t> AnyShape::regions() const {
  support(Purpose::regions, kind()).require();
  if (file().empty()) throw UsageError("regions come from a file, and this shape has none");
  const std::string name = file().string();
  const auto foreign = [&](std::size_t cells) {
    return UsageError(name + " has regions of " + counted(cells, "cells") + ", which are not the " +
                      counted(simplices(), simplex_name()) + " of the domain");
  };
  io::Regions found = io::read_regions(file());
  std::vector<std::int64_t> regions;
  if (kind() == DomainKind::solid) {
    regions = std::move(found.tets);
  } else if (kind() == DomainKind::mixed) {
    for (const auto* list : {&found.edges, &found.triangles, &found.tets})
      regions.insert(regions.end(), list->begin(), list->end());
  } else {
    const io::Mixed cells = io::read_cells(file());
    if (const auto* surface = std::get_if<io::Triangles>(&data())) {
      if (cells.triangles != surface->triangles) throw foreign(cells.triangles.size());
      regions = std::move(found.triangles);
    } else {
      if (cells.edges != std::get<io::Edges>(data()).edges) throw foreign(cells.edges.size());
      regions = std::move(found.edges);
    }
  }
  if (regions.size() != simplices()) throw foreign(regions.size());
  return regions;
}

}  // namespace plexway
