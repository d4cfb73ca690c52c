#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include <plexway/mixed/mixed_complex.hpp>

#include "labels/mixed/hinge_facet.hpp"
#include "labels/mixed/hinge_neighbours.hpp"
#include "labels/mixed/mixed_piece.hpp"

namespace plexway {

/// Paths over many hinges between solids in which every point sees every other, pulled taut: the
/// sum of straight lines from crossing to crossing is least by Newton's steps for all crossings at
/// once. Each crossing meets the one before and the one behind only, so a step takes a time in
/// proportion to their number. Crossings go from hinge to hinge. A bend at an edge of a solid is
/// one as well, on a line, with the same piece on either side; what is in the way of lines is not
/// looked at here.
template <class Real>
class TautCrossings {
 public:
  using Domain = MixedComplex<Real>;
  using Pieces = std::vector<std::unique_ptr<MixedPiece<Real>>>;
  using Point = Vector3<Real>;

  struct Step {
    Index hinge;        // or a bend's number
    std::uint8_t side;  // that the path comes from
    HingePlace<Real> place;
  };
  /// Of each thread: what is kept from path to path so that nothing is allocated.
  struct Room {
    std::vector<Step> trial;
    struct Row {
      Real inverse[3], right[2], next[2][2];  // of the pivot; what couples with the next crossing
      Real step[2];
    };
    std::vector<Row> rows, trial_rows;
    std::vector<char> blunt;  // lines that a step turned around
    std::vector<Step> round;  // the path that is least where kinks are rounded
  };

  TautCrossings(const Domain& domain, const Pieces& pieces, const HingeNeighbours<Real>& neighbours)
      : hinges_(static_cast<Index>(domain.hinges().size())), facets_(hinges_) {
    for (Index n = 0; n < hinges_; ++n) fill(domain, pieces, n);
    for (Index n = 0; n < hinges_; ++n)
      if (facets_[n].dimension == 2)
        for (const Index other : neighbours.over_edges(n)) facets_[n].link(other, facets_[other]);
    for (const auto& piece : pieces) {
      first_bend_.push_back(static_cast<Index>(facets_.size()));
      for (Index e = 0; e < piece->bend_edges(); ++e) fill(*piece, e);
    }
  }

  /// A bend of a piece at one of its edges, `share` along it.
  [[nodiscard]] Step bend(Index piece, Index edge, Real share) const {
    return {first_bend_[piece] + edge, 0, {share, 0}};
  }
  [[nodiscard]] bool is_bend(const Step& step) const { return step.hinge >= hinges_; }
  /// The edge that a bend of a piece is at.
  [[nodiscard]] Index edge_of(Index piece, const Step& bend) const {
    return bend.hinge - first_bend_[piece];
  }
  [[nodiscard]] Index piece_of(const Step& bend) const {
    return static_cast<Index>(std::upper_bound(first_bend_.begin(), first_bend_.end(), bend.hinge) -
                              first_bend_.begin() - 1);
  }

  /// A crossing, in the coordinates of the piece on a side of its hinge times that piece's unit.
  [[nodiscard]] Point place(const Step& step, std::size_t side) const {
    return facets_[step.hinge].at(side, step.place);
  }

  /// Where a path's last line begins.
  [[nodiscard]] Point last_place(const Point& eye, std::span<const Step> path) const {
    return path.empty() ? eye : place(path.back(), 1 - path.back().side);
  }
  /// Of the hinge that is crossed: the length of an edge.
  [[nodiscard]] Real size(const Step& step) const {
    return norm(facets_[step.hinge].along[1 - step.side][0]);
  }

