#include "any/mixed_domain.hpp"

#include <array>
#include <span>
#include <utility>

namespace plexway {
namespace {

/// A piece, and which of the shape's vertices it has.
struct Added {
  std::size_t part;
  std::vector<Index> outer;  // ascending
};

template <class Real, std::size_t N>
struct ComplexOf;
template <class Real>
struct ComplexOf<Real, 2> {
  using Type = Wireframe<Real>;
};
template <class Real>
struct ComplexOf<Real, 3> {
  using Type = TriangleMesh<Real>;
};
template <class Real>
struct ComplexOf<Real, 4> {
  using Type = TetMesh<Real>;
};

template <class Real>
class Adding {
 public:
  Adding(const MixedShape& shape, MixedPieces<Real>& made) : shape_(shape), made_(made) {}

  template <std::size_t N>
  void add(std::size_t part, const std::vector<std::array<Index, N>>& simplices) {
    if (simplices.empty()) return;
    std::vector<Index> inner(shape_.positions.size(), none);
    for (const auto& row : simplices)
      for (const Index v : row) inner[v] = 0;
    Added piece{part, {}};
    std::vector<std::array<double, 3>> positions;
    for (Index v = 0; v < inner.size(); ++v) {
      if (inner[v] == none) continue;
      inner[v] = static_cast<Index>(piece.outer.size());
      piece.outer.push_back(v);
      positions.push_back(shape_.positions[v]);
    }
    std::vector<std::array<Index, N>> own = simplices;
    for (auto& row : own)
      for (Index& v : row) v = inner[v];
    const auto at = made_.complex.add(typename ComplexOf<Real, N>::Type(positions, own), positions);
    for (Index v = 0; v < piece.outer.size(); ++v)
      if (made_.vertex[piece.outer[v]] == none) made_.vertex[piece.outer[v]] = at.vertex(v);
    for (Index s = 0; s < own.size(); ++s) made_.simplex.push_back(at.simplex(s));
    weld(piece);
    pieces_.push_back(std::move(piece));
  }

 private:
  // With those there are: by number in its own part, by nearness with other parts.
  void weld(const Added& piece) {
    const auto known = made_.complex.pieces();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Added& other = pieces_[p];
      if (other.part != piece.part) {
        made_.complex.weld(known[p], known.back(), {.tolerance = shape_.tolerance});
        continue;
      }
      std::vector<std::array<Index, 2>> pairs;
      for (Index a = 0, b = 0; a < other.outer.size() && b < piece.outer.size();) {
        if (other.outer[a] == piece.outer[b])
          pairs.push_back({a++, b++});
        else
          other.outer[a] < piece.outer[b] ? ++a : ++b;
      }
      made_.complex.weld(known[p], known.back(), std::span<const std::array<Index, 2>>(pairs));
    }
  }

  const MixedShape& shape_;
  MixedPieces<Real>& made_;
  std::vector<Added> pieces_;
};

}  // namespace

template <class Real>
MixedPieces<Real>::MixedPieces(const MixedShape& shape) : vertex(shape.positions.size(), none) {
  Adding<Real> adding(shape, *this);
  for (std::size_t p = 0; p < shape.parts.size(); ++p) {
    adding.add(p, shape.parts[p].edges);
    adding.add(p, shape.parts[p].triangles);
    adding.add(p, shape.parts[p].tets);
  }
}

template struct MixedPieces<float>;
template struct MixedPieces<double>;

}  // namespace plexway
