#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/bent_ways.hpp"
#include "labels/mixed/crossing_ways.hpp"
#include "labels/mixed/hinge_neighbours.hpp"
#include "labels/mixed/mixed_piece.hpp"
#include "labels/mixed/taut_crossings.hpp"
#include "labels/mixed/whole_ways.hpp"
#include "labels/piece_sources.hpp"

namespace plexway {

/// Where labels of a mixed domain start on hinges, at vertices too. They have numbers of their own
/// behind the caller's sources.
///
/// A label that starts on a hinge starts where it is best for one simplex there. What is behind may
/// do better to cross a little farther on: each vertex looks for its own crossing when it is read
/// out. A crossing knows which one the path came over before, so that all crossings of a path are
/// moved until it is taut.
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
      : domain_(domain), pieces_(pieces), neighbours_(neighbours), whole_(domain, pieces) {}

  /// `number` is one of the caller's sources: a point of a piece, in the domain's unit.
  void seed(Index piece, const Point& at, Real offset, Index number) {
    first_ = std::max(first_, number + 1);
    whole_.start(first_);
    sources_.add({piece, number, at, offset});
  }
  /// The first number of a crossing, and the next one.
  [[nodiscard]] Index first() const { return first_; }
  [[nodiscard]] Index next() const { return first_ + static_cast<Index>(crossings_.size()); }
  void add(const Crossing& crossing) {
    keep(crossing);
    whole_.skip();
  }
  /// One that a front from member m made for member k beyond.
  void add(const Crossing& crossing, Index m, Index k) {
    keep(crossing);
    const auto& hinge = domain_.hinges()[crossing.hinge];
    const Piece& from = *pieces_[hinge.piece[crossing.side]];
    const Piece& to = *pieces_[hinge.piece[1 - crossing.side]];
    const Member& beyond = domain_.members()[k];
    Known& known = crossings_.back();
    const HingeEnd<Real> at = to.pose(beyond, hinge.dimension, crossing.start);
    known.place = to.shape(beyond, hinge.dimension).point(at.x, at.y);
    if (hinge.dimension == 1) known.place[1] = 0;
    whole_.add(crossing.hinge, crossing.side, known.place, to.unit() * crossing.start, m);
    if (!to.sees_all()) return;
    Index before = none;
    if (!from.eye(domain_.members()[m], known.eye, known.sigma, before)) return;
    if (on_hinge(before) != nullptr) known.before = before;
    known.source = root(before);
  }
  /// The caller's source that a label comes from.
  [[nodiscard]] Index root(Index number) const {
    const Known* crossing = find(number);
    return crossing != nullptr ? crossing->source : number;
  }
  /// All crossings are there: vertices may be read out, those of several pieces at once.
  void end(Real radius) {
    if (!moves_) return;
    taut_ = std::make_unique<Taut>(domain_, pieces_, neighbours_);
    bent_ = std::make_unique<BentWays<Real>>(domain_, pieces_, *taut_);
    ways_ = std::make_unique<Ways>(domain_, pieces_, *taut_, *bent_, radius);
    sources_.sort();
  }
  /// Then ways are handed on, round by round.
  void hand_on(Index piece, std::span<Real> distance, std::span<Index> label) {
    if (moves_) ways_->hand_on(piece, distance, label);
  }
  bool deliver() { return moves_ && ways_->deliver(); }
  /// Was there no end to it? Some vertices may be nearer then.
  [[nodiscard]] bool is_cut_short() const { return moves_ && ways_->is_cut_short(); }

