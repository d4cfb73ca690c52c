
#include <algorithm>
#include <span>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/shape.hpp>
#include <plexway/shape/support.hpp>

#include "io/names.hpp"
#include "shape/arguments/arguments.hpp"
#include "shape/boundary.hpp"
#include "shape/files/files.hpp"
#include "shape/modules/module.hpp"
#include "shape/stopwatch.hpp"

namespace plexway::detail {
namespace {

bool among(std::span<const std::string_view> known, const std::string& extension) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

// What the input is taken as: what the extension of the output can hold.
std::optional<DomainKind> kind_for(const std::string& input, const std::string& out,
                                   std::optional<DomainKind> as) {
  if (as) return as;
  const std::string extension = io::lower_extension(out);
  const bool surfaces = among(io::triangle_output_extensions(), extension);
  const bool solids = among(io::tet_extensions(), extension);
  if (solids && !surfaces) return DomainKind::solid;
  if (is_vdb(input) && !solids) return DomainKind::surface;
  return std::nullopt;
}

class Conversion : public Converted {
 public:
  Conversion(const std::string& input, const std::string& out, const ReadOptions& options)
      : input_(input), out_(out), options_(options), extension_(io::lower_extension(out)) {}

  void cloud() {
    stage("reading " + input_);
    const VolumeOptions& volume = options_.volume;
    if (options_.fill.given() || volume.repair || volume.voxel || !volume.grid.empty() ||
        options_.merge)
      require(input_,
              support(Reading::voxel,
                      {.held = DomainKind::cloud, .wanted = DomainKind::cloud, .copied = true}));
    if (!among(io::point_output_extensions(), extension_))
      cannot("cloud", io::point_output_extensions());
    io::Points points;
    if (is_cloud_file(input_) || io::is_ply_cloud(input_)) {
      CloudFile cloud = read_cloud(input_);
      points = std::move(cloud.points);
    } else {
      ReadOptions plain;
      plain.spelling = options_.spelling;
      plain.progress = options_.progress;
      const AnyShape domain = AnyShape::read(input_, plain);
      points.positions.assign(domain.positions().begin(), domain.positions().end());
    }
    load_seconds = watch_.seconds();
    io::write_points(out_, points);
    kind = "cloud";
    vertices = points.positions.size();
  }

  void mesh() {
    ReadOptions options = options_;
    options.cloud = {};
    if (extension_ == ".vdb" && is_vdb(input_) && !options.volume.voxel)
      throw UsageError(input_ +
                       ": is a level set already; to sample it anew say how finely: --voxel SIZE");
    if (extension_ == ".vdb" && !options.volume.repair && !is_vdb(input_))
      options.volume.voxel.reset();  // that of the output
    options.as = kind_for(input_, out_, options_.as);
    const AnyShape domain = AnyShape::read(input_, options);
    require(input_, support(Purpose::conversions, domain.kind()));
    kind = domain.kind_name();
    simplex_name = domain.simplex_name();
    note = domain.level_set_note();
    load_seconds = watch_.seconds();
    stage("writing " + out_);
    std::visit([&](const auto& shape) { write(shape); }, domain.data());
  }

  void finish() { write_seconds = watch_.seconds() - load_seconds; }

 private:
  [[noreturn]] void cannot(const char* what, std::span<const std::string_view> known) const {
    std::string names;
    for (const std::string_view one : known) names.append(" ").append(one);
    const bool has_edges = std::string_view(what) == "surface";
    throw UsageError(out_ + ": a " + what + " does not go into a " + extension_ + ", but into" +
                     names +
                     (has_edges && among(io::edge_output_extensions(), extension_)
                          ? "; its edges do: --as wireframe"
                          : ""));
  }

  void count(std::size_t v, std::size_t s) {
    vertices = v;
    simplices = s;
  }

  void write(const io::Triangles& surface) {
    count(surface.positions.size(), surface.triangles.size());
    if (extension_ == ".vdb") {
      const OpenvdbFunctions& openvdb = openvdb_functions(out_);
      std::string said;
      try {
        openvdb.write_level_set(out_, surface, options_.volume.voxel.value_or(0), said);
      } catch (const InputError& error) {
        throw InputError(input_ + ": cannot be a level set: " + error.what());
      }
      note += (note.empty() ? "" : "; as a level set: ") + said;
      return;
    }
    if (extension_ == ".xyz") return io::write_points(out_, {surface.positions, {}});
    if (!among(io::triangle_output_extensions(), extension_))
      cannot("surface", io::triangle_output_extensions());
    io::write_triangles(out_, surface);
  }

  void write(const io::Tets& solid) {
    if (among(io::tet_extensions(), extension_)) {
      count(solid.positions.size(), solid.tets.size());
      return io::write_tets(out_, solid);
    }
    kind = "the solid's surface";
    simplex_name = "triangles";
    write(boundary_of(solid));
  }

  void write(const io::Edges& wireframe) {
    if (!among(io::edge_output_extensions(), extension_))
      cannot("wireframe", io::edge_output_extensions());
    count(wireframe.vertices, wireframe.edges.size());
    io::write_edges(out_, wireframe);
  }

  void write(const CloudShape& cloud) {
    if (!among(io::point_output_extensions(), extension_))
      cannot("cloud", io::point_output_extensions());
    count(cloud.points.positions.size(), 0);
    simplex_name.clear();
    io::write_points(out_, cloud.points);
  }
  void write(const SimplexShape&) {}  // refused
  void write(const MixedShape&) {}

  void stage(const std::string& what) const {
    if (options_.progress.stage) options_.progress.stage(what);
  }

  const std::string &input_, &out_;
  const ReadOptions& options_;
  std::string extension_;
  Stopwatch watch_;
};

}  // namespace

std::vector<std::string_view> conversion_extensions() {
  std::vector<std::string_view> all;
  for (const auto known : {io::triangle_output_extensions(), io::tet_extensions(),
                           io::edge_output_extensions(), io::point_output_extensions()})
    for (const std::string_view one : known)
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  all.push_back(".vdb");
  return all;
}

Converted convert(const std::string& input, const std::string& out, const ReadOptions& options) {
  const bool points = is_cloud_file(input) || io::is_ply_cloud(input);
  Conversion conversion(input, out, options);
  if (options.as == DomainKind::cloud || (!options.as && !options.volume.repair && points))
    conversion.cloud();
  else
    conversion.mesh();
  conversion.finish();
  return conversion;
}

}  // namespace plexway::detail