  /// How the length of a taut path grows with its target: since it is convex, by no less than this.
  struct Slope {
    Point along = {0, 0, 0}, normal = {0, 0, 0};
    Real across = 0;  // along the normal, to either side of a hinge that the path ends on
    bool known = false;
    [[nodiscard]] Real least(const Point& way) const {
      return known ? dot(along, way) + across * std::abs(dot(normal, way))
                   : -std::numeric_limits<Real>::infinity();
    }
  };
  [[nodiscard]] Slope slope(const Point& eye, std::span<const Step> path,
                            const Point& target) const {
    Slope slope;
    const Point way = target - last_place(eye, path);
    const Real length = norm(way);
    if (length > (path.empty() ? Real(0) : Real(1e-6) * size(path.back()))) {
      slope.along = 1 / length * way;
      slope.known = true;
      return slope;
    }
    // It ends on the hinge: refracted there, as any path that goes on.
    if (path.empty() || facets_[path.back().hinge].dimension != 2) return slope;
    const Step& last = path.back();
    const Facet& facet = facets_[last.hinge];
    const Point before = place(last, last.side) - last_place(eye, path.first(path.size() - 1));
    const Real far = norm(before);
    const Point *in = facet.along[last.side], *out = facet.along[1 - last.side];
    if (!(far > Real(1e-6) * norm(in[0]))) return slope;
    const Real d[2] = {dot(in[0], before) / far, dot(in[1], before) / far};
    const Real uu = dot(out[0], out[0]), uw = dot(out[0], out[1]), ww = dot(out[1], out[1]);
    const Real det = uu * ww - uw * uw;
    if (!(det > 0)) return slope;
    slope.along = (ww * d[0] - uw * d[1]) / det * out[0] + (uu * d[1] - uw * d[0]) / det * out[1];
    const Real rest = 1 - dot(slope.along, slope.along);
    if (!(rest >= 0)) return slope;  // it would not cross here
    const Point normal = cross(out[0], out[1]);
    slope.normal = 1 / norm(normal) * normal;
    slope.across = std::sqrt(rest);
    slope.known = true;
    return slope;
  }

  /// Moves a crossing by a share of the straight line to another one.
  void towards(Step& step, const Step& other, Real share) const {
    const Facet& facet = facets_[step.hinge];
    const Point from = facet.at(0, step.place);
    const Point off =
        from + share * (facets_[other.hinge].at(0, other.place) - from) - facet.origin[0];
    go(step, facet.dimension == 1
                 ? HingePlace<Real>{dot(facet.dual[0], off), 0}
                 : HingePlace<Real>{dot(facet.dual[0], off), dot(facet.dual[1], off)});
  }

  [[nodiscard]] Real length(const Point& eye, std::span<const Step> path,
                            const Point& target) const {
    Real sum = 0;
    Point from = eye;
    for (const Step& step : path) {
      const Facet& facet = facets_[step.hinge];
      sum += norm(facet.at(step.side, step.place) - from);
      from = facet.at(1 - step.side, step.place);
    }
    return sum + norm(target - from);
  }

  /// Moves the crossings of a path from `eye`, in the piece that it starts in, to `target`. Gives
  /// the path's length. Not all of it may be taut where a crossing is held up, as by a ridge
  /// between hinges.
  Real pull(const Point& eye, std::span<Step> path, const Point& target, Room& room) const {
    // What the last step still wins: the error is about the square of it then.
    constexpr Real gain = Real(1e-6);
    constexpr int most_steps = 32;
    if (path.empty()) return norm(target - eye);
    room.trial.resize(path.size());
    room.blunt.assign(path.size() + 1, 0);
    Quadratic now = newton(eye, path, target, room.blunt, room.rows);
    Real share = 1;
    for (int i = 0; i < most_steps && now.wins > 0; ++i) {
      const bool last = now.wins <= gain * now.length;
      for (std::size_t k = 0; k < path.size(); ++k) {
        room.trial[k] = path[k];
        const Real* step = room.rows[k].step;
        go(room.trial[k], {path[k].place[0] + share * step[0], path[k].place[1] + share * step[1]});
      }
      Quadratic there = now;
      if (last)
        there.length = length(eye, room.trial, target);
      else
        there = newton(eye, room.trial, target, room.blunt, room.trial_rows);
      if (there.length < now.length) {
        std::copy(room.trial.begin(), room.trial.end(), path.begin());
        std::swap(room.rows, room.trial_rows);
        now = there;
        share = 1;
      } else if (!last) {
        if (blunt(eye, path, target, room))
          now = newton(eye, path, target, room.blunt, room.rows);
        else
          share /= 2;
      }
      if (last) break;
    }
    const bool kinks = std::find(room.blunt.begin(), room.blunt.end(), 1) != room.blunt.end() ||
                       leaves_an_end(eye, path, target);
    if (!kinks && now.wins <= gain * now.length) return now.length;
    const Real rounded = pull_rounded(eye, path, target, now.length, room);
    if (!(rounded < now.length)) return now.length;
    std::copy(room.round.begin(), room.round.end(), path.begin());
    return rounded;
  }