  /// Distances and labels of a piece's vertices, in its caller's order.
  void straighten(Index piece, std::span<Real> distance, std::span<Index> label) {
    if (!moves_) return;
    const auto& own = *pieces_[piece];
    const auto starts = [&](Index number) -> const Point* {
      const Known* crossing = on_hinge(number);
      return crossing != nullptr ? &crossing->start : nullptr;
    };
    const auto& complex = domain_.complex(domain_.pieces()[piece]);
    const auto inside = [&](Index v) {
      return std::visit([&](const auto& c) { return c.inside_vertex(v); }, complex);
    };
    std::vector<Index> outside(distance.size());
    for (Index v = 0; v < distance.size(); ++v) outside[inside(v)] = v;
    std::vector<Index> via(distance.size(), none);
    std::vector<Point> last(distance.size());  // where the path crossed
    std::vector<Index> front;
    Room room;
    WholeRoom whole;
    for (Index v = 0; v < distance.size(); ++v) {
      const Index number = own.crossing_seen(inside(v), starts);
      if (find(number) == nullptr) {
        keep_straight(piece, v, inside(v), distance[v], label[v]);
        continue;
      }
      via[v] = number;
      const Real there = least_by(number, own, inside(v), room);
      last[v] = room.crossing;
      if (!keep(piece, v, there, distance[v], room))
        keep_straight(piece, v, inside(v), distance[v], label[v]);
      if (there < distance[v]) distance[v] = there, label[v] = room.source;
      // Beside a thin fast layer all tetrahedra may have labels that came through that.
      keep_straight(piece, v, inside(v), distance[v], label[v], 1 - Piece::crossing_gain);
      if (!ways_->known(piece, v)) front.push_back(v);
    }
    if (whole_.any())
      for (Index v = 0; v < distance.size(); ++v)
        keep_whole(piece, v, inside(v), distance[v], label[v], whole);
    // A vertex may be nearer by the way of a neighbour: because none of its simplices came over the
    // hinge, or because the label that it kept was of a way that is longer once all are taut.
    if (!own.sees_all()) return;
    std::vector<Index> around;
    const std::size_t most = 16 * distance.size();  // some may win by less and less, in turns
    for (std::size_t i = 0; i < front.size() && i < most; ++i) {
      const Index v = front[i], number = via[v];
      const Point at = own.unit() * own.place(inside(v));
      const Real before = distance[v] - norm(at - last[v]);
      own.vertices_around(inside(v), around);
      for (const Index inner : around) {
        const Index w = outside[inner];
        const Real known = distance[w] * (1 - Piece::bend_loss);
        const Point there = own.place(inner);
        // Only to choose whom to ask: what is taken is a way that was pulled taut.
        const Real straight = before + norm(own.unit() * there - last[v]);
        if (via[w] != none && !(straight < known * (1 - Piece::crossing_gain))) continue;
        const Real way = least_by(number, own, inner, room);
        if (!(way < known)) continue;
        via[w] = number;
        last[w] = room.crossing;
        keep(piece, w, way, way, room);
        distance[w] = way;
        label[w] = room.source;
        front.push_back(w);
      }
    }
    if (front.size() > most) ways_->cut_short(piece);
  }

 private:
  using Taut = TautCrossings<Real>;
  using Step = typename Taut::Step;
  using Ways = CrossingWays<Real>;
  static constexpr Real infinity = std::numeric_limits<Real>::infinity();

  struct Known : Crossing {
    HingePlace<Real> place;
    Index before;  // the crossing that the path came over before
    Point eye;     // or what it came from, in the piece before and the domain's unit
    Real sigma;    // and the way to it; +inf where only labels tell
  };
  /// A path over a hinge: from what a label knows to a target.
  struct Over {
    Real distance = infinity, before = infinity;  // all, and as far as the hinge
    HingePlace<Real> place = {0, 0};
    int rims = 0;         // of the hinge that the crossing lies on: a neighbour may be better
    Index label = none;   // where the label that knows starts, if that is on a hinge
    Index source = none;  // of that label
  };
  /// The path of a vertex: what it starts from, and its crossings.
  struct Path {
    Point eye;
    Real sigma = infinity;
    std::vector<Step> steps;
  };
  /// Of a piece that is read out.
  struct Room {
    Path path, last;
    typename Taut::Room taut;
    Point crossing;  // the last one of the path found last, in the domain's unit
    bool all;        // was that pulled as a whole? It is `last` then.
    Index source;    // whose it is
  };
  void keep(const Crossing& crossing) {
    crossings_.push_back({crossing, {0, 0}, none, {0, 0, 0}, infinity});
    moves_ |= crossing.hinge != none;
  }
  // The whole way that labels tell, pulled taut, if it is the vertex's distance or less.
  struct WholeRoom {
    typename WholeWays<Real>::Way way;
    typename BentWays<Real>::Room bent;
  };
  void keep_whole(Index piece, Index v, Index inside, Real& distance, Index& label,
                  WholeRoom& room) {
    auto& way = room.way;
    whole_.find(piece, inside, *bent_, way);
    if (!way.known()) return;
    const Real enough = distance * (1 + Piece::crossing_gain);
    const Real length =
        bent_->pull(way.eye, way.sigma, way.steps, piece, inside, enough, room.bent);
    if (!(length < enough)) return;
    const Index source = root(way.source);
    ways_->keep(piece, v, way.eye, way.sigma, way.steps, source);
    if (length < distance) distance = length, label = source;
  }
  // A path was found for a vertex: if it is its distance's, and known from its start.
  bool keep(Index piece, Index v, Real length, Real distance, const Room& room) {
    const bool is = room.all && length <= distance * (1 + Piece::crossing_gain);
    if (is)
      ways_->keep(piece, v, room.last.eye, room.last.sigma, room.last.steps, room.source);
    else
      ways_->forget(piece, v);
    return is;
  }
  // The same where it is a straight line from a source in the piece: of few, whichever is nearest,
  // whatever label was kept; of many, that of the label.
  void keep_straight(Index piece, Index v, Index inside, Real& distance, Index& label,
                     Real within = 1 + Piece::crossing_gain) {
    const Piece& own = *pieces_[piece];
    if (!own.sees_all()) return;
    const auto [first, last] = sources_.few_or(piece, label);
    for (auto source = first; source != last; ++source) {
      const Real length = source->offset + norm(own.unit() * own.place(inside) - source->at);
      if (!(length <= distance * within)) continue;
      ways_->keep(piece, v, source->at, source->offset, {}, source->number);
      if (length < distance) distance = length, label = source->number;
    }
  }

