#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <string>

#include <plexway/boost_graph/graph.hpp>
#include <plexway/error.hpp>

namespace plexway::boost_graph {
namespace {

// `join_all(join)` calls join(a, b) for pairs that belong together; `number(v)` is what the pairs
// call the caller's vertex v.
template <class JoinAll, class Number>
Components components_by(std::size_t vertices, JoinAll join_all, Number number) {
  std::vector<Index> parent(vertices), rank(vertices, 0);
  std::iota(parent.begin(), parent.end(), Index{0});
  boost::disjoint_sets<Index*, Index*> sets(rank.data(), parent.data());
  join_all([&](Index a, Index b) { sets.union_set(a, b); });

  Components found;
  found.of_vertex.resize(vertices);
  std::vector<Index> name(vertices, none);  // of the component with this root
  for (Index v = 0; v < vertices; ++v) {
    Index& component = name[sets.find_set(number(v))];
    if (component == none) component = static_cast<Index>(found.count++);
    found.of_vertex[v] = component;
  }
  return found;
}

template <std::size_t N>
Components components_of(std::size_t vertices, std::span<const std::array<Index, N>> simplices) {
  if (vertices >= none) throw InputError("more than 4294967294 vertices");
  for (std::size_t s = 0; s < simplices.size(); ++s)
    for (const Index v : simplices[s])
      if (v >= vertices)
        throw InputError("simplex " + std::to_string(s) + ": vertex " + std::to_string(v) +
                         " is out of range, there are " + std::to_string(vertices));
  return components_by(
      vertices,
      [&](auto join) {
        for (const auto& simplex : simplices)
          for (std::size_t i = 1; i < N; ++i) join(simplex[0], simplex[i]);
      },
      [](Index v) { return v; });
}

}  // namespace

Components connected_components(std::size_t vertices, std::span<const std::array<Index, 2>> edges) {
  return components_of(vertices, edges);
}

Components connected_components(std::size_t vertices,
                                std::span<const std::array<Index, 3>> triangles) {
  return components_of(vertices, triangles);
}

Components connected_components(std::size_t vertices, std::span<const std::array<Index, 4>> tets) {
  return components_of(vertices, tets);
}

template <class Real>
Components connected_components(const Wireframe<Real>& wireframe) {
  return components_by(
      wireframe.vertex_count(),
      [&](auto join) {
        const auto begin = wireframe.begin();
        for (Index v = 0; v < wireframe.vertex_count(); ++v)
          for (Index k = begin[v]; k < begin[v + 1]; ++k)
            if (wireframe.arcs()[k].to < v) join(v, wireframe.arcs()[k].to);
      },
      [&](Index v) { return wireframe.inside_vertex(v); });
}

template <class Real>
Components connected_components(const TriangleMesh<Real>& mesh) {
  return components_by(
      mesh.vertex_count(),
      [&](auto join) {
        for (const auto& t : mesh.triangles().first(mesh.face_count())) {
          join(t.corner[0], t.corner[1]);
          join(t.corner[0], t.corner[2]);
        }
      },
      [&](Index v) { return mesh.inside_vertex(v); });
}

template <class Real>
Components connected_components(const TetMesh<Real>& mesh) {
  return components_by(
      mesh.vertex_count(),
      [&](auto join) {
        for (const auto& t : mesh.tets().first(mesh.tet_count()))
          for (std::size_t i = 1; i < 4; ++i) join(t.corner[0], t.corner[i]);
      },
      [&](Index v) { return mesh.inside_vertex(v); });
}

template Components connected_components(const TetMesh<float>&);
template Components connected_components(const TetMesh<double>&);
template Components connected_components(const Wireframe<float>&);
template Components connected_components(const Wireframe<double>&);
template Components connected_components(const TriangleMesh<float>&);
template Components connected_components(const TriangleMesh<double>&);

}  // namespace plexway::boost_graph