 private:
  using Row = typename Room::Row;

  using Facet = HingeFacet<Real>;

  void fill(const Domain& domain, const Pieces& pieces, Index n) {
    const auto& hinge = domain.hinges()[n];
    Facet& facet = facets_[n];
    facet.dimension = hinge.dimension;
    for (const std::size_t side : {0, 1}) {
      const auto& piece = *pieces[hinge.piece[side]];
      const auto& member = domain.members()[hinge.begin[side]];
      const Real unit = piece.unit();
      const auto at = [&](Real a, Real b) {
        return unit * piece.place(member, hinge.dimension, HingePlace<Real>{a, b});
      };
      facet.origin[side] = at(0, 0);
      facet.along[side][0] = at(1, 0) - facet.origin[side];
      facet.along[side][1] = hinge.dimension == 2 ? at(0, 1) - facet.origin[side] : Point{0, 0, 0};
      if (side == 0)
        for (std::size_t i = 0; i <= hinge.dimension; ++i)
          facet.vertex[i] = piece.vertex_of(member.simplex, member.corner[i]);
    }
    const Point &u = facet.along[0][0], &w = facet.along[0][1];
    const Real uu = dot(u, u), uw = dot(u, w), ww = dot(w, w), det = uu * ww - uw * uw;
    facet.dual[0] = facet.dual[1] = {0, 0, 0};
    if (facet.dimension == 1 && uu > 0) facet.dual[0] = 1 / uu * u;
    if (!(det > 0)) return;
    facet.dual[0] = (ww / det) * u - (uw / det) * w;
    facet.dual[1] = (uu / det) * w - (uw / det) * u;
  }

  void fill(const MixedPiece<Real>& piece, Index edge) {
    Facet& facet = facets_.emplace_back();
    facet.dimension = 1;
    const auto [a, b] = piece.bend_edge(edge);
    for (const std::size_t side : {0, 1}) {
      facet.origin[side] = piece.unit() * a;
      facet.along[side][0] = piece.unit() * (b - a);
      facet.along[side][1] = {0, 0, 0};
    }
    const Point& u = facet.along[0][0];
    const Real uu = dot(u, u);
    facet.dual[0] = uu > 0 ? 1 / uu * u : Point{0, 0, 0};
    facet.dual[1] = {0, 0, 0};
  }

  // To a place that may lie beyond the hinge: on over its neighbours, or no farther than the rim.
  void go(Step& step, HingePlace<Real> b) const {
    constexpr int most_hinges = 64;
    for (int i = 0;; ++i) {
      const Facet& facet = facets_[step.hinge];
      if (facet.dimension == 1) b = {std::clamp(b[0], Real(0), Real(1)), 0};
      Real weight[3] = {1 - b[0] - b[1], b[0], b[1]};
      const std::size_t out =
          static_cast<std::size_t>(std::min_element(weight, weight + 3) - weight);
      if (facet.dimension == 1 || weight[out] >= 0) break;
      const Index next = facet.across[out];
      if (next == none || i == most_hinges) {
        Real sum = 0;
        for (Real& w : weight) sum += w = std::max(w, Real(0));
        b = {weight[1] / sum, weight[2] / sum};
        break;
      }
      const Facet& beyond = facets_[next];
      const Point off = facet.at(0, b) - beyond.origin[0];
      b = {dot(beyond.dual[0], off), dot(beyond.dual[1], off)};
      step.hinge = next;
    }
    step.place = b;
  }

