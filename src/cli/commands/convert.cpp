#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <variant>

#include <plexway/error.hpp>
#include <plexway/io/edges.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>

#include "any/fill.hpp"
#include "any/openvdb_functions.hpp"
#include "any/solid_boundary.hpp"
#include "cli/commands/commands.hpp"
#include "cli/options/input.hpp"
#include "cli/report/console.hpp"
#include "cli/report/distance_output.hpp"
#include "cli/report/progress.hpp"
#include "cli/report/report.hpp"
#include "io/extension.hpp"

namespace plexway::cli {
namespace {

struct ConvertCommand {
  std::string input, out, as;
  FillArguments fill;
  bool json = false, quiet = false;
};

bool among(std::span<const std::string_view> known, const std::string& extension) {
  return std::find(known.begin(), known.end(), extension) != known.end();
}

std::vector<std::string_view> output_extensions() {
  std::vector<std::string_view> all;
  for (const auto known : {io::triangle_output_extensions(), io::tet_extensions(),
                           io::edge_output_extensions(), io::point_output_extensions()})
    for (const std::string_view one : known)
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  all.push_back(".vdb");
  return all;
}

// What the input is taken as: what the extension of the output can hold.
std::string kind_for(const ConvertCommand& command) {
  if (!command.as.empty()) return command.as;
  const std::string extension = io::lower_extension(command.out);
  const bool surfaces = among(io::triangle_output_extensions(), extension);
  const bool solids = among(io::tet_extensions(), extension);
  if (solids && !surfaces) return "solid";
  if (is_vdb(command.input) && !solids) return "surface";
  return "";
}

class Conversion {
 public:
  Conversion(const ConvertCommand& command, ProgressLine& progress, Phases& phases)
      : command_(command),
        extension_(io::lower_extension(command.out)),
        progress_(progress),
        phases_(phases) {}

  void cloud() {
    progress_.phase("reading " + command_.input);
    const VolumeOptions& volume = command_.fill.volume;
    if (command_.fill.given() || volume.repair || volume.voxel || !volume.grid.empty())
      throw UsageError(command_.input +
                       ": points are copied as they are: --repair, --voxel, --grid and what TetGen "
                       "is told mean nothing here");
    if (!among(io::point_output_extensions(), extension_))
      cannot("cloud", io::point_output_extensions());
    io::Points points;
    if (is_cloud_file(command_.input) || io::is_ply_cloud(command_.input)) {
      CloudFile cloud = read_cloud(command_.input);
      points = std::move(cloud.points);
    } else {
      const Domain domain = load_domain(command_.input, "", {}, {}, progress_);
      points.positions.assign(domain.positions().begin(), domain.positions().end());
    }
    phases_.end("load");
    io::write_points(command_.out, points);
    kind = "cloud";
    vertices = points.positions.size();
  }

  void mesh() {
    FillArguments fill = command_.fill;
    if (extension_ == ".vdb" && is_vdb(command_.input) && !fill.volume.voxel)
      throw UsageError(command_.input +
                       ": is a level set already; to sample it anew say how finely: --voxel SIZE");
    if (extension_ == ".vdb" && !fill.volume.repair && !is_vdb(command_.input))
      fill.volume.voxel.reset();  // that of the output
    const Domain domain = load_domain(command_.input, kind_for(command_), fill, {}, progress_);
    kind = domain.kind_name();
    simplex_name = domain.simplex_name();
    note = domain.level_set_note();
    phases_.end("load");
    progress_.phase("writing " + command_.out);
    std::visit([&](const auto& shape) { write(shape); }, domain.data());
  }

  std::string kind, simplex_name, note;
  std::size_t vertices = 0, simplices = 0;

 private:
  [[noreturn]] void cannot(const char* what, std::span<const std::string_view> known) const {
    std::string names;
    for (const std::string_view one : known) names.append(" ").append(one);
    const bool has_edges = std::string_view(what) == "surface";
    throw UsageError(command_.out + ": a " + what + " does not go into a " + extension_ +
                     ", but into" + names +
                     (has_edges && among(io::edge_output_extensions(), extension_)
                          ? "; its edges do: --as wireframe"
                          : ""));
  }

  [[noreturn]] void not_written() const {
    throw UsageError(command_.input +
                     ": surfaces, solids, wireframes and clouds are converted, nothing else");
  }

  void count(std::size_t v, std::size_t s) {
    vertices = v;
    simplices = s;
  }

