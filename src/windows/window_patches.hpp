#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <plexway/surface/triangle_mesh.hpp>

#include "complexes/partition/cut.hpp"
#include "complexes/partition/deal.hpp"
#include "windows/sheet.hpp"
#include "windows/vertex_angles.hpp"

namespace plexway::detail::windows {
/// A vertex or a triangle of a piece: by the piece's number, or in a patch by its place among the
/// peers.
struct PatchPlace {
  Index piece, number;
};

/// Who else has it, one list after another.
struct Elsewhere {
  std::vector<Index> begin;
  std::vector<PatchPlace> places;
  [[nodiscard]] std::span<const PatchPlace> of(Index i) const {
    return std::span(places).subspan(begin[i], begin[i + 1] - begin[i]);
  }
  /// The list of the next one is through.
  void end() { begin.push_back(static_cast<Index>(places.size())); }
  [[nodiscard]] std::size_t bytes() const {
    return begin.capacity() * sizeof(Index) + places.capacity() * sizeof(PatchPlace);
  }
};

/// What messages of a piece are addressed by, so that posting reads nothing but this.
struct PatchAddresses {
  Elsewhere vertices;               ///< of shared vertices
  Elsewhere triangles;              ///< of own triangles at the cut: as ghosts
  std::vector<PatchPlace> at_home;  ///< of ghosts, where they are a piece's own

  [[nodiscard]] std::size_t bytes() const {
    return vertices.bytes() + triangles.bytes() + at_home.capacity() * sizeof(PatchPlace);
  }
};

/// A surface cut into pieces for windows: ghosts are the triangles that share a vertex with a
/// piece.
template <class Real>
class WindowPatches {
 public:
  using Place = PatchPlace;
  struct Patch {
    std::vector<TriangleRecord<Real>> triangles;
    std::vector<Index> vertices;  ///< of its own triangles: the surface's numbers inside
    std::size_t shared = 0;       ///< so many of them, the first, are other pieces', too
    VertexAngles angles;
    PatchAddresses addresses;
  };

  /// About `size` triangles each. Those that are not ours have vertices alone. `mesh` must outlive
  /// this.
  WindowPatches(const TriangleMesh<Real>& mesh, const VertexAngles& angles, std::size_t size,
                Deal deal);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] Deal deal() const { return deal_; }
  [[nodiscard]] const Cut& cut() const { return cut_; }
  [[nodiscard]] std::size_t count() const { return patches_.size(); }
  [[nodiscard]] const Patch& operator[](std::size_t piece) const { return patches_[piece]; }
  /// The pieces that have a vertex of the surface, in order.
  [[nodiscard]] std::span<const Place> places(Index vertex) const {
    return std::span(places_).subspan(place_begin_[vertex],
                                      place_begin_[vertex + 1] - place_begin_[vertex]);
  }
  /// Refers to this.
  [[nodiscard]] Sheet<Real> sheet(Index piece) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  void tell_places(Index piece);

  const TriangleMesh<Real>& mesh_;
  std::size_t size_;
  Deal deal_;
  Cut cut_;
  std::vector<Patch> patches_;
  std::vector<Index> place_begin_;
  std::vector<Place> places_;
};

extern template class WindowPatches<float>;
extern template class WindowPatches<double>;

}  // namespace plexway::detail::windows