  [[nodiscard]] const Known* find(Index number) const {
    return number == none || number < first_ ? nullptr : &crossings_[number - first_];
  }
  // One that may be moved.
  [[nodiscard]] const Known* on_hinge(Index number) const {
    const Known* crossing = find(number);
    return crossing == nullptr || crossing->hinge == none ? nullptr : crossing;
  }

  // The crossings as far as a path is known, in its order.
  void follow(Index number, Path& path) const {
    path.steps.clear();
    for (const Known* c = find(number); c != nullptr; c = find(c->before)) {
      path.steps.push_back({c->hinge, c->side, c->place});
      path.eye = c->eye;
      path.sigma = c->sigma;
    }
    std::reverse(path.steps.begin(), path.steps.end());
  }

  // The length of the shortest path to a vertex by way of a crossing.
  [[nodiscard]] Real least_by(Index number, const Piece& own, Index vertex, Room& room) const {
    Path& path = room.path;
    follow(number, path);
    room.all = false;
    room.source = find(number)->source;
    Real least = infinity;
    if (!own.sees_all()) return least_in_sight(own, vertex, room);
    const Point target = own.place(vertex);
    if (path.steps.size() == 1 || !(path.sigma < infinity)) {
      // Labels tell from where it comes, and may know of a better way.
      const bool is_last = path.steps.size() == 1;
      Step first = path.steps[0];
      const Over over = move(first, is_last ? target : inner_place(path.steps[1]));
      if (over.source != none) room.source = root(over.source);
      if (is_last) {
        least = over.distance;
        room.crossing = taut_->place(first, 1 - first.side);
      }
      if (over.label != none) {
        const std::vector<Step> behind(path.steps.begin() + 1, path.steps.end());
        follow(over.label, path);
        path.steps.push_back(first);
        path.steps.insert(path.steps.end(), behind.begin(), behind.end());
      } else if (is_last) {
        return least;
      } else {
        path.steps[0] = first;
      }
    }
    const Point end = own.unit() * target;
    const auto take = [&](Real there) {
      room.all = there < least && path.sigma < infinity;
      if (!(there < least)) return;
      least = there;
      room.crossing = taut_->place(path.steps.back(), 1 - path.steps.back().side);
    };
    if (path.sigma < infinity) {
      take(pull_all(path, end, room));
      return least;
    }
    // Up to the first crossing labels tell; then the rest is moved, and again.
    if (path.steps.size() < 2) return least;
    constexpr int rounds = 24;
    constexpr Real gain = sizeof(Real) == 4 ? Real(1e-6) : Real(1e-9);
    for (int i = 0; i < rounds; ++i) {
      const Over over = move(path.steps[0], inner_place(path.steps[1]));
      if (!(over.before < infinity)) break;
      if (over.source != none) room.source = root(over.source);
      const Real there =
          over.before + taut_->pull(taut_->place(path.steps[0], 1 - path.steps[0].side),
                                    std::span(path.steps).subspan(1), end, room.taut);
      const bool enough = !(there < least * (1 - gain));
      take(there);
      if (enough) break;
    }
    return least;
  }

  // The same where something may be in the way behind the last crossing: that goes from hinge to
  // hinge as labels tell, and only as far as the vertex sees it. Newton's steps would go through
  // what is in the way.
  [[nodiscard]] Real least_in_sight(const Piece& own, Index vertex, Room& room) const {
    Path& path = room.path;
    Step& last = path.steps.back();
    const Step start = last;
    const Point target = own.place(vertex);
    Over over = move(last, target);
    if (!(over.distance < infinity)) return infinity;
    if (!in_sight(last, own, vertex)) {
      // The way is convex: the farther towards the least, the better.
      const Step best = last;
      last = start;
      over = at_place(last, target);
      Real low = 0, high = 1;
      constexpr int halvings = 8;
      for (int i = 0; i < halvings; ++i) {
        const Real share = (low + high) / 2;
        Step step = start;
        taut_->towards(step, best, share);
        const Over there = at_place(step, target);
        const bool seen = there.distance < over.distance && in_sight(step, own, vertex);
        (seen ? low : high) = share;
        if (seen) over = there, last = step;
      }
      if (low == 0 && !in_sight(last, own, vertex)) return infinity;
    }
    if (over.source != none) room.source = root(over.source);
    room.crossing = taut_->place(last, 1 - last.side);
    return over.distance;
  }
  [[nodiscard]] bool in_sight(const Step& step, const Piece& own, Index vertex) const {
    const auto& hinge = domain_.hinges()[step.hinge];
    for (Index m = hinge.begin[1 - step.side]; m < hinge.end[1 - step.side]; ++m)
      if (own.sees(domain_.members()[m], hinge.dimension, step.place, vertex)) return true;
    return false;
  }

