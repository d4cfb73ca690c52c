#include <algorithm>
#include <cmath>
#include <string>

#include <plexway/boost_graph/edge_graph.hpp>
#include <plexway/error.hpp>

#include "complexes/common/arrays.hpp"

namespace plexway::boost_graph {
using namespace detail;
namespace {

// Of the halfedges on an edge, the lowest speaks for it.
template <class Triangles>
bool lowest_on_edge(Triangles triangles, Index f, Index i) {
  const Index boundary = static_cast<Index>(triangles.size() - 1), own = 4 * f + i;
  const auto next = [&](Index g, Index k) {
    const Index across = triangles[g].across[k], h = across >> Across::face_shift;
    return h == boundary ? own : 4 * h + (across & Across::edge_mask);
  };
  for (Index h = next(f, i); h != own; h = next(h / 4, h % 4))
    if (h < own) return false;
  return true;
}

}  // namespace

EdgeGraph::EdgeGraph(std::size_t vertices, std::span<const std::array<Index, 2>> edges,
                     std::span<const double> lengths)
    : edges_(edges.begin(), edges.end()), lengths_(lengths.begin(), lengths.end()) {
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  if (edges.size() > none / 2) throw InputError("more than 2147483647 edges");
  if (edges.size() != lengths.size())
    throw InputError(std::to_string(edges.size()) + " edges with " +
                     std::to_string(lengths.size()) + " lengths");
  for (std::size_t e = 0; e < edges.size(); ++e) {
    for (const Index v : edges[e])
      if (v >= vertices)
        throw InputError("edge " + std::to_string(e) + ": vertex " + std::to_string(v) +
                         " is out of range, there are " + std::to_string(vertices));
    if (!std::isfinite(lengths[e]) || lengths[e] < 0)
      throw InputError("edge " + std::to_string(e) + ": its length is negative or not finite");
  }
  assemble(vertices);
}

template <class Real>
EdgeGraph::EdgeGraph(const Wireframe<Real>& wireframe) {
  const std::vector<Index> outside = vertices_outside(wireframe);
  for (Index e = 0; e < wireframe.edge_count(); ++e) {
    const auto ends = wireframe.inside_edge(e);
    edges_.push_back({outside[ends.from], outside[ends.to]});
    lengths_.push_back(static_cast<double>(ends.length) * wireframe.unit());
  }
  assemble(wireframe.vertex_count());
}

template <class Real>
EdgeGraph::EdgeGraph(const TriangleMesh<Real>& mesh) {
  const std::vector<Index> outside = vertices_outside(mesh);
  const auto triangles = mesh.triangles();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index i = 0; i < 3; ++i) {
      if (!lowest_on_edge(triangles, f, i)) continue;
      const auto& t = triangles[f];
      edges_.push_back({outside[t.corner[i]], outside[t.corner[(i + 1) % 3]]});
      lengths_.push_back(static_cast<double>(t.length[i]) * mesh.unit());
    }
  assemble(mesh.vertex_count());
}

template <class Real>
EdgeGraph::EdgeGraph(const TetMesh<Real>& mesh) {
  const std::vector<Index> outside = vertices_outside(mesh);
  std::vector<std::array<Index, 4>> found;  // ends, and where the length is
  for (Index t = 0; t < mesh.tet_count(); ++t)
    for (Index e = 0; e < 6; ++e) {
      const Index a = outside[mesh.tets()[t].corner[tet_edge_ends[e][0]]];
      const Index b = outside[mesh.tets()[t].corner[tet_edge_ends[e][1]]];
      found.push_back({std::min(a, b), std::max(a, b), t, e});
    }
  std::sort(found.begin(), found.end());
  for (const auto& [a, b, t, e] : found) {
    if (!edges_.empty() && edges_.back() == std::array<Index, 2>{a, b}) continue;
    edges_.push_back({a, b});
    const auto& corner = mesh.tets()[t].corner;
    const double length = mesh.embedded()
                              ? norm(mesh.points()[corner[tet_edge_ends[e][1]]] -
                                     mesh.points()[corner[tet_edge_ends[e][0]]])
                              : std::sqrt(static_cast<double>(mesh.squared_lengths()[t][e]));
    lengths_.push_back(length * mesh.unit());
  }
  assemble(mesh.vertex_count());
}

void EdgeGraph::assemble(std::size_t vertices) {
  begin_.assign(vertices + 1, 0);
  for (const auto& [a, b] : edges_) {
    ++begin_[a + 1];
    if (a != b) ++begin_[b + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) begin_[v + 1] += begin_[v];
  arcs_.resize(begin_[vertices]);
  std::vector<Index> end(begin_.begin(), begin_.end() - 1);  // of the row as filled so far
  for (Index e = 0; e < edges_.size(); ++e) {
    const auto [a, b] = edges_[e];
    arcs_[end[a]++] = {b, e};
    if (a != b) arcs_[end[b]++] = {a, e};
  }
}

template EdgeGraph::EdgeGraph(const Wireframe<float>&);
template EdgeGraph::EdgeGraph(const Wireframe<double>&);
template EdgeGraph::EdgeGraph(const TriangleMesh<float>&);
template EdgeGraph::EdgeGraph(const TetMesh<float>&);
template EdgeGraph::EdgeGraph(const TetMesh<double>&);
template EdgeGraph::EdgeGraph(const TriangleMesh<double>&);

}  // namespace plexway::boost_graph
