#include <plexway/mixed/mixed_complex.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

#include <plexway/domain/support.hpp>
#include <plexway/error.hpp>

#include "complexes/common/nearby.hpp"
#include "complexes/mixed/joined_pieces.hpp"
#include "complexes/solid/shared_faces.hpp"

namespace plexway {
using namespace detail;

template <class Real>
Index MixedComplex<Real>::Piece::vertex(Index of_piece) const {
  if (of_piece >= vertices)
    throw UsageError("piece " + std::to_string(number) + " has no vertex " +
                     std::to_string(of_piece) + ", there are " + std::to_string(vertices));
  return first_vertex + of_piece;
}

template <class Real>
Index MixedComplex<Real>::Piece::simplex(Index of_piece) const {
  if (of_piece >= simplices)
    throw UsageError("piece " + std::to_string(number) + " has no simplex " +
                     std::to_string(of_piece) + ", there are " + std::to_string(simplices));
  return first_simplex + of_piece;
}

template <class Real>
typename MixedComplex<Real>::Piece MixedComplex<Real>::add(Complex complex,
                                                           const GivenPoints& positions) {
  std::visit([](const auto& c) { support_of_piece(c.kind, c.metric()).require(); }, complex);
  const std::size_t vertices = std::visit([](const auto& c) { return c.vertex_count(); }, complex);
  const std::size_t simplices = std::visit(
      [](const auto& c) {
        if constexpr (requires { c.face_count(); })
          return c.face_count();
        else if constexpr (requires { c.tet_count(); })
          return c.tet_count();
        else
          return c.edge_count();
      },
      complex);
  if (!positions.empty() && positions.size() != vertices)
    throw UsageError("a piece of " + std::to_string(vertices) + " vertices came with " +
                     std::to_string(positions.size()) + " positions");
  if (summary_.vertices + vertices >= none || summary_.simplices + simplices >= none)
    throw UsageError("a mixed domain holds at most 2^32 - 2 vertices and simplices");
  is_joined_ = false;
  space_ = {};
  pieces_.push_back({static_cast<Index>(pieces_.size()), static_cast<Index>(summary_.vertices),
                     static_cast<Index>(vertices), static_cast<Index>(summary_.simplices),
                     static_cast<Index>(simplices)});
  complexes_.push_back(std::move(complex));
  positions_.emplace_back(positions.begin(), positions.end());
  ++summary_.pieces;
  summary_.vertices += vertices;
  summary_.simplices += simplices;
  return pieces_.back();
}

template <class Real>
void MixedComplex<Real>::check(const Piece& a, const Piece& b) const {
  for (const Piece& p : {a, b})
    if (p.number >= pieces_.size() || pieces_[p.number].first_vertex != p.first_vertex ||
        pieces_[p.number].vertices != p.vertices)
      throw UsageError("this piece is not of this domain");
  if (a.number == b.number) throw UsageError("a piece cannot be welded to itself");
}

template <class Real>
std::size_t MixedComplex<Real>::weld(const Piece& a, const Piece& b, const WeldOptions& options) {
  check(a, b);
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw UsageError("the tolerance of a weld must be a number >= 0");
  for (const Piece& p : {a, b})
    if (positions_[p.number].empty())
      throw UsageError("piece " + std::to_string(p.number) +
                       " came without positions: weld it by pairs of vertices");
  return weld(a, b, nearby_pairs(positions_[a.number], positions_[b.number], options.tolerance));
}

template <class Real>
std::size_t MixedComplex<Real>::weld(const Piece& a, const Piece& b,
                                     std::span<const std::array<Index, 2>> pairs) {
  check(a, b);
  if (pairs.empty()) return 0;
  const Complex &one = complexes_[a.number], &other = complexes_[b.number];
  std::vector<std::array<Index, 2>> inside;
  for (const auto& [v, w] : pairs) {
    if (v >= a.vertices || w >= b.vertices)
      throw UsageError("cannot weld vertex " + std::to_string(v) + " to vertex " +
                       std::to_string(w) + ": the pieces have " + std::to_string(a.vertices) +
                       " and " + std::to_string(b.vertices));
    inside.push_back({std::visit([v = v](const auto& c) { return c.inside_vertex(v); }, one),
                      std::visit([w = w](const auto& c) { return c.inside_vertex(w); }, other)});
  }
  std::sort(inside.begin(), inside.end());
  inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
  for (const std::size_t side : {0U, 1U}) {
    std::vector<Index> partners((side == 0 ? a : b).vertices, 0);
    for (const auto& pair : inside)
      if (++partners[pair[side]] > 16)
        throw UsageError(
            "a vertex would be welded to more than 16 others: is the tolerance larger than edges?");
  }

  const std::vector<SharedFace> shared = std::visit(
      [&](const auto& c, const auto& d) { return find_shared_faces(c, d, inside); }, one, other);
  std::vector<char> alone(inside.size(), 1);  // in no shared edge
  for (const SharedFace& face : shared) {
    for (const Index p : face.pairs)
      if (p != none) alone[p] = 0;
    if (face.inner) continue;
    const SharedMember &m = face.members[0][0], &n = face.members[1][0];
    hinges_.push_back(
        {face.dimension(), {a.number, b.number}, {{m.simplex, m.corner}, {n.simplex, n.corner}}});
    ++summary_.hinges[face.dimension()];
  }
  for (std::size_t i = 0; i < inside.size(); ++i) {
    welds_.push_back({{a.number, b.number}, {inside[i][0], inside[i][1]}});
    summary_.hinges[0] += alone[i] != 0;
  }
  is_joined_ = false;
  space_ = {};
  for (const auto& [v, w] : pairs) outer_welds_.push_back({a.first_vertex + v, b.first_vertex + w});
  summary_.welded_vertices += inside.size();
  return inside.size();
}

template <class Real>
std::shared_ptr<const JoinedPieces<Real>> MixedComplex<Real>::joined() const {
  static std::mutex one_at_a_time;
  const std::scoped_lock lock(one_at_a_time);
  if (!is_joined_) {
    joined_ = JoinedPieces<Real>::of(*this);
    is_joined_ = true;
  }
  return joined_;
}

template <class Real>
std::size_t MixedComplex<Real>::bytes() const {
  std::size_t sum = hinges_.capacity() * sizeof(Hinge) + welds_.capacity() * sizeof(Weld) +
                    outer_welds_.capacity() * sizeof(outer_welds_[0]);
  for (const Complex& c : complexes_)
    sum += std::visit([](const auto& complex) { return complex.bytes(); }, c);
  for (const auto& p : positions_) sum += p.capacity() * sizeof(p[0]);
  if (is_joined_ && joined_) sum += joined_->bytes();
  return sum + space_.bytes();
}

template class MixedComplex<float>;
template class MixedComplex<double>;

}  // namespace plexway
