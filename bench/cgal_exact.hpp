#pragma once

// CGAL's exact shortest paths (Xin and Wang's). CGAL is under the GPL: it stays in this folder.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <limits>
#include <stdexcept>
#include <vector>

#include "peers.hpp"

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

}  // namespace bench::cgal
