#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/hinge_neighbours.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/piece_sources.hpp"

namespace plexway {

/// Where labels of a mixed domain start on hinges, at vertices too. They have numbers of their own
/// behind the caller's sources.
///
/// A label that starts on a hinge starts where it is best for one simplex there. What is behind may
/// do better to cross a little farther on: each vertex looks for its own crossing when it is read
/// out, by what the labels on the other side tell.
template <class Real>
class HingeCrossings {
 public:
  using Domain = MixedComplex<Real>;
  using Member = typename Domain::Member;
  using Piece = MixedPiece<Real>;
  using Point = Vector3<Real>;

  struct Crossing {
    Index source, hinge;  // no hinge: a welded vertex, where nothing is to be moved
    std::uint8_t side;    // that the front came from
    Point start;          // in the piece beyond
  };

  HingeCrossings(const Domain& domain, const std::vector<std::unique_ptr<Piece>>& pieces,
                 const HingeNeighbours<Real>& neighbours)
      : domain_(domain), pieces_(pieces), neighbours_(neighbours) {}

  /// `number` is one of the caller's sources: a point of a piece, in the domain's unit.
  void seed(Index piece, const Point& at, Real offset, Index number) {
    first_ = std::max(first_, number + 1);
    sources_.add({piece, number, at, offset});
  }
  /// The number of the next crossing.
  [[nodiscard]] Index next() const { return first_ + static_cast<Index>(crossings_.size()); }
  void add(const Crossing& crossing) {
    crossings_.push_back(crossing);
    crossings_.back().source = root(crossing.source);
    moves_ |= crossing.hinge != none;
  }
  /// The caller's source that a label comes from.
  [[nodiscard]] Index root(Index number) const {
    const Crossing* crossing = find(number);
    return crossing != nullptr ? crossing->source : number;
  }
  /// All crossings are there: vertices may be read out, those of several pieces at once.
  void end() { sources_.sort(); }

