#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include <plexway/complex/mixed_complex.hpp>

#include "propagate/hinge_neighbours.hpp"
#include "propagate/mixed_piece.hpp"

namespace plexway {

/// Where labels of a mixed domain start on hinges, at vertices too. They have numbers of their own
/// behind the caller's sources.
///
/// A label that starts on a hinge starts where it is best for one simplex there. What is behind may
/// do better to cross a little farther on: each vertex looks for its own crossing when it is read
/// out. If the path to there crossed other hinges before, all its crossings are moved until it is
/// taut.
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

  /// `number` is one of the caller's sources.
  void keep_clear(Index number) { first_ = std::max(first_, number + 1); }
  /// The first number of a crossing, and the next one.
  [[nodiscard]] Index first() const { return first_; }
  [[nodiscard]] Index next() const { return first_ + static_cast<Index>(crossings_.size()); }
  void add(const Crossing& crossing) {
    crossings_.push_back(crossing);
    moves_ |= crossing.hinge != none;
  }
  /// The caller's source that a label comes from.
  [[nodiscard]] Index root(Index number) const {
    const Crossing* crossing = find(number);
    return crossing != nullptr ? crossing->source : number;
  }

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
    std::vector<Via> via(distance.size());
    std::vector<Index> front;
    for (Index v = 0; v < distance.size(); ++v) {
      const Crossing* c = find(own.crossing_seen(inside(v), starts));
      if (c == nullptr) continue;
      via[v] = least_over({c->hinge, c->source, c->side, 0}, own.place(inside(v)));
      if (via[v].distance < distance[v]) distance[v] = via[v].distance, label[v] = c->source;
      front.push_back(v);
    }
    // A vertex none of whose simplices came over the hinge may itself be nearer that way.
    if (!own.sees_all()) return;
    std::vector<Index> around;
    for (std::size_t i = 0; i < front.size(); ++i) {
      const Via from = via[front[i]];
      own.vertices_around(inside(front[i]), around);
      for (const Index inner : around) {
        const Index w = outside[inner];
        if (via[w].hinge != none) continue;
        const Via there = least_over(from, own.place(inner));
        if (!(there.distance < distance[w] * (1 - Piece::bend_loss))) continue;
        via[w] = there;
        distance[w] = via[w].distance;
        label[w] = from.source;
        front.push_back(w);
      }
    }
  }

 private:
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  struct Via {
    Index hinge = none, source = none;
    std::uint8_t side = 0;
    Real distance = 0;
  };
  /// A path over a hinge: from a start or from what a label knows, to a target.
  struct Over {
    Real distance = infinity, before = infinity;  // all, and as far as the hinge
    HingePlace<Real> place = {0, 0};
    int rims = 0;        // of the hinge that the crossing lies on: a neighbour may be better
    Index label = none;  // where the label that knows starts, if that is on a hinge
  };
  struct Step {
    Index hinge;
    std::uint8_t side;
    Over over = {};
  };

  [[nodiscard]] const Crossing* find(Index number) const {
    return number == none || number < first_ ? nullptr : &crossings_[number - first_];
  }
  // One that may be moved.
  [[nodiscard]] const Crossing* on_hinge(Index number) const {
    const Crossing* crossing = find(number);
    return crossing == nullptr || crossing->hinge == none ? nullptr : crossing;
  }

  // The least way over a hinge, from there over its neighbours as long as that is shorter.
  [[nodiscard]] Via least_over(Via via, const Point& target) const {
    constexpr std::size_t most = 6;
    constexpr int rounds = 24;
    constexpr Real gain = sizeof(Real) == 4 ? Real(1e-6) : Real(1e-9);
    std::array<Step, most> path;  // from its end
    std::size_t count = 1;
    path[0] = {via.hinge, via.side, {}};
    move(path[0], target, nullptr);
    via.hinge = path[0].hinge;
    via.distance = path[0].over.distance;
    for (int round = 0; round < rounds; ++round) {
      bool longer = false;
      if (const Crossing* c = find(path[count - 1].over.label); c != nullptr && count < most)
        path[count++] = {c->hinge, c->side, {}}, longer = true;
      if (count == 1) break;
      // Each crossing between its neighbours, from the first on the way to the last.
      Real sum = 0;
      Point start;
      for (std::size_t i = count; i-- > 0;) {
        move(path[i], i == 0 ? target : place_on(path[i - 1], path[i - 1].side),
             i + 1 == count ? nullptr : &start);
        sum += i == 0 ? path[i].over.distance : path[i].over.before;
        start = place_on(path[i], 1 - path[i].side);
      }
      const bool enough = !(sum < via.distance * (1 - gain));
      if (sum < via.distance) via.distance = sum, via.hinge = path[0].hinge;
      if (enough && !longer) break;
    }
    return via;
  }

  // Where a step crosses, as the piece on a side has it.
  [[nodiscard]] Point place_on(const Step& step, std::size_t side) const {
    const auto& hinge = domain_.hinges()[step.hinge];
    return pieces_[hinge.piece[side]]->place(domain_.members()[hinge.begin[side]], hinge.dimension,
                                             step.over.place);
  }

  // To where it is best for a target, on its hinge or a neighbour's.
  void move(Step& step, const Point& target, const Point* start) const {
    step.over = way_over(step.hinge, step.side, target, start);
    for (int steps = 0; steps < 64 && step.over.rims > 0; ++steps) {
      Index better = none;
      // At an end of the hinge: another one there may be better that shares no edge with it.
      for (const Index other : step.over.rims > 1 ? neighbours_.over_vertices(step.hinge)
                                                  : neighbours_.over_edges(step.hinge))
        if (const Over there = way_over(other, step.side, target, start);
            there.distance < step.over.distance)
          step.over = there, better = other;
      if (better == none) break;
      step.hinge = better;
    }
  }

  [[nodiscard]] Over way_over(Index n, std::size_t side, const Point& target,
                              const Point* start) const {
    const auto& hinge = domain_.hinges()[n];
    const Piece& from = *pieces_[hinge.piece[side]];
    const Piece& to = *pieces_[hinge.piece[1 - side]];
    const Member& beyond = domain_.members()[hinge.begin[1 - side]];
    const HingeShape<Real> shape = to.shape(beyond, hinge.dimension);
    const HingeEnd<Real> end = to.pose(beyond, hinge.dimension, target);
    Over least;
    if (start != nullptr) {
      const Member& member = domain_.members()[hinge.begin[side]];
      const HingeEnd<Real> eye = from.pose(member, hinge.dimension, *start);
      const HingeShape<Real> before = from.shape(member, hinge.dimension);
      const HingeFermat<Real> fermat(before, shape, hinge.dimension);
      least.place = fermat.crossing(eye, end);
      least.distance = fermat.way(eye, end, least.place);
      const auto p = before.place(least.place);
      least.before = std::sqrt((p[0] - eye.x) * (p[0] - eye.x) + (p[1] - eye.y) * (p[1] - eye.y) +
                               eye.h * eye.h);
    } else {
      for (Index m = hinge.begin[side]; m < hinge.end[side]; ++m) {
        const Member& member = domain_.members()[m];
        if (!(from.distance(member.simplex) < infinity)) continue;
        const HingeFront<Real> front(from, member, hinge.dimension, none, none);
        const auto path = front.shortest(shape, end);
        if (!(path.extent < least.distance)) continue;
        least = {path.extent, path.before, path.crossing, 0,
                 straight_from(from, member, front.seen_from(path.crossing), hinge.dimension)};
      }
    }
    constexpr Real rim = 16 * std::numeric_limits<Real>::epsilon();
    const HingePlace<Real>& b = least.place;
    least.rims = (b[0] <= rim) + (b[1] <= rim) + (1 - b[0] - b[1] <= rim);
    return least;
  }

  // The crossing that an eye is, if it may be moved: in a piece where all points see each other.
  [[nodiscard]] Index straight_from(const Piece& piece, const Member& member,
                                    const PosedSource<Real>& eye, int dimension) const {
    const Crossing* crossing = on_hinge(eye.source);
    if (crossing == nullptr || !piece.sees_all()) return none;
    const HingeEnd<Real> start = piece.pose(member, dimension, crossing->start);
    const Real size = Real(1e-4) * piece.shape(member, dimension).length;
    const bool same = std::abs(start.x - eye.x) <= size && std::abs(start.y - eye.y) <= size &&
                      std::abs(start.h - eye.h) <= size;
    return same ? eye.source : none;
  }

  const Domain& domain_;
  const std::vector<std::unique_ptr<Piece>>& pieces_;
  const HingeNeighbours<Real>& neighbours_;
  Index first_ = 0;
  bool moves_ = false;  // is any on a hinge?
  std::vector<Crossing> crossings_;
};

}  // namespace plexway
