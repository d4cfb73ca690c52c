#include "labels/pieces/triangle_patches.hpp"

#include <array>
#include <cmath>

#include "complexes/partition/partition.hpp"

namespace plexway::detail {
namespace {

/// Visits the triangles over the edges of one.
template <class Real>
auto neighbours_of(const TriangleMesh<Real>& mesh) {
  return [triangles = mesh.triangles()](Index f, const auto& visit) {
    for (std::size_t e = 0; e < 3; ++e)
      any_over_edge(triangles, f, e, [&](Index g) {
        visit(g);
        return false;
      });
  };
}

/// The middle of each triangle in space; none where not all are known.
template <class Real>
std::vector<std::array<float, 3>> middles(const TriangleMesh<Real>& mesh) {
  const auto places = mesh.positions();
  std::vector<std::array<float, 3>> found;
  if (places.empty()) return found;
  found.resize(mesh.face_count());
  for (std::size_t f = 0; f < found.size(); ++f) {
    const Index(&corner)[3] = mesh.triangles()[f].corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const double sum = places[corner[0]][i] + places[corner[1]][i] + places[corner[2]][i];
      if (!std::isfinite(sum)) return {};
      found[f][i] = static_cast<float>(sum);
    }
  }
  return found;
}

}  // namespace

template <class Real>
Partition partition_of(const TriangleMesh<Real>& mesh, std::size_t size) {
  return partition(mesh.face_count(), size, middles(mesh), neighbours_of(mesh));
}

template <class Real>
TrianglePatches<Real>::TrianglePatches(const TriangleMesh<Real>& mesh, std::size_t size, Deal deal)
    : cut_(detail::cut(partition_of(mesh, size), neighbours_of(mesh))),
      patches_(cut_.pieces.size()) {
  deal.each(count(), [&](std::size_t p) { take_records(mesh, static_cast<Index>(p)); });
  number_vertices(mesh, cut_, patches_);
}

template <class Real>
void TrianglePatches<Real>::take_records(const TriangleMesh<Real>& mesh, Index number) {
  TrianglePatch<Real>& patch = patches_[number];
  // All triangles over an edge of a ghost are here if one of them is the piece's own.
  patch.triangles = piece_records(mesh, cut_, number, [&](Index f, std::size_t e) {
    return any_over_edge(mesh.triangles(), f, e,
                         [&](Index g) { return cut_.piece_of[g] == number; });
  });
  patch.leads_in =
      leads_in(std::span<const TriangleRecord<Real>>(patch.triangles), cut_.pieces[number].own);
}

template <class Real>
std::size_t TriangleRoom<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return marks.bytes() + front.capacity * 2 * sizeof(Index) + labels.bytes() + of(source) +
         of(posted) + of(is_new) + of(vertex) + of(vertex_source) + mail.bytes();
}

template <class Real>
std::size_t TrianglePatch<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return TriangleRoom<Real>::bytes() + of(triangles) + of(leads_in) + of(vertices);
}

template <class Real>
std::size_t TrianglePatches<Real>::bytes() const {
  std::size_t sum = cut_.bytes() + patches_.capacity() * sizeof(patches_[0]);
  for (const TrianglePatch<Real>& patch : patches_) sum += patch.bytes();
  return sum;
}

template struct TriangleRoom<float>;
template struct TriangleRoom<double>;
template struct TrianglePatch<float>;
template struct TrianglePatch<double>;
template class TrianglePatches<float>;
template class TrianglePatches<double>;
template Partition partition_of(const TriangleMesh<float>&, std::size_t);
template Partition partition_of(const TriangleMesh<double>&, std::size_t);

}  // namespace plexway::detail