  void write(const io::Triangles& surface) {
    count(surface.positions.size(), surface.triangles.size());
    if (extension_ == ".vdb") {
      const OpenvdbFunctions& openvdb = openvdb_functions(command_.out);
      std::string said;
      try {
        openvdb.write_level_set(command_.out, surface, command_.fill.volume.voxel.value_or(0),
                                said);
      } catch (const InputError& error) {
        throw InputError(command_.input + ": cannot be a level set: " + error.what());
      }
      note += (note.empty() ? "" : "; as a level set: ") + said;
      return;
    }
    if (extension_ == ".xyz") return io::write_points(command_.out, {surface.positions, {}});
    if (!among(io::triangle_output_extensions(), extension_))
      cannot("surface", io::triangle_output_extensions());
    io::write_triangles(command_.out, surface);
  }

  void write(const io::Tets& solid) {
    if (among(io::tet_extensions(), extension_)) {
      count(solid.positions.size(), solid.tets.size());
      return io::write_tets(command_.out, solid);
    }
    kind = "the solid's surface";
    simplex_name = "triangles";
    write(boundary_of(solid));
  }

  void write(const io::Edges& wireframe) {
    if (!among(io::edge_output_extensions(), extension_))
      cannot("wireframe", io::edge_output_extensions());
    count(wireframe.vertices, wireframe.edges.size());
    io::write_edges(command_.out, wireframe);
  }

  void write(const CloudShape& cloud) {
    if (!among(io::point_output_extensions(), extension_))
      cannot("cloud", io::point_output_extensions());
    count(cloud.points.positions.size(), 0);
    simplex_name.clear();
    io::write_points(command_.out, cloud.points);
  }
  void write(const SimplexShape&) { not_written(); }
  void write(const MixedShape&) { not_written(); }

  const ConvertCommand& command_;
  std::string extension_;
  ProgressLine& progress_;
  Phases& phases_;
};

void run_convert(const ConvertCommand& command) {
  check_output_name(command.out, command.input, output_extensions(), "output");
  (void)filling(command.fill);
  ProgressLine progress(command.quiet);
  Phases phases;
  Conversion conversion(command, progress, phases);
  const bool is_cloud = command.as.empty() && !command.fill.volume.repair &&
                        (is_cloud_file(command.input) || io::is_ply_cloud(command.input));
  if (is_cloud || command.as == "cloud")
    conversion.cloud();
  else
    conversion.mesh();
  phases.end("write");
  progress.clear();
  Json json;
  json["input"] = command.input;
  json["out"] = command.out;
  json["kind"] = conversion.kind;
  json["vertices"] = conversion.vertices;
  json["simplices"] = conversion.simplices;
  if (!conversion.note.empty()) json["voxels"] = conversion.note;
  Table table;
  table.add("input", command.input);
  table.add(conversion.kind,
            counted(conversion.vertices, "vertices") +
                (conversion.simplex_name.empty()
                     ? std::string()
                     : ", " + counted(conversion.simplices, conversion.simplex_name)));
  if (!conversion.note.empty()) table.add("voxels", conversion.note);
  phases.tell(json, table);
  add_written(table, {command.out});
  print_report(json, table, command.json, command.quiet, {command.out});
}

}  // namespace

void add_convert_command(CLI::App& tool, Action& action) {
  auto command = std::make_shared<ConvertCommand>();
  CLI::App& app = *tool.add_subcommand(
      "convert", "Writes a surface, solid, level set, wireframe or cloud in another format");
  app.add_option("INPUT", command->input, input_help)->type_name("FILE")->required();
  app.add_option("OUT", command->out,
                 "by extension: a surface .obj .off .ply .stl .glb .gltf .vtu .vtk, a solid\n"
                 ".node .ele .mesh .msh .vtu .vtk, a level set .vdb, a wireframe .obj .edges\n"
                 ".vtu .vtk .glb, a cloud .xyz .ply. A surface is filled where only solids fit,\n"
                 "and of a solid the boundary is taken where only surfaces fit")
      ->type_name("OUT")
      ->required();
  app.add_option("--as", command->as, as_help)->type_name("KIND");
  app.add_flag("--json", command->json, "print the summary as one JSON object");
  app.add_flag("--quiet,-q", command->quiet, "no summary or progress; errors stay");
  add_fill_options(app, command->fill);
  app.footer(
      "Examples:\n"
      "  plexway convert scan.stl scan.glb\n"
      "  plexway convert broken.stl clean.ply --repair --voxel 0.01\n"
      "  plexway convert organ.off organ.vdb --voxel 0.02\n"
      "  plexway convert fluid.vdb fluid.obj --grid surface\n"
      "  plexway convert fluid.vdb fluid.vtu\n"
      "  plexway convert organ.off organ.mesh --max-volume 1e-3\n"
      "  plexway convert organ.vtu organ.stl");
  app.callback([command, &action] { action = [command] { run_convert(*command); }; });
}

}  // namespace plexway::cli