  /// Distances and labels of a piece's vertices, in its caller's order.
  void straighten(Index piece, std::span<Real> distance, std::span<Index> label) const {
    if (!moves_) return;
    const auto& own = *pieces_[piece];
    const auto starts = [&](Index number) -> const Point* {
      const Crossing* crossing = on_hinge(number);
      return crossing != nullptr ? &crossing->start : nullptr;
    };
    const auto& complex = domain_.complex(domain_.pieces()[piece]);
    const auto inside = [&](Index v) {
      return std::visit([&](const auto& c) { return c.inside_vertex(v); }, complex);
    };
    std::vector<Index> outside(distance.size());
    for (Index v = 0; v < distance.size(); ++v) outside[inside(v)] = v;
    std::vector<Index> via(distance.size(), none), front;
    for (Index v = 0; v < distance.size(); ++v) {
      const Index number = own.crossing_seen(inside(v), starts);
      if (find(number) != nullptr) {
        via[v] = number;
        if (const Over there = least_by(number, own, inside(v)); there.distance < distance[v])
          distance[v] = there.distance, label[v] = there.source;
        front.push_back(v);
      }
      // Beside a thin fast layer all simplices may have labels that came through that.
      if (own.sees_all())
        take_straight(piece, own.unit() * own.place(inside(v)), distance[v], label[v]);
    }
    // A vertex may be nearer by the way of a neighbour: because none of its simplices came over the
    // hinge, or because the label that it kept was of a way that is longer.
    if (!own.sees_all()) return;
    std::vector<Index> around;
    const std::size_t most = 16 * distance.size();  // some may win by less and less, in turns
    for (std::size_t i = 0; i < front.size() && i < most; ++i) {
      const Index v = front[i], number = via[v];
      own.vertices_around(inside(v), around);
      for (const Index inner : around) {
        const Index w = outside[inner];
        if (via[w] == number) continue;
        const Over there = least_by(number, own, inner);
        if (!(there.distance < distance[w] * (1 - Piece::crossing_gain))) continue;
        via[w] = number;
        distance[w] = there.distance;
        label[w] = there.source;
        front.push_back(w);
      }
    }
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  /// A path over a hinge: from what a label knows to a target.
  struct Over {
    Real distance = infinity;
    HingePlace<Real> place = {0, 0};
    int rims = 0;         // of the hinge that the crossing lies on: a neighbour may be better
    Index source = none;  // of that label
  };

  // From the sources in the piece itself, if they are few.
  void take_straight(Index piece, const Point& at, Real& distance, Index& label) const {
    const auto [first, last] = sources_.few_or(piece, label);
    for (auto source = first; source != last; ++source) {
      const Real length = source->offset + norm(at - source->at);
      if (length < distance * (1 - Piece::crossing_gain)) distance = length, label = source->number;
    }
  }

  [[nodiscard]] const Crossing* find(Index number) const {
    return number == none || number < first_ ? nullptr : &crossings_[number - first_];
  }
  // One that may be moved.
  [[nodiscard]] const Crossing* on_hinge(Index number) const {
    const Crossing* crossing = find(number);
    return crossing == nullptr || crossing->hinge == none ? nullptr : crossing;
  }

  // The shortest path to a vertex near to a crossing, on its hinge or a neighbour's, by what labels
  // know; as far as the vertex sees it.
  [[nodiscard]] Over least_by(Index number, const Piece& own, Index vertex) const {
    const Crossing* crossing = on_hinge(number);
    if (crossing == nullptr) return {};
    Index hinge = crossing->hinge;
    const std::size_t side = crossing->side;
    const Point target = own.place(vertex);
    Over over = way_over(hinge, side, target);
    constexpr int most = 64;
    for (int steps = 0; steps < most && over.rims > 0; ++steps) {
      Index better = none;
      // At an end of the hinge: another one there may be better that shares no edge with it.
      for (const Index other :
           over.rims > 1 ? neighbours_.over_vertices(hinge) : neighbours_.over_edges(hinge))
        if (const Over there = way_over(other, side, target); there.distance < over.distance)
          over = there, better = other;
      if (better == none) break;
      hinge = better;
    }
    if (!own.sees_all() && !in_sight(hinge, side, over.place, own, vertex)) return {};
    over.source = root(over.source);
    return over;
  }
  [[nodiscard]] bool in_sight(Index n, std::size_t side, const HingePlace<Real>& place,
                              const Piece& own, Index vertex) const {
    const auto& hinge = domain_.hinges()[n];
    for (Index m = hinge.begin[1 - side]; m < hinge.end[1 - side]; ++m)
      if (own.sees(domain_.members()[m], hinge.dimension, place, vertex)) return true;
    return false;
  }

  [[nodiscard]] Over way_over(Index n, std::size_t side, const Point& target) const {
    const auto& hinge = domain_.hinges()[n];
    const Piece& from = *pieces_[hinge.piece[side]];
    const Piece& to = *pieces_[hinge.piece[1 - side]];
    const Member& beyond = domain_.members()[hinge.begin[1 - side]];
    const HingeShape<Real> shape = to.shape(beyond, hinge.dimension);
    const HingeEnd<Real> end = to.pose(beyond, hinge.dimension, target);
    Over least;
    for (Index m = hinge.begin[side]; m < hinge.end[side]; ++m) {
      const Member& member = domain_.members()[m];
      if (!(from.distance(member.simplex) < infinity)) continue;
      const HingeFront<Real> front(from, member, hinge.dimension, none, none);
      const auto path = front.shortest(shape, end);
      if (!(path.extent < least.distance)) continue;
      least = {path.extent, path.crossing, 0, front.seen_from(path.crossing).source};
    }
    constexpr Real rim = 16 * std::numeric_limits<Real>::epsilon();
    const HingePlace<Real>& b = least.place;
    least.rims = (b[0] <= rim) + (b[1] <= rim) + (1 - b[0] - b[1] <= rim);
    return least;
  }

  const Domain& domain_;
  const std::vector<std::unique_ptr<Piece>>& pieces_;
  const HingeNeighbours<Real>& neighbours_;
  Index first_ = 0;
  bool moves_ = false;  // is any on a hinge?
  std::vector<Crossing> crossings_;
  PieceSources<Point, Real> sources_;
};

}  // namespace plexway
