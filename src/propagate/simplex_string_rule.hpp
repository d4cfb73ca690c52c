#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/complex/simplicial_complex.hpp>

#include "complex/elimination.hpp"
#include "propagate/simplex_label.hpp"
#include "propagate/simplex_string.hpp"

namespace plexway {

/// Visibility::saddles in a domain of dimension N that lies flat in R^N: a label is the whole path
/// to the centre as far as it matters, a source and up to four bends on faces of dimension N - 2.
/// To offer it to a neighbour the path's end is drawn over there and the string pulled taut
/// (SimplexString), so every distance is the length of a path. Where no face is in the way, which
/// one search tells, that is a straight line from the same source. In double whatever Real is.
template <class Real, int N, class Front>
class SimplexStringRule {
 public:
  using Label = SimplexStringLabel<N>;
  using Record = SimplexRecord<Real, N>;
  using Layout = SimplexLayout<N>;
  using Domain = SimplicialComplex<Real, N>;
  using Point = std::array<double, N>;
  static constexpr std::size_t no_facet = FacetAcross::facet_mask;

  SimplexStringRule(const Domain& domain, Front& front)
      : domain_(&domain),
        flat_(domain.flat()),
        records_(domain.records().data()),
        any_faces_(!flat_->faces.empty()),
        front_(&front) {}

  /// The same rule on the front of another executor.
  template <class Other>
  [[nodiscard]] SimplexStringRule<Real, N, Other> on(Other& front) const {
    return {*domain_, front};
  }

  [[nodiscard]] Real distance(Index s) const { return static_cast<Real>(front_->label(s).centre); }
  [[nodiscard]] Real corner_distance(Index s, std::size_t i) const {
    return static_cast<Real>(reach(s, i, infinity));
  }
  void set_patience(Real share) { patience_ = share; }

  void prefetch(Index s) const { __builtin_prefetch(&records_[s]); }
  void prefetch_around(Index s) const {
    for (const Index across : records_[s].across) {
      const Index t = across == none ? 0 : across >> FacetAcross::simplex_shift;
      __builtin_prefetch(&flat_->centres[t]);
      __builtin_prefetch(&front_->label(t));
    }
  }

  /// Offers to all neighbours but the one the path came from.
  void expand(Index s) {
    const std::size_t in = front_->hinge(s);
    for (std::size_t i = 0; i <= N; ++i)
      if (i != in) cross(s, i);
  }

  bool seed_corner(Index s, std::size_t i, Real sigma, Index source) {
    const Index vertex = records_[s].corner[i];
    const Point &at = flat_->positions[vertex], &to = centre(s);
    Label label = point_label(at, static_cast<double>(sigma));
    label.centre = label.sigma + distance_of(at, to);
    if (!(label.centre < to_beat(s))) return false;
    if (any_faces_) {
      // Held off where the vertex is most open, so that all around see it; else towards s.
      const Point own = towards(at, to), start = plus(at, flat_->clearance, own);
      const Point open = open_direction(vertex);
      const Point source_at = plus(at, flat_->clearance, open);
      hold(label, own);
      if (inner(open, open) > 0 && flat_->passes_by(at, source_at, start)) {
        Label held = label;
        hold(held, open);
        SimplexString<N> string(*flat_);
        draw(held, string);
        string.add_point(start, at);
        string.add_point(to, to);
        if (string.pull(infinity) == SimplexString<N>::Pulled::taut)
          label = label_of(string, label.sigma);
      }
    }
    return accept(s, no_facet, label, source);
  }

  /// A point of a simplex, by its barycentric coordinates.
  bool seed_inside(Index s, std::span<const double, N + 1> barycentric, Real sigma, Index source) {
    Point at{};
    for (std::size_t k = 0; k <= N; ++k)
      at = plus(at, barycentric[k], flat_->positions[records_[s].corner[k]]);
    Label label = point_label(at, static_cast<double>(sigma));
    hold(label, towards(at, centre(s)));
    label.centre = label.sigma + distance_of(at, centre(s));
    return accept(s, no_facet, label, source);
  }

  /// Vertices at which paths bend.
  [[nodiscard]] std::span<const Index> corners() const { return flat_->corners; }