  // All crossings of a path whose start is known.
  Real pull_all(Path& path, const Point& target, Room& room) const {
    Real now = taut_->length(path.eye, path.steps, target);
    if (alike(path, room.last))
      if (const Real there = taut_->length(path.eye, room.last.steps, target); there < now)
        path.steps = room.last.steps, now = there;
    now = taut_->pull(path.eye, path.steps, target, room.taut);
    room.last = path;
    return path.sigma + now;
  }
  // Do two paths start at one point and cross the same pieces?
  [[nodiscard]] bool alike(const Path& a, const Path& b) const {
    return a.steps.size() == b.steps.size() && a.sigma == b.sigma && a.eye.x == b.eye.x &&
           a.eye.y == b.eye.y && a.eye.z == b.eye.z &&
           std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(),
                      [&](const Step& s, const Step& t) {
                        const auto &h = domain_.hinges()[s.hinge], &g = domain_.hinges()[t.hinge];
                        return s.side == t.side && h.dimension == g.dimension &&
                               h.piece[0] == g.piece[0] && h.piece[1] == g.piece[1];
                      });
  }

  // Where a step crosses, as the piece before has it.
  [[nodiscard]] Point inner_place(const Step& step) const {
    const auto& hinge = domain_.hinges()[step.hinge];
    return pieces_[hinge.piece[step.side]]->place(domain_.members()[hinge.begin[step.side]],
                                                  hinge.dimension, step.place);
  }

  // To where it is best for a target, on its hinge or a neighbour's, by what labels know.
  Over move(Step& step, const Point& target) const {
    Over over = way_over(step.hinge, step.side, target);
    for (int steps = 0; steps < 64 && over.rims > 0; ++steps) {
      Index better = none;
      // At an end of the hinge: another one there may be better that shares no edge with it.
      for (const Index other : over.rims > 1 ? neighbours_.over_vertices(step.hinge)
                                             : neighbours_.over_edges(step.hinge))
        if (const Over there = way_over(other, step.side, target); there.distance < over.distance)
          over = there, better = other;
      if (better == none) break;
      step.hinge = better;
    }
    step.place = over.place;
    return over;
  }

  // By a place as it is.
  [[nodiscard]] Over at_place(const Step& step, const Point& target) const {
    const auto& hinge = domain_.hinges()[step.hinge];
    const Piece& from = *pieces_[hinge.piece[step.side]];
    const Piece& to = *pieces_[hinge.piece[1 - step.side]];
    Over least;
    for (Index m = hinge.begin[step.side]; m < hinge.end[step.side]; ++m) {
      const Member& member = domain_.members()[m];
      if (!(from.distance(member.simplex) < infinity)) continue;
      const HingeFront<Real> front(from, member, hinge.dimension, none, none);
      const Real before = front.distance(step.place);
      if (before < least.before)
        least.before = before, least.place = step.place,
        least.source = from.leave(member, hinge.dimension, step.place).source;
    }
    least.distance = least.before + norm(to.unit() * target - taut_->place(step, 1 - step.side));
    return least;
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
      const PosedSource<Real> eye = front.seen_from(path.crossing);
      least = {path.extent,
               path.before,
               path.crossing,
               0,
               straight_from(from, member, eye, hinge.dimension),
               eye.source};
    }
    constexpr Real rim = 16 * std::numeric_limits<Real>::epsilon();
    const HingePlace<Real>& b = least.place;
    least.rims = (b[0] <= rim) + (b[1] <= rim) + (1 - b[0] - b[1] <= rim);
    return least;
  }

  // The crossing that an eye is, if it may be moved: in a piece where all points see each other.
  [[nodiscard]] Index straight_from(const Piece& piece, const Member& member,
                                    const PosedSource<Real>& eye, int dimension) const {
    const Known* crossing = on_hinge(eye.source);
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
  std::vector<Known> crossings_;
  PieceSources<Point, Real> sources_;
  WholeWays<Real> whole_;
  std::unique_ptr<Taut> taut_;
  std::unique_ptr<BentWays<Real>> bent_;
  std::unique_ptr<Ways> ways_;
};

}  // namespace plexway