  // A straight line and what it adds to gradients and second derivatives at its ends.
  struct Line {
    Point forward;
    Real length, one_over;
    Real sharp;
    Line(const Point& from, const Point& to, Real least, char blunt, Real round)
        : sharp(blunt ? 0 : 1) {
      const Point way = to - from;
      length = round > 0 ? std::sqrt(dot(way, way) + round * round) : norm(way);
      one_over = 1 / std::max(length, least);
      forward = one_over * way;
    }
    // Of the second derivative: a times it times b, where these have such shares of `forward`.
    [[nodiscard]] Real bend(const Point& a, Real a_forward, const Point& b, Real b_forward) const {
      return (dot(a, b) - sharp * a_forward * b_forward) * one_over;
    }
  };

  // A line that is short beside what a step does to it, at a kink of the length as where a crossing
  // is the target itself, is from now on taken to bend no less than it does anywhere on the way.
  // True if any is found.
  bool blunt(const Point& eye, std::span<const Step> path, const Point& target, Room& room) const {
    bool any = false;
    Point from = eye, moved = {0, 0, 0};
    for (std::size_t k = 0; k <= path.size(); ++k) {
      Point to = target, moves = {0, 0, 0};
      const Facet* facet = k < path.size() ? &facets_[path[k].hinge] : nullptr;
      const auto along = [&](std::size_t side) {
        const Real* step = room.rows[k].step;
        return step[0] * facet->along[side][0] + step[1] * facet->along[side][1];
      };
      if (facet != nullptr) {
        to = facet->at(path[k].side, path[k].place);
        moves = along(path[k].side);
      }
      if (!room.blunt[k] && norm(moves - moved) > norm(to - from) / 2) {
        room.blunt[k] = 1;
        any = true;
      }
      if (facet != nullptr) {
        from = facet->at(1 - path[k].side, path[k].place);
        moved = along(1 - path[k].side);
      }
    }
    return any;
  }

  // Would a path be shorter whose first or last crossing, which is the eye or the target itself,
  // left it? There it is at a kink, where Newton's steps see no slope.
  bool leaves_an_end(const Point& eye, std::span<const Step> path, const Point& target) const {
    const auto leaves = [&](const Step& step, const Point& end, const Point& other, bool first) {
      const Facet& facet = facets_[step.hinge];
      const std::size_t near = first ? step.side : 1 - step.side;
      const Point* const on = facet.along[near];
      if (norm(facet.at(near, step.place) - end) > Real(1e-6) * norm(on[0])) return false;
      const Point way = other - facet.at(1 - near, step.place);
      const Real far = norm(way);
      if (!(far > 0)) return false;
      const Point* const along = facet.along[1 - near];
      const Real pull[2] = {dot(along[0], way) / far, dot(along[1], way) / far};
      const Real uu = dot(on[0], on[0]), uw = dot(on[0], on[1]), ww = dot(on[1], on[1]);
      // The other line gets shorter by more than this one longer.
      constexpr Real more = Real(1 + 1e-6);
      if (facet.dimension == 1) return pull[0] * pull[0] > more * uu;
      return ww * pull[0] * pull[0] - 2 * uw * pull[0] * pull[1] + uu * pull[1] * pull[1] >
             more * (uu * ww - uw * uw);
    };
    const Step &first = path.front(), &last = path.back();
    const std::size_t n = path.size();
    return leaves(first, eye, n > 1 ? place(path[1], path[1].side) : target, true) ||
           leaves(last, target, n > 1 ? place(path[n - 2], 1 - path[n - 2].side) : eye, false);
  }

