#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include <plexway/simplicial/detail/simplex_record.hpp>
#include <plexway/solve/options.hpp>

#include "kernel/hinge.hpp"
#include "labels/simplicial/simplex_label.hpp"

namespace plexway {

/// Squared distances, in the unit inside, of a point from the corners of a record, by its
/// barycentric coordinates there: sum b_j l_ij^2 - sum b_j b_k l_jk^2.
template <class Real, int N>
std::array<double, N + 1> corner_distances2(const SimplexRecord<Real, N>& record,
                                            std::span<const double, N + 1> b) {
  using Layout = SimplexLayout<N>;
  std::array<double, N + 1> distance2{};
  double inner = 0;
  for (std::size_t j = 0; j <= N; ++j)
    for (std::size_t k = 0; k < j; ++k) {
      const double l2 = static_cast<double>(record.length2[Layout::edge(k, j)]);
      inner += b[j] * b[k] * l2;
      distance2[j] += b[k] * l2;
      distance2[k] += b[j] * l2;
    }
  for (double& d : distance2) d = std::max(d - inner, 0.);
  return distance2;
}

/// The plain step on N-simplices glued over facets: the hinge kernel with K = N - 1, word for word,
/// on labels that hold nothing but squared lengths. Policies: upper_bound aims at the apex, every
/// other at the centroid.
///
/// If the straight line from S to the probe passes the facet, S is kept; if not, the path bends on
/// the facet's boundary. Every offer counts, also where the domain is flat and another strip of
/// simplices will bring a straight line: that one then wins. Where a line passes a facet's boundary
/// exactly, as in grids, rounding must not decide: lines may miss by `tolerance`, and a bend is
/// made longer by more than rounding, so that of equal paths the straight one wins.
template <class Real, int N, class Front>
class PlainSimplexRule {
 public:
  static constexpr int K = N - 1;
  using Label = SimplexLabel<Real, N>;
  using Record = SimplexRecord<Real, N>;
  using Layout = SimplexLayout<N>;
  using Kernel = kernel::HingeKernel<Real, K>;
  using Pose = typename Kernel::HingePose;
  using Point = typename Kernel::HingePoint;
  /// A source's simplex came in by no facet.
  static constexpr std::size_t no_facet = FacetAcross::facet_mask;

  PlainSimplexRule(const Record* records, Front& front, Visibility policy)
      : records_(records), front_(front), to_apex_(policy == Visibility::upper_bound) {}

  [[nodiscard]] Real distance(Index s) const { return front_.label(s).centre; }
  [[nodiscard]] Real distance_or_inf(Index s) const {
    return front_.reached(s) ? distance(s) : std::numeric_limits<Real>::infinity();
  }
  [[nodiscard]] Real corner_distance(Index s, std::size_t i) const {
    return front_.label(s).sigma + std::sqrt(front_.label(s).distance2[i]);
  }

  /// An update counts if the centre is nearer than this share of its distance. 1 but where lengths
  /// of no flat simplices would have it go on for ever.
  void set_patience(Real share) { patience_ = share; }

  /// Offers to all neighbours but the one the path came from.
  void expand(Index s) {
    const std::size_t in = front_.hinge(s);
    for (std::size_t i = 0; i <= N; ++i)
      if (i != in) cross(s, i);
  }

  /// Over one facet, to every simplex there.
  void cross(Index s, std::size_t facet) {
    for (Index across = records_[s].across[facet]; across != none;) {
      const Index t = across >> FacetAcross::simplex_shift;
      const std::size_t j = across & FacetAcross::facet_mask;
      if (t == s) break;  // once around
      enter(s, facet, t, j);
      if (!(across & FacetAcross::fan)) break;
      across = records_[t].across[j];
    }
  }

  bool seed_corner(Index s, std::size_t i, Real sigma, Index source) {
    Label label;
    for (std::size_t k = 0; k <= N; ++k)
      label.distance2[k] = k == i ? Real(0) : records_[s].length2[Layout::edge(i, k)];
    label.sigma = sigma;
    return offer(s, no_facet, label, source);
  }

  /// A point of a simplex, by its barycentric coordinates.
  bool seed_inside(Index s, std::span<const double, N + 1> barycentric, Real sigma, Index source) {
    const auto distance2 = corner_distances2<Real, N>(records_[s], barycentric);
    Label label;
    for (std::size_t k = 0; k <= N; ++k) label.distance2[k] = static_cast<Real>(distance2[k]);
    label.sigma = sigma;
    return offer(s, no_facet, label, source);
  }

