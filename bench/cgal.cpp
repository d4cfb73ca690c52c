// What `peers` has in bench_cgal besides, CGAL's exact shortest paths (Xin and Wang's) and its heat
// method; and `truth`, which writes the exact answers NAME.vID.txt beside surfaces, for `plexway
// tune` and `plexway bench`. What comes out is checked before it is believed: never shorter than
// the straight line through space, never longer than a path that plexway has found. CGAL is under
// the GPL: it stays in this folder, and nothing that is installed touches it.

#ifdef PLEXWAY_HAS_EIGEN
#define CGAL_EIGEN3_ENABLED 1
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <vector>

#include "peers.hpp"
#include "solver.hpp"

namespace bench::cgal {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Paths =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

/// From the sources that were added to all vertices; infinite where no path leads.
inline std::vector<double> all_distances(const Mesh& mesh, Paths& paths) {
  paths.build_sequence_tree();
  std::vector<double> all;
  for (const auto v : mesh.vertices()) {
    const double found = paths.shortest_distance_to_source_points(v).first;
    all.push_back(found < 0 ? std::numeric_limits<double>::infinity() : found);
  }
  return all;
}

// CGAL's vertices keep our numbers. It works on halfedges of an oriented manifold without loose
// vertices and does not check: what is none is refused here.
inline Mesh make_mesh(const Surface& surface) {
  Mesh mesh;
  const auto vertex = [](Index v) { return Mesh::Vertex_index(v); };
  for (const auto& p : surface.positions) mesh.add_vertex({p[0], p[1], p[2]});
  for (const auto& [a, b, c] : surface.faces)
    if (mesh.add_face(vertex(a), vertex(b), vertex(c)) == Mesh::null_face())
      throw std::runtime_error("not an oriented manifold");
  for (const auto v : mesh.vertices())
    if (mesh.is_isolated(v)) throw std::runtime_error("a vertex without a face");
  if (!mesh.is_valid(false)) throw std::runtime_error("not a valid halfedge mesh");
  return mesh;
}

class ExactPaths final : public Peer {
 public:
  explicit ExactPaths(const Surface& surface) : mesh_(make_mesh(surface)), paths_(mesh_) {}

  void solve(Index source) override {
    paths_.remove_all_source_points();
    paths_.add_source_point(Mesh::Vertex_index(source));
    distance_ = all_distances(mesh_, paths_);
  }
  [[nodiscard]] std::vector<double> distance() const override { return distance_; }

 private:
  Mesh mesh_;
  Paths paths_;
  std::vector<double> distance_;
};

// ---- Peers ----

#ifdef PLEXWAY_HAS_EIGEN
class Heat final : public Peer {
  using Method = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<
      Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay>;

 public:
  explicit Heat(const Surface& surface)
      : mesh_(make_mesh(surface)),
        found_(mesh_.add_property_map<Mesh::Vertex_index, double>("v:distance", 0).first),
        method_(mesh_) {}  // factorises its matrices

  void solve(Index source) override {
    method_.clear_sources();
    method_.add_source(Mesh::Vertex_index(source));
    method_.estimate_geodesic_distances(found_);
  }
  [[nodiscard]] std::vector<double> distance() const override {
    return {found_.begin(), found_.end()};
  }

 private:
  Mesh mesh_;
  Mesh::Property_map<Mesh::Vertex_index, double> found_;
  Method method_;
};
#endif

const bool added = [] {
#ifdef PLEXWAY_HAS_EIGEN
  peer_kinds().push_back({"CGAL heat, intrinsic Delaunay", false,
                          [](const Surface& surface) { return std::make_unique<Heat>(surface); }});
#endif
  peer_kinds().push_back(
      {"CGAL exact paths", false,
       [](const Surface& surface) { return std::make_unique<ExactPaths>(surface); }, true});
  return true;
}();

// ---- Exact answers ----

void check(const Surface& surface, Index source, const std::vector<double>& exact) {
  plexway::PropagateOptions options = one_label();
  options.visibility = plexway::Visibility::upper_bound;
  const plexway::TriangleMesh<double> mesh(surface.positions, surface.faces);
  const auto longest = distances(mesh, plexway::PointSource::at(source), options);
  const auto& from = surface.positions[source];
  for (std::size_t v = 0; v < exact.size(); ++v) {
    const auto& to = surface.positions[v];
    const double straight = std::hypot(to[0] - from[0], to[1] - from[1], to[2] - from[2]);
    if (exact[v] < straight * (1 - 1e-9) || exact[v] > longest[v] * (1 + 1e-9) + 1e-12)
      throw std::runtime_error("vertex " + std::to_string(v) + " from " + std::to_string(source) +
                               ": " + std::to_string(exact[v]) + " is not between " +
                               std::to_string(straight) + " and " + std::to_string(longest[v]));
  }
}

void write(const std::filesystem::path& file, const std::vector<double>& exact) {
  std::string text;
  for (const double d : exact) {
    char line[40];
    std::snprintf(line, sizeof line, "%.12g\n", d);
    text += line;
  }
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error("cannot write " + file.string());
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  std::size_t sources = 2;
  arguments.required("MESH", &meshes, "Surfaces (.obj .off .ply .stl)");
  arguments.positive("--sources", &sources, "Sources a surface, spread out and always the same");
  arguments.add_limit(300);
  arguments.parse();
  bool all = true;
  for (const std::filesystem::path file : meshes) {
    const Row done = isolated(arguments.limit, [&]() -> Row {
      const Surface surface = read_surface(file);
      ExactPaths paths(surface);
      for (const Index source : rotating_sources(surface, sources)) {
        paths.solve(source);
        check(surface, source, paths.distance());
        write(file.parent_path() / (surface.name + ".v" + std::to_string(source) + ".txt"),
              paths.distance());
      }
      return {{"vertices", surface.positions.size()}};
    });
    const Value* note = done.find("note");
    all = all && note == nullptr;
    std::cerr << file.string() << ": " << (note != nullptr ? note->text() : "done") << std::endl;
  }
  if (!all) throw Exit(1, "not all surfaces have answers");
}
const Command command("truth", "writes exact answers beside surfaces", run);

}  // namespace bench::cgal