  /// The least that the simplices at a vertex have for it, and from which source. Of those whose
  /// paths came the same way one is asked, if its path goes on to the vertex over the same faces.
  void read_vertex(Index vertex, Real& distance, Index& source) const {
    double best = infinity;
    constexpr std::size_t most = 12;
    Index asked[most];
    std::size_t count = 0;
    const Point& at = flat_->positions[vertex];
    for (const Index c : domain_->corners_at(vertex)) {
      const Index s = c / (N + 1);
      if (!front_->reached(s)) continue;
      const Label& label = front_->label(s);
      if (!(least(label, s, at) < best * (1 - 1e-14))) continue;
      if (std::any_of(asked, asked + count, [&](Index other) {
            return front_->source(other) == front_->source(s) &&
                   same_way(front_->label(other), label);
          }))
        continue;
      bool bent = false;
      const double d = reach(s, c % (N + 1), best, &bent);
      if (!bent && count < most) asked[count++] = s;
      if (d < best) {
        best = d;
        source = front_->source(s);
      }
    }
    distance = static_cast<Real>(best);
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double gain = 1 - std::max(1e-10, 8. * std::numeric_limits<Real>::epsilon());

  [[nodiscard]] const Point& centre(Index s) const { return flat_->centres[s]; }
  [[nodiscard]] double to_beat(Index s) const {
    return front_->reached(s) ? front_->label(s).centre * gain * static_cast<double>(patience_)
                              : infinity;
  }

  static Label point_label(const Point& at, double sigma) {
    Label label;
    label.source = at;
    label.sigma = sigma;
    label.bends = 0;
    std::fill(std::begin(label.nudge), std::end(label.nudge), 0.F);
    return label;
  }
  static void hold(Label& label, const Point& direction) {
    for (std::size_t d = 0; d < N; ++d) label.nudge[d] = static_cast<float>(direction[d]);
  }
  static bool same_way(const Label& a, const Label& b) {
    return a.bends == b.bends && a.sigma == b.sigma && a.source == b.source &&
           std::equal(a.face, a.face + a.bends, b.face);
  }

  /// The label's string but for its end.
  void draw(const Label& label, SimplexString<N>& string) const {
    Point at = label.source;
    for (std::size_t d = 0; d < N; ++d)
      at[d] += flat_->clearance * static_cast<double>(label.nudge[d]);
    string.start(at, label.source);
    for (std::size_t i = 0; i < label.bends; ++i) string.add_bend(label.face[i], label.along[i]);
  }

  /// What the string is for its end; beyond four bends the first ones are walked.
  Label label_of(const SimplexString<N>& string, double sigma) const {
    const std::size_t bends = string.bends();
    const std::size_t first = bends > Label::most ? bends - Label::most : 0;
    Label label;
    label.sigma = sigma;
    for (std::size_t i = 0; i < first; ++i)
      label.sigma += distance_of(string[i].sharp, string[i + 1].sharp);
    label.source = string[first].sharp;
    for (std::size_t d = 0; d < N; ++d)
      label.nudge[d] =
          static_cast<float>((string[first].at[d] - string[first].sharp[d]) / flat_->clearance);
    label.bends = static_cast<Index>(bends - first);
    label.centre = label.sigma;
    for (std::size_t i = 0; i < label.bends; ++i) {
      label.face[i] = string[first + 1 + i].face;
      label.along[i] = string[first + 1 + i].along;
    }
    for (std::size_t i = first; i + 1 < string.count(); ++i)
      label.centre += distance_of(string[i].sharp, string[i + 1].sharp);
    return label;
  }

  /// No path over the label's faces to a point near by is shorter: a distance is convex.
  [[nodiscard]] double least(const Label& label, Index s, const Point& to) const {
    if (label.bends == 0) return label.sigma + distance_of(label.source, to);
    const Index last = label.bends - 1;
    const Point eye = flat_->faces[label.face[last]].at(label.along[last]);
    const Point leg = minus(centre(s), eye);
    const double length = std::sqrt(inner(leg, leg));
    return label.centre + (length > 0 ? inner(leg, minus(to, centre(s))) / length : 0);
  }

  bool accept(Index t, std::size_t in, const Label& label, Index source) {
    if (!(label.centre < to_beat(t))) return false;
    front_->accept(t, in, label, static_cast<Real>(label.centre), source);
    if (front_->expands_soon()) prefetch_around(t);
    return true;
  }

  void cross(Index s, std::size_t facet) {
    const Index across = records_[s].across[facet];
    if (across == none) return;
    const Index t = across >> FacetAcross::simplex_shift;
    const Label& from = front_->label(s);
    const double known = to_beat(t), straight = least(from, s, centre(t));
    if (!(straight < known)) return;
    Label label;
    if (!any_faces_) {
      label = from;
      label.centre = straight;
    } else if (!offer_around(from, s, facet, t, known, label)) {
      return;
    }
    accept(t, across & FacetAcross::facet_mask, label, front_->source(s));
  }

  bool offer_around(const Label& from, Index s, std::size_t facet, Index t, double known,
                    Label& label) const {
    using Pulled = typename SimplexString<N>::Pulled;
    SimplexString<N> string(*flat_);
    draw(from, string);
    const Point &here = centre(s), &there = centre(t);
    Point gate{};  // straight from centre to centre may miss the facet
    for (std::size_t k = 0; k < N; ++k)
      gate = plus(gate, 1. / N, flat_->positions[records_[s].corner[Layout::corner(facet, k)]]);
    const bool direct = string.is_clear(here, gate, there);
    string.add_point(here, here);
    Pulled pulled = Pulled::taut;
    if (!direct) {
      string.add_point(gate, gate);
      pulled = string.pull(infinity);
    }
    if (pulled == Pulled::taut) {
      string.add_point(there, there);
      pulled = string.pull(known - from.sigma);
    }
    if (pulled == Pulled::longer) return false;
    if (pulled == Pulled::taut) {
      label = label_of(string, from.sigma);
      return label.centre < known;
    }
    // A path all the same: from here on as from a source.
    const double walked = from.centre + (direct ? 0 : distance_of(here, gate));
    label = point_label(direct ? here : gate, walked);
    label.centre = walked + distance_of(label.source, there);
    return label.centre < known;
  }

  /// Length of the path to corner i, as far as it is below `limit`. Has it other bends there?
  double reach(Index s, std::size_t i, double limit, bool* bent = nullptr) const {
    using Pulled = typename SimplexString<N>::Pulled;
    const Label& label = front_->label(s);
    const Point& at = flat_->positions[records_[s].corner[i]];
    if (!any_faces_) return label.sigma + distance_of(label.source, at);
    SimplexString<N> string(*flat_);
    draw(label, string);
    string.add_point(centre(s), centre(s));
    string.add_point(plus(at, flat_->clearance, towards(at, centre(s))), at);
    switch (string.pull(limit - label.sigma)) {
      case Pulled::taut:
        if (bent) {
          *bent = string.bends() != label.bends;
          for (std::size_t k = 0; k < label.bends && !*bent; ++k)
            *bent = string[k + 1].face != label.face[k];
        }
        return label.sigma + string.length();
      case Pulled::longer:
        return infinity;
      case Pulled::stuck:
        break;
    }
    if (bent) *bent = true;
    return label.centre + distance_of(centre(s), at);
  }

  static Point towards(const Point& from, const Point& to) {
    const Point way = minus(to, from);
    const double length = std::sqrt(inner(way, way));
    return length > 0 ? plus(Point{}, 1 / length, way) : Point{};
  }
  /// From a vertex to where its simplices are; nowhere, if none is there or only parts touch.
  [[nodiscard]] Point open_direction(Index vertex) const {
    const auto pinched = domain_->pinched();
    if (std::binary_search(pinched.begin(), pinched.end(), vertex)) return Point{};
    Point sum{};
    const Point& at = flat_->positions[vertex];
    for (const Index c : domain_->corners_at(vertex))
      sum = plus(sum, 1., towards(at, centre(c / (N + 1))));
    sum = towards(Point{}, sum);
    for (const Index c : domain_->corners_at(vertex))
      if (is_in_cone(sum, c / (N + 1), c % (N + 1))) return sum;
    return Point{};
  }
  [[nodiscard]] bool is_in_cone(const Point& direction, Index s, std::size_t corner) const {
    double m[N][N + 1];
    for (std::size_t k = 0; k < N; ++k)
      for (std::size_t d = 0; d < N; ++d)
        m[d][k] = flat_->positions[records_[s].corner[Layout::corner(corner, k)]][d] -
                  flat_->positions[records_[s].corner[corner]][d];
    for (std::size_t d = 0; d < N; ++d) m[d][N] = direction[d];
    eliminate(m);
    for (std::size_t i = 0; i < N; ++i)
      if (m[i][N] / m[i][i] < 0) return false;
    return true;
  }

  const Domain* domain_;
  const FlatDomain<N>* flat_;
  const Record* records_;
  bool any_faces_;
  Front* front_;
  Real patience_ = 1;
};

}  // namespace plexway