  // Past kinks, where a line has no length and Newton's steps creep or stop: with sqrt(l^2 + e^2)
  // for a length l, and e less and less. Gives the length of `room.round`.
  Real pull_rounded(const Point& eye, std::span<const Step> path, const Point& target, Real known,
                    Room& room) const {
    constexpr Real first = Real(.1), less = Real(.2), enough = Real(.01);
    constexpr Real last = sizeof(Real) == 4 ? Real(1e-5) : Real(1e-9);
    constexpr int most_steps = 8, most_halvings = 6;
    room.round.assign(path.begin(), path.end());
    room.trial.resize(path.size());
    room.blunt.assign(path.size() + 1, 0);
    for (Real e = first * known; e > last * known; e *= less) {
      Quadratic now = newton(eye, room.round, target, room.blunt, room.rows, e);
      int halvings = 0;
      Real share = 1;
      for (int i = 0; i < most_steps && now.wins > enough * e && halvings < most_halvings; ++i) {
        for (std::size_t k = 0; k < path.size(); ++k) {
          room.trial[k] = room.round[k];
          const Real* step = room.rows[k].step;
          const HingePlace<Real>& at = room.round[k].place;
          go(room.trial[k], {at[0] + share * step[0], at[1] + share * step[1]});
        }
        const Quadratic there = newton(eye, room.trial, target, room.blunt, room.trial_rows, e);
        if (there.length < now.length) {
          std::swap(room.round, room.trial);
          std::swap(room.rows, room.trial_rows);
          now = there;
          share = 1;
          halvings = 0;
        } else {
          share /= 2;
          ++halvings;
        }
      }
    }
    return length(eye, room.round, target);
  }

  // A path's length, and what it would win if that were quadratic.
  struct Quadratic {
    Real length, wins;
  };

