// The table of peers with CGAL's in it: its exact shortest paths (Xin and Wang's) and its heat
// method. CGAL is under the GPL: it is a peer here and nothing that is installed touches it.

#ifdef PLEXWAY_HAS_EIGEN
#define CGAL_EIGEN3_ENABLED 1
#endif
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare.hpp"

namespace {

using bench::Index;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

// CGAL's vertices keep our numbers. It works on halfedges of an oriented manifold without loose
// vertices and does not check: what is none is refused here.
Mesh make_mesh(const bench::Surface& surface) {
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

class ExactPaths final : public bench::Peer {
  using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;

 public:
  explicit ExactPaths(const bench::Surface& surface)
      : mesh_(make_mesh(surface)), paths_(mesh_), distance_(surface.positions.size()) {}

  void solve(Index source) override {
    paths_.remove_all_source_points();
    paths_.add_source_point(Mesh::Vertex_index(source));
    paths_.build_sequence_tree();
    for (const auto v : mesh_.vertices()) {
      const double found = paths_.shortest_distance_to_source_points(v).first;
      distance_[v] = found < 0 ? std::numeric_limits<double>::infinity() : found;  // no path
    }
  }
  [[nodiscard]] std::vector<double> distance() const override { return distance_; }

 private:
  Mesh mesh_;
  CGAL::Surface_mesh_shortest_path<Traits> paths_;
  std::vector<double> distance_;
};

#ifdef PLEXWAY_HAS_EIGEN

class Heat final : public bench::Peer {
  using Method = CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<
      Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay>;

 public:
  explicit Heat(const bench::Surface& surface)
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

}  // namespace

int main(int argc, char** argv) {
  auto kinds = bench::common_peers();
#ifdef PLEXWAY_HAS_EIGEN
  kinds.push_back({"CGAL heat, intrinsic Delaunay", false,
                   [](const bench::Surface& surface) { return std::make_unique<Heat>(surface); }});
#endif
  kinds.push_back(
      {"CGAL exact paths", false,
       [](const bench::Surface& surface) { return std::make_unique<ExactPaths>(surface); }, true});
  return bench::compare_peers(argc, argv, kinds);
}
