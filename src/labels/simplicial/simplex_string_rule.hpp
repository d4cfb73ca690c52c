#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/simplicial/simplicial_complex.hpp>

#include "complexes/simplicial/elimination.hpp"
#include "labels/simplicial/simplex_label.hpp"
#include "labels/simplicial/simplex_string.hpp"
#include "labels/simplicial/simplex_vertex_ways.hpp"
#include "labels/simplicial/simplex_way.hpp"

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

  /// `ways`: room for all vertices; none is known yet.
  SimplexStringRule(const Domain& domain, Front& front, SimplexVertexWay<N>* ways,
                    SimplexTelling<N>* telling)
      : domain_(&domain),
        flat_(domain.flat()),
        records_(domain.records().data()),
        any_faces_(!flat_->faces.empty()),
        front_(&front),
        ways_(ways),
        telling_(telling) {}

  [[nodiscard]] Real distance(Index s) const { return static_cast<Real>(front_->label(s).centre); }
  void set_patience(Real share) { patience_ = share; }

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
    if (!flat_->gates.empty()) [[unlikely]]
      for (const FaceGate<N>& gate : flat_->gates_of(s)) pass(gate);
  }

  bool seed_corner(Index s, std::size_t i, Real sigma, Index source) {
    const Index vertex = records_[s].corner[i];
    const Point &at = flat_->positions[vertex], &to = centre(s);
    Label label = point_label<N>(at, static_cast<double>(sigma));
    label.centre = label.sigma + distance_of(at, to);
    if (!(label.centre < to_beat(s))) return false;
    if (any_faces_) {
      // Held off where the vertex is most open, so that all around see it; else towards s.
      const Point own = direction<N>(at, to), start = plus(at, flat_->clearance, own);
      const Point open = open_direction(vertex);
      const Point source_at = plus(at, flat_->clearance, open);
      hold<N>(label, own);
      if (inner(open, open) > 0 && flat_->passes_by(at, source_at, start)) {
        Label held = label;
        hold<N>(held, open);
        SimplexString<N> string(*flat_);
        draw(*flat_, held, string);
        string.add_point(start, at);
        string.add_point(to, to);
        if (string.pull(infinity) == SimplexString<N>::Pulled::taut)
          label = label_of(*flat_, string, label.sigma);
      }
    }
    return accept(s, no_facet, label, source);
  }

  /// A point of a simplex, by its barycentric coordinates.
  bool seed_inside(Index s, std::span<const double, N + 1> barycentric, Real sigma, Index source) {
    Point at{};
    for (std::size_t k = 0; k <= N; ++k)
      at = plus(at, barycentric[k], flat_->positions[records_[s].corner[k]]);
    Label label = point_label<N>(at, static_cast<double>(sigma));
    hold<N>(label, direction<N>(at, centre(s)));
    label.centre = label.sigma + distance_of(at, centre(s));
    return accept(s, no_facet, label, source);
  }

  /// The vertices' own ways (SimplexVertexWays): true if some simplex got a better label by them.
  template <class Report>
  bool pass_vertices(double radius, const Report& report) {
    if (!any_faces_ && domain_->pinched().empty()) return false;
    return SimplexVertexWays<Real, N, SimplexStringRule>(*this, ways_, telling_)
        .pass(radius, report);
  }

  /// The least that is known of a vertex, and from which source.
  void read_vertex(Index vertex, Real& distance, Index& source) const {
    const auto& way =
        SimplexVertexWays<Real, N, const SimplexStringRule>(*this, ways_, telling_).at(vertex);
    distance = static_cast<Real>(way.distance);
    source = way.source;
  }

  // For SimplexVertexWays.
  [[nodiscard]] const Domain& domain() const { return *domain_; }
  [[nodiscard]] const FlatDomain<N>& flat() const { return *flat_; }
  [[nodiscard]] const Front& front() const { return *front_; }
  [[nodiscard]] const Point& centre(Index s) const { return flat_->centres[s]; }

  /// What a simplex must be offered for its centre to be taken.
  [[nodiscard]] double to_beat(Index s) const {
    return front_->reached(s) ? front_->label(s).centre * gain * static_cast<double>(patience_)
                              : infinity;
  }
  bool accept(Index t, std::size_t in, const Label& label, Index source) {
    if (!(label.centre < to_beat(t))) return false;
    front_->accept(t, in, label, static_cast<Real>(label.centre), source);
    prefetch_around(t);
    return true;
  }
  /// The string of a way at the centre of s on to a vertex of it, pulled taut.
  void draw_to_corner(const Label& label, Index s, Index vertex, SimplexString<N>& string) const {
    draw_on(label, s, flat_->positions[vertex], string);
    string.pull(infinity);
  }
  /// The length of a way at the centre of s on to its corner i, +inf beyond `limit`. Has it other
  /// bends there?
  double reach(const Label& label, Index s, std::size_t i, double limit, bool& bent) const {
    using Pulled = typename SimplexString<N>::Pulled;
    const Point& at = flat_->positions[records_[s].corner[i]];
    bent = false;
    if (!any_faces_) return label.sigma + distance_of(label.source, at);
    SimplexString<N> string(*flat_);
    draw_on(label, s, at, string);
    switch (string.pull(limit - label.sigma)) {
      case Pulled::taut:
        bent = string.bends() != label.bends;
        for (std::size_t k = 0; k < label.bends && !bent; ++k)
          bent = string[k + 1].face != label.face[k];
        return label.sigma + string.length();
      case Pulled::longer:
        return infinity;
      case Pulled::stuck:
        break;
    }
    bent = true;
    return label.centre + distance_of(centre(s), at);
  }
  /// A way at the centre of s, over a facet to the centre of t; false beyond `known`.
  bool offer_around(const Label& from, Index s, std::size_t facet, Index t, double known,
                    Label& label) const {
    using Pulled = typename SimplexString<N>::Pulled;
    SimplexString<N> string(*flat_);
    draw(*flat_, from, string);
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
      label = label_of(*flat_, string, from.sigma);
      return label.centre < known;
    }
    // A path all the same: from here on as from a source.
    const double walked = from.centre + (direct ? 0 : distance_of(here, gate));
    label = point_label<N>(direct ? here : gate, walked);
    label.centre = walked + distance_of(label.source, there);
    return label.centre < known;
  }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  static constexpr double gain = 1 - std::max(1e-10, 8. * std::numeric_limits<Real>::epsilon());

  /// The end is held off the vertex, towards s.
  void draw_on(const Label& label, Index s, const Point& at, SimplexString<N>& string) const {
    draw(*flat_, label, string);
    string.add_point(centre(s), centre(s));
    string.add_point(plus(at, flat_->clearance, direction<N>(at, centre(s))), at);
  }
  [[nodiscard]] double least(const Label& label, Index s, const Point& to) const {
    return least_over<N>(*flat_, label, centre(s), to);
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

  /// To the simplex on the other side of a gate.
  void pass(const FaceGate<N>& gate) {
    using Pulled = typename SimplexString<N>::Pulled;
    const Label& from = front_->label(gate.from);
    const Point& there = centre(gate.to);
    const double known = to_beat(gate.to);
    if (!(least(from, gate.from, there) < known)) return;
    SimplexString<N> string(*flat_);
    draw(*flat_, from, string);
    string.add_point(centre(gate.from), centre(gate.from));
    string.add_bend(gate.face, gate.middle);
    if (string.pull(infinity) != Pulled::taut) return;
    string.add_point(there, there);
    if (string.tighten(known - from.sigma) != Pulled::taut) return;
    accept(gate.to, no_facet, label_of(*flat_, string, from.sigma), front_->source(gate.from));
  }

  /// From a vertex to where its simplices are; nowhere, if none is there or only parts touch.
  [[nodiscard]] Point open_direction(Index vertex) const {
    const auto pinched = domain_->pinched();
    if (std::binary_search(pinched.begin(), pinched.end(), vertex)) return Point{};
    Point sum{};
    const Point& at = flat_->positions[vertex];
    for (const Index c : domain_->corners_at(vertex))
      sum = plus(sum, 1., direction<N>(at, centre(c / (N + 1))));
    sum = direction<N>(Point{}, sum);
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
  SimplexVertexWay<N>* ways_;
  SimplexTelling<N>* telling_;
  Real patience_ = 1;
};

}  // namespace plexway