  // Steps to where the length is least if it were quadratic.
  Quadratic newton(const Point& eye, std::span<const Step> path, const Point& target,
                   const std::vector<char>& blunt, std::vector<Row>& rows, Real round = 0) const {
    rows.resize(path.size());
    Real fall = 0, sum = 0;
    Point from = eye;
    Real diagonal[3] = {0, 0, 0}, right[2] = {0, 0};  // from the line before
    Real pulled[2] = {0, 0};                          // and how that alone pulls
    for (std::size_t k = 0; k < path.size(); ++k) {
      const Facet& facet = facets_[path[k].hinge];
      const std::size_t side = path[k].side;
      const Point *in = facet.along[side], *out = facet.along[1 - side];
      const Real least = Real(1e-9) * norm(in[0]);
      if (k == 0) {
        const Line line(eye, facet.at(side, path[0].place), least, blunt[0], round);
        sum += line.length;
        const Real f[2] = {dot(in[0], line.forward), dot(in[1], line.forward)};
        for (std::size_t i = 0; i < 2; ++i) pulled[i] = right[i] = -f[i];
        diagonal[0] = line.bend(in[0], f[0], in[0], f[0]);
        diagonal[1] = line.bend(in[0], f[0], in[1], f[1]);
        diagonal[2] = line.bend(in[1], f[1], in[1], f[1]);
      }
      from = facet.at(1 - side, path[k].place);
      const bool is_last = k + 1 == path.size();
      const Facet* next = is_last ? nullptr : &facets_[path[k + 1].hinge];
      const Point to = is_last ? target : next->at(path[k + 1].side, path[k + 1].place);
      const Line line(from, to, least, blunt[k + 1], round);
      sum += line.length;
      const Real f[2] = {dot(out[0], line.forward), dot(out[1], line.forward)};
      Row& row = rows[k];
      Real d[3] = {diagonal[0] + line.bend(out[0], f[0], out[0], f[0]),
                   diagonal[1] + line.bend(out[0], f[0], out[1], f[1]),
                   diagonal[2] + line.bend(out[1], f[1], out[1], f[1])};
      for (std::size_t i = 0; i < 2; ++i) row.right[i] = right[i] + f[i];
      if (facet.dimension == 1) d[2] += dot(in[0], in[0]) * line.one_over;
      // Where lines lie in the hinge nothing may hold a crossing along them.
      constexpr Real little = sizeof(Real) == 4 ? Real(1e-4) : Real(1e-9);
      Real det = d[0] * d[2] - d[1] * d[1];
      if (!(det > little * d[0] * d[2])) {
        const Real more = std::sqrt(little) * (d[0] + d[2]);
        d[0] += more;
        d[2] += more;
        det = d[0] * d[2] - d[1] * d[1];
      }
      row.inverse[0] = d[2] / det;
      row.inverse[1] = -d[1] / det;
      row.inverse[2] = d[0] / det;
      if (Real free[2]; facet.held(path[k].place, {pulled[0] + f[0], pulled[1] + f[1]}, free)) {
        const Real stiff =
            d[0] * free[0] * free[0] + 2 * d[1] * free[0] * free[1] + d[2] * free[1] * free[1];
        const Real one_over = stiff > 0 ? 1 / stiff : 0;
        row.inverse[0] = free[0] * free[0] * one_over;
        row.inverse[1] = free[0] * free[1] * one_over;
        row.inverse[2] = free[1] * free[1] * one_over;
      }
      const Real solved[2] = {row.inverse[0] * row.right[0] + row.inverse[1] * row.right[1],
                              row.inverse[1] * row.right[0] + row.inverse[2] * row.right[1]};
      fall += solved[0] * row.right[0] + solved[1] * row.right[1];
      if (is_last) break;
      const Point* on = next->along[path[k + 1].side];
      const Real g[2] = {dot(on[0], line.forward), dot(on[1], line.forward)};
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) row.next[i][j] = -line.bend(out[i], f[i], on[j], g[j]);
      // Eliminated: what the next crossing has of it.
      const auto product = [&](std::size_t i, std::size_t j) {
        const Real half[2] = {row.inverse[0] * row.next[0][j] + row.inverse[1] * row.next[1][j],
                              row.inverse[1] * row.next[0][j] + row.inverse[2] * row.next[1][j]};
        return row.next[0][i] * half[0] + row.next[1][i] * half[1];
      };
      diagonal[0] = line.bend(on[0], g[0], on[0], g[0]) - product(0, 0);
      diagonal[1] = line.bend(on[0], g[0], on[1], g[1]) - product(0, 1);
      diagonal[2] = line.bend(on[1], g[1], on[1], g[1]) - product(1, 1);
      for (std::size_t i = 0; i < 2; ++i)
        right[i] = -g[i] - (row.next[0][i] * solved[0] + row.next[1][i] * solved[1]);
      for (std::size_t i = 0; i < 2; ++i) pulled[i] = -g[i];
    }
    for (std::size_t k = path.size(); k-- > 0;) {
      Row& row = rows[k];
      Real r[2] = {row.right[0], row.right[1]};
      if (k + 1 < path.size())
        for (std::size_t i = 0; i < 2; ++i)
          r[i] -= row.next[i][0] * rows[k + 1].step[0] + row.next[i][1] * rows[k + 1].step[1];
      row.step[0] = row.inverse[0] * r[0] + row.inverse[1] * r[1];
      row.step[1] = row.inverse[1] * r[0] + row.inverse[2] * r[1];
    }
    return {sum, fall / 2};
  }

  Index hinges_;
  std::vector<Facet> facets_;      // of hinges, then of each piece's edges
  std::vector<Index> first_bend_;  // by piece
};

}  // namespace plexway
