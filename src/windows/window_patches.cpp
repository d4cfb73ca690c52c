#include "windows/window_patches.hpp"

#include <cstdint>

#include "labels/pieces/triangle_patches.hpp"

namespace plexway::detail::windows {
namespace {

template <class Real>
Cut cut_of(const TriangleMesh<Real>& mesh, std::size_t size) {
  Partition partition = partition_of(mesh, size);
  // Only what lies around a vertex of several pieces can be a ghost.
  std::vector<Index> piece(mesh.vertex_count(), none);
  std::vector<std::uint8_t> is_shared(mesh.vertex_count(), 0);
  const auto triangles = mesh.triangles();
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (const Index v : triangles[f].corner) {
      if (piece[v] == none) piece[v] = partition.piece_of[f];
      if (piece[v] != partition.piece_of[f]) is_shared[v] = 1;
    }
  std::vector<Index> corners;
  return cut(std::move(partition), [&](Index f, const auto& visit) {
    for (const Index v : triangles[f].corner) {
      if (is_shared[v] == 0) continue;
      mesh.corners_at(v, corners);
      for (const Index c : corners) visit(c / 3);
    }
  });
}

}  // namespace

template <class Real>
WindowPatches<Real>::WindowPatches(const TriangleMesh<Real>& mesh, const VertexAngles& angles,
                                   std::size_t size, Deal deal)
    : mesh_(mesh),
      size_(size),
      deal_(deal),
      cut_(cut_of(mesh, size)),
      patches_(cut_.pieces.size()) {
  const auto triangles = mesh.triangles();
  std::vector<Index> last(mesh.vertex_count(), none);  // piece that a vertex was seen in
  for (Index p = 0; p < patches_.size(); ++p) {
    if (!deal.is_ours(p)) continue;
    const CutPiece& piece = cut_.pieces[p];
    for (std::size_t i = 0; i < piece.own; ++i)
      for (const Index v : triangles[piece.simplices[i]].corner) last[v] = p;
    patches_[p].triangles = piece_records(mesh, cut_, p, [&](Index f, std::size_t e) {
      return last[triangles[f].corner[e]] == p || last[triangles[f].corner[edge_after(e)]] == p;
    });
  }
  number_vertices(mesh, cut_, patches_);
  place_begin_.assign(mesh.vertex_count() + 1, 0);
  for (Index p = 0; p < patches_.size(); ++p) {
    Patch& patch = patches_[p];
    for (const Index v : patch.vertices) ++place_begin_[v + 1];
    if (!deal.is_ours(p)) continue;
    patch.angles.excess.reserve(patch.vertices.size());
    patch.angles.kind.reserve(patch.vertices.size());
    for (const Index v : patch.vertices) {
      patch.angles.excess.push_back(angles.excess[v]);
      patch.angles.kind.push_back(angles.kind[v]);
    }
  }
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) place_begin_[v + 1] += place_begin_[v];
  places_.resize(place_begin_.back());
  std::vector<Index> at(place_begin_.begin(), place_begin_.end() - 1);
  for (Index p = 0; p < patches_.size(); ++p)
    for (Index i = 0; i < patches_[p].vertices.size(); ++i)
      places_[at[patches_[p].vertices[i]]++] = {p, i};
  for (Index p = 0; p < patches_.size(); ++p)
    if (deal.is_ours(p)) tell_places(p);
}

template <class Real>
void WindowPatches<Real>::tell_places(Index number) {
  const CutPiece& piece = cut_.pieces[number];
  Patch& patch = patches_[number];
  auto& [vertices, triangles, at_home] = patch.addresses;
  vertices.end();
  for (std::size_t i = 0; i < patch.shared; ++i) {
    for (const Place& place : places(patch.vertices[i]))
      if (place.piece != number)
        vertices.places.push_back({static_cast<Index>(piece.place_of(place.piece)), place.number});
    vertices.end();
  }
  std::vector<std::vector<Place>> ghosts(piece.at_cut);
  for (Index peer = 0; peer < piece.peer_count(); ++peer)
    for (const auto& [here, there] : piece.slots_of(peer)) ghosts[here].push_back({peer, there});
  triangles.end();
  for (const auto& list : ghosts) {
    triangles.places.insert(triangles.places.end(), list.begin(), list.end());
    triangles.end();
  }
  for (std::size_t i = piece.own; i < piece.simplices.size(); ++i) {
    const Index f = piece.simplices[i];
    at_home.push_back({static_cast<Index>(piece.place_of(cut_.piece_of[f])), cut_.number_of[f]});
  }
}

template <class Real>
Sheet<Real> WindowPatches<Real>::sheet(Index piece) const {
  const Patch& patch = patches_[piece];
  return {.mesh = &mesh_,
          .angles = &patch.angles,
          .triangles = patch.triangles,
          .own = static_cast<Index>(cut_.pieces[piece].own),
          .vertex_count = static_cast<Index>(patch.vertices.size()),
          .shared = static_cast<Index>(patch.shared),
          .cut = &cut_,
          .piece = piece,
          .vertices = patch.vertices};
}

template <class Real>
std::size_t WindowPatches<Real>::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  std::size_t sum = cut_.bytes() + of(patches_) + of(place_begin_) + of(places_);
  for (const Patch& patch : patches_)
    sum +=
        of(patch.triangles) + of(patch.vertices) + patch.angles.bytes() + patch.addresses.bytes();
  return sum;
}

template class WindowPatches<float>;
template class WindowPatches<double>;

}  // namespace plexway::detail::windows