 private:
  static constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
  static constexpr Real tolerance = sizeof(Real) == 4 ? Real(2e-4) : Real(1e-9);
  static constexpr Real longer = K == 0 ? Real(1) : 1 + 32 * epsilon;

  /// Leibniz: the mean squared distance from the corners less that of the centroid.
  static void measure(const Record& t, Label& label) {
    Real edges = 0, mean = 0;
    for (const Real l : t.length2) edges += l;
    for (const Real d : label.distance2) mean += d;
    constexpr Real share = Real(1) / Layout::corners;
    label.centre = label.sigma + std::sqrt(std::max((mean - edges * share) * share, Real(0)));
  }

  [[nodiscard]] bool is_better(Index t, const Label& label) const {
    return label.centre < patience_ * distance_or_inf(t);
  }

  bool offer(Index t, std::size_t in, Label& label, Index source) {
    measure(records_[t], label);
    if (!is_better(t, label)) return false;
    front_.accept(t, in, label, label.centre, source);
    prefetch(records_[t]);
    return true;
  }

  static void prefetch_lines(const Record& t) {
    const char* record = reinterpret_cast<const char*>(&t);
    for (std::size_t line = 0; line < sizeof(Record); line += 64) __builtin_prefetch(record + line);
  }
  void prefetch(const Record& t) const {
    for (const Index across : t.across) {
      const Index a = across == none ? 0 : across >> FacetAcross::simplex_shift;
      prefetch_lines(records_[a]);
      __builtin_prefetch(&front_.label(a));
    }
  }

  void enter(Index s, std::size_t i, Index t, std::size_t j) {
    const Record &U = records_[s], &T = records_[t];
    const Label& from = front_.label(s);
    constexpr auto& tables = Layout::tables;

    Real edge2[Kernel::KE] = {}, s2[N], apex2[N];
    for (std::size_t e = 0; e < Layout::facet_edges; ++e)
      edge2[e] = T.length2[tables.facet_edge[j][e]];
    for (std::size_t k = 0; k < N; ++k) {
      s2[k] = from.distance2[Layout::corner(i, k)];
      apex2[k] = T.length2[tables.spoke[j][k]];
    }
    const Pose pose = Kernel::make_pose(edge2);
    const Point S = Kernel::locate(pose, s2), apex = Kernel::locate(pose, apex2);

    // Straight, through I or past it: no bend makes it shorter.
    Label label;
    for (std::size_t k = 0; k < N; ++k) label.distance2[Layout::corner(j, k)] = s2[k];
    label.distance2[j] = Kernel::distance_squared(pose, S, apex);
    label.sigma = from.sigma;
    measure(T, label);
    if (!is_better(t, label)) return;

    Real u2[N];
    for (std::size_t k = 0; k < N; ++k) u2[k] = U.length2[tables.spoke[i][k]];
    const bool behind = Kernel::behind(pose, S, Kernel::locate(pose, u2), from.distance2[i]) > 0;
    const auto step = Kernel::carry(pose, S, from.sigma, to_apex_ ? apex : centroid(pose, apex),
                                    behind, tolerance);
    if (!step.visible) {
      const Point& B = step.source;
      label.sigma = from.sigma + (step.sigma - from.sigma) * longer;
      for (std::size_t k = 0; k < N; ++k)
        label.distance2[Layout::corner(j, k)] =
            Kernel::distance_squared(pose, B, Kernel::vertex_point(pose, static_cast<int>(k)));
      label.distance2[j] = Kernel::distance_squared(pose, B, apex);
    }
    offer(t, j, label, front_.source(s));
  }

  static Point centroid(const Pose& pose, const Point& apex) {
    Point c = apex;
    for (int k = 0; k <= K; ++k)
      for (int x = 0; x < K; ++x) c.x[x] += pose.vertex[k * Kernel::KX + x];
    for (int x = 0; x < K; ++x) c.x[x] /= N + 1;
    c.h /= N + 1;
    return c;
  }

  const Record* records_;
  Front& front_;
  bool to_apex_;
  Real patience_ = 1;
};

}  // namespace plexway
