#include "shape/make_complex.hpp"

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>

#include <plexway/error.hpp>

#include "complexes/common/nearby.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
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
  Adding(const MixedShape& shape, std::span<const double> speeds, MixedPieces<Real>& made)
      : shape_(shape), speeds_(speeds), made_(made) {}

  /// The next simplices of the shape: a piece for each speed.
  template <std::size_t N>
  void add(std::size_t part, const std::vector<std::array<Index, N>>& simplices) {
    std::map<double, std::vector<Index>> of_speed;
    for (Index s = 0; s < simplices.size(); ++s)
      of_speed[speeds_.empty() ? 1 : speeds_[made_.simplex.size() + s]].push_back(s);
    const std::size_t first = made_.simplex.size();
    made_.simplex.resize(first + simplices.size());
    for (const auto& [speed, numbers] : of_speed)
      add_piece<N>(part, first, simplices, numbers, speed);
  }

 private:
  template <std::size_t N>
  void add_piece(std::size_t part, std::size_t first,
                 const std::vector<std::array<Index, N>>& simplices,
                 const std::vector<Index>& numbers, double speed) {
    std::vector<Index> inner(shape_.positions.size(), none);
    std::vector<std::array<Index, N>> own;
    for (const Index s : numbers) {
      own.push_back(simplices[s]);
      for (const Index v : simplices[s]) inner[v] = 0;
    }
    Added piece{part, {}};
    std::vector<std::array<double, 3>> positions, timed;
    for (Index v = 0; v < inner.size(); ++v) {
      if (inner[v] == none) continue;
      inner[v] = static_cast<Index>(piece.outer.size());
      piece.outer.push_back(v);
      const auto& p = shape_.positions[v];
      positions.push_back(p);
      timed.push_back({p[0] / speed, p[1] / speed, p[2] / speed});
    }
    for (auto& row : own)
      for (Index& v : row) v = inner[v];
    const auto at = made_.complex.add(typename ComplexOf<Real, N>::Type(timed, own), positions);
    for (Index v = 0; v < piece.outer.size(); ++v)
      if (made_.vertex[piece.outer[v]] == none) made_.vertex[piece.outer[v]] = at.vertex(v);
    for (Index s = 0; s < own.size(); ++s) made_.simplex[first + numbers[s]] = at.simplex(s);
    weld(piece);
    pieces_.push_back(std::move(piece));
  }

  // With those there are: by number in its own part, by nearness with other parts.
  void weld(const Added& piece) {
    const auto known = made_.complex.pieces();
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      const Added& other = pieces_[p];
      if (other.part != piece.part) {
        const auto near = near_pairs(other, piece);
        made_.complex.weld(known[p], known.back(), std::span<const std::array<Index, 2>>(near));
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

  // Vertices of two parts that are one. None may be one with two that lie apart: that would shrink
  // what is between them to a point.
  std::vector<std::array<Index, 2>> near_pairs(const Added& a, const Added& b) const {
    const auto places = [&](const Added& of) {
      std::vector<std::array<double, 3>> at;
      for (const Index v : of.outer) at.push_back(shape_.positions[v]);
      return at;
    };
    const auto pairs = nearby_pairs(places(a), places(b), shape_.tolerance);
    const std::array<const Added*, 2> sides = {&a, &b};
    for (const std::size_t side : {0U, 1U}) {
      std::vector<Index> partner(sides[side]->outer.size(), none);
      for (const auto& pair : pairs) {
        const Index v = pair[side], other = sides[1 - side]->outer[pair[1 - side]];
        if (partner[v] == none) partner[v] = other;
        if (shape_.positions[partner[v]] != shape_.positions[other])
          throw UsageError("a tolerance of " + short_number(shape_.tolerance) +
                           " is too large: vertex " + std::to_string(sides[side]->outer[v]) +
                           " would be one with vertices " + std::to_string(partner[v]) + " and " +
                           std::to_string(other) + ", which lie apart");
      }
    }
    return pairs;
  }

  const MixedShape& shape_;
  std::span<const double> speeds_;
  MixedPieces<Real>& made_;
  std::vector<Added> pieces_;
};

}  // namespace

template <class Real>
MixedPieces<Real>::MixedPieces(const MixedShape& shape, std::span<const double> speeds)
    : vertex(shape.positions.size(), none) {
  Adding<Real> adding(shape, speeds, *this);
  for (std::size_t p = 0; p < shape.parts.size(); ++p) {
    adding.add(p, shape.parts[p].edges);
    adding.add(p, shape.parts[p].triangles);
    adding.add(p, shape.parts[p].tets);
  }
}

template struct MixedPieces<float>;
template struct MixedPieces<double>;

}  // namespace plexway::detail
