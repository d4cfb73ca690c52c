#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <plexway/simplicial/detail/simplex_record.hpp>

#include "complexes/common/disjoint_sets.hpp"
#include "complexes/simplicial/flat_domain.hpp"
#include "complexes/simplicial/simplex_shape.hpp"

namespace plexway::detail {

/// Finds whether a complex lies flat in R^N, and where paths may bend in it.
///
/// Flat means: every simplex has volume, two simplices on a facet lie on either side of it, and the
/// complex does not overlap itself. The last is looked for where it would do harm, at the faces on
/// which paths bend, and at some simplices everywhere.
template <class Real, int N>
class FlatDomainBuilder {
 public:
  using Record = SimplexRecord<Real, N>;
  using Layout = SimplexLayout<N>;
  using Point = std::array<double, N>;
  using Face = BendingFace<N>;
  using Rim = BendingRim<N>;
  using Along = typename Face::Along;

  /// Positions by the numbers inside, in units of the mean edge; they are moved to the middle.
  FlatDomainBuilder(std::span<const Record> records, std::vector<Point> positions)
      : records_(records), domain_(std::make_shared<FlatDomain<N>>()) {
    domain_->positions = std::move(positions);
  }

  /// The domain, or nothing if it does not lie flat. Cost: n, and b log b for b boundary facets.
  std::shared_ptr<const FlatDomain<N>> build() {
    to_the_middle();
    if (!lies_flat() || !find_faces()) return nullptr;
    merge_faces(wedges_);
    plant_tree();
    if (overlaps()) return nullptr;
    add_gates();
    return domain_;
  }

 private:
  static constexpr std::size_t K = N - 2;  // dimension of a face
  static constexpr double pi = std::numbers::pi;
  using Piece = std::array<Index, N - 1>;  // vertices of a simplex of dimension N - 2, ascending

  struct Wedge {
    Piece corner;
    Face face;  // without its rims
    Index simplex;
    Index merged = none;  // the face that it is in
  };
  /// What is domain around a piece from one facet of the boundary to another.
  struct Arc {
    Wedge wedge;
    double angle;
    std::size_t in, out;  // facets of the first simplex: the boundary's, and where it goes on
  };

  const Point& position(Index v) const { return domain_->positions[v]; }

  void to_the_middle() {
    Box<N> box = Box<N>::empty();
    for (const Record& r : records_)
      for (const Index v : r.corner) box.add(position(v));
    Point middle;
    double extent = 0;
    for (std::size_t d = 0; d < N; ++d) {
      middle[d] = box.low[d] / 2 + box.high[d] / 2;
      extent = std::max(extent, box.high[d] - middle[d]);
    }
    for (Point& p : domain_->positions) p = minus(p, middle);
    domain_->rounding = 1e-13 + 1e-14 * extent;
  }

  [[nodiscard]] Point centre(const Record& r) const {
    Point c{};
    for (const Index v : r.corner) c = plus(c, 1. / (N + 1), position(v));
    return c;
  }

  /// N! times the signed volume, as a share of the longest edge to the power N.
  [[nodiscard]] double volume(const Record& r) const {
    double edge[N][N], longest = 0;
    for (std::size_t i = 0; i < N; ++i) {
      const Point e = minus(position(r.corner[i + 1]), position(r.corner[0]));
      longest = std::max(longest, inner(e, e));
      for (std::size_t d = 0; d < N; ++d) edge[i][d] = e[d];
    }
    const double scale = std::sqrt(longest);
    double det = 1;
    for (std::size_t i = 0; i < N; ++i) {  // elimination with pivots
      std::size_t row = i;
      for (std::size_t k = i + 1; k < N; ++k)
        if (std::abs(edge[k][i]) > std::abs(edge[row][i])) row = k;
      if (row != i) std::swap_ranges(edge[row], edge[row] + N, edge[i]), det = -det;
      if (edge[i][i] == 0) return 0;
      det *= edge[i][i] / scale;
      for (std::size_t k = i + 1; k < N; ++k)
        for (std::size_t d = N; d-- > i;) edge[k][d] -= edge[k][i] / edge[i][i] * edge[i][d];
    }
    return det;
  }

  bool lies_flat() {
    std::vector<signed char> turned(records_.size());
    for (std::size_t s = 0; s < records_.size(); ++s) {
      const double v = volume(records_[s]);
      if (!(std::abs(v) > 1e-9)) return false;
      turned[s] = v < 0;
    }
    for (std::size_t s = 0; s < records_.size(); ++s)
      for (std::size_t i = 0; i <= N; ++i) {
        const Index across = records_[s].across[i];
        if (across == none) continue;
        if (across & FacetAcross::fan) return false;
        // Corners of the facet come in one order on both sides: the apexes are opposite if the
        // orders of all corners differ by an odd permutation, orientations counted in.
        const std::size_t t = across >> FacetAcross::simplex_shift,
                          j = across & FacetAcross::facet_mask;
        if ((turned[s] ^ turned[t] ^ static_cast<int>((i + j) & 1)) == 0) return false;
      }
    return true;
  }

  /// From each boundary facet around each of its faces to the other boundary facet there.
  bool find_faces() {
    for (std::size_t s = 0; s < records_.size(); ++s)
      for (std::size_t i = 0; i <= N; ++i) {
        if (records_[s].across[i] != none) continue;
        for (std::size_t j = 0; j <= N; ++j)
          if (j != i && !go_around(static_cast<Index>(s), i, j)) return false;
      }
    return true;
  }

  bool go_around(Index s, std::size_t in, std::size_t out) {
    const Index first = static_cast<Index>((N + 1) * s + in);
    const std::size_t first_in = in, first_out = out;
    Wedge wedge;
    wedge.simplex = s;
    for (std::size_t k = 0, n = 0; k <= N; ++k)
      if (k != in && k != out) wedge.corner[n++] = records_[s].corner[k];
    Face& face = wedge.face;
    face.origin = position(wedge.corner[0]);
    for (std::size_t k = 0; k < K; ++k) {
      Point t = minus(position(wedge.corner[k + 1]), face.origin);
      for (std::size_t l = 0; l < k; ++l) t = plus(t, -inner(t, face.tangent[l]), face.tangent[l]);
      face.tangent[k] = unit(t);
    }
    // Of the facet opposite `in` the corner `out` is not in the face, and the other way round.
    const Point x = unit(across(face, records_[s].corner[out]));
    Point y = across(face, records_[s].corner[in]);
    y = unit(plus(y, -inner(y, x), x));
    double angle = 0, before = 0;
    const Index start = s;
    for (std::size_t steps = 0;; ++steps) {
      const Point d = across(face, records_[s].corner[in]);
      const double now = std::atan2(inner(d, y), inner(d, x));
      double turn = now - before;
      if (turn < 0) turn += 2 * pi;
      angle += turn;
      before = now;
      if (angle > 2 * pi + 1e-6) return false;
      const Index to = records_[s].across[out];
      if (to == none) break;
      const Index leaving = records_[s].corner[in];
      s = to >> FacetAcross::simplex_shift;
      in = to & FacetAcross::facet_mask;
      out = 0;
      while (records_[s].corner[out] != leaving) ++out;
      if (s == start && steps > records_.size()) return false;
    }
    // Each arc is met from both its ends.
    if (static_cast<Index>((N + 1) * s + out) < first) return true;
    const double middle = pi + angle / 2;
    face.into = plus(scaled(std::cos(middle), x), std::sin(middle), y);
    face.side = plus(scaled(-std::sin(middle), x), std::cos(middle), y);
    if (angle > pi + 1e-7) wedges_.push_back(wedge);
    arcs_.push_back({wedge, angle, first_in, first_out});
    return true;
  }

  static Point scaled(double by, const Point& a) { return plus(Point{}, by, a); }
  static Point unit(const Point& a) { return scaled(1 / std::sqrt(inner(a, a)), a); }
  Point across(const Face& face, Index v) const {
    Point d = minus(position(v), face.origin);
    for (const Point& t : face.tangent) d = plus(d, -inner(d, t), t);
    return d;
  }

  /// Do two pieces that touch lie on one flat, between the same walls?
  [[nodiscard]] bool same_flat(const Wedge& a, const Wedge& b) const {
    constexpr double close = 1e-9;
    if (distance_of(a.face.into, b.face.into) > close) return false;
    for (const Index v : b.corner) {
      const Point d = minus(position(v), a.face.origin);
      if (std::abs(inner(d, a.face.into)) > close || std::abs(inner(d, a.face.side)) > close)
        return false;
    }
    return true;
  }

  /// A convex piece of a face: its corners by one piece's coordinates, and its measure.
  struct Part {
    Index wedge;
    std::vector<Along> corner;
    double measure;
  };

  /// Makes faces of pieces.
  void merge_faces(std::vector<Wedge>& wedges) {
    const std::size_t count = wedges.size();
    struct Side {
      std::array<Index, N - 1> key;  // the vertices of a side of a piece; none at the end
      Index wedge;
    };
    std::vector<Side> sides;
    DisjointSets groups(count);
    std::vector<std::pair<Index, Index>> touching;
    if constexpr (K > 0) {
      for (std::size_t w = 0; w < count; ++w)
        for (std::size_t out = 0; out < N - 1; ++out) {
          Side side{{}, static_cast<Index>(w)};
          side.key.fill(none);
          for (std::size_t k = 0, n = 0; k < N - 1; ++k)
            if (k != out) side.key[n++] = wedges[w].corner[k];
          sides.push_back(side);
        }
      std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.key != b.key ? a.key < b.key : a.wedge < b.wedge;
      });
      for (std::size_t a = 0; a < sides.size(); ++a)
        for (std::size_t b = a + 1; b < sides.size() && sides[b].key == sides[a].key; ++b)
          if (same_flat(wedges[sides[a].wedge], wedges[sides[b].wedge])) {
            groups.unite(sides[a].wedge, sides[b].wedge);
            touching.emplace_back(sides[a].wedge, sides[b].wedge);
          }
    }
    // Wholes if they are convex, else as many pieces together as stay convex.
    std::vector<std::vector<Index>> members(count);
    std::vector<std::vector<std::pair<Index, Index>>> contacts(count);
    for (Index w = 0; w < count; ++w) members[groups.find(w)].push_back(w);
    for (const auto& pair : touching) contacts[groups.find(pair.first)].push_back(pair);
    for (Index g = 0; g < count; ++g) {
      if (members[g].empty()) continue;
      std::vector<Part> parts;
      Part whole{members[g][0], {}, 0};
      for (const Index w : members[g]) {
        Part part{members[g][0], {}, 0};
        for (const Index v : wedges[w].corner)
          part.corner.push_back(wedges[members[g][0]].face.along_of(position(v)));
        part.measure = hull(part.corner);
        whole.corner.insert(whole.corner.end(), part.corner.begin(), part.corner.end());
        whole.measure += part.measure;
        parts.push_back(std::move(part));
      }
      std::vector<Along> corners = whole.corner;
      if (hull(corners) <= whole.measure * (1 + 1e-9)) {
        whole.corner = corners;
        for (const Index w : members[g]) wedges[w].merged = next_face();
        add_face(wedges, whole);
      } else {
        join(parts, wedges, members[g], contacts[g]);
      }
    }
  }

  void plant_tree() {
    std::vector<Box<N>> boxes;
    for (const Face& face : domain_->faces) {
      Box<N> box = Box<N>::empty();
      if constexpr (K == 0) box.add(face.origin);
      for (const Rim& rim : domain_->rims_of(face)) box.add(face.at(rim.from));
      box.widen(std::max(4e-9, 4e3 * domain_->rounding));
      boxes.push_back(box);
    }
    domain_->tree = BoxTree<N>(boxes);
  }

  /// Keeps the corners of the convex hull, in order, and gives its measure.
  static double hull(std::vector<Along>& corner) {
    if constexpr (K == 0) {
      corner.resize(1);
      return 1;
    } else if constexpr (K == 1) {
      const auto [low, high] = std::minmax_element(corner.begin(), corner.end());
      corner = {*low, *high};
      return corner[1][0] - corner[0][0];
    } else {
      std::sort(corner.begin(), corner.end());
      std::vector<Along> out;
      const auto turn = [](const Along& o, const Along& a, const Along& b) {
        return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
      };
      for (int half = 0; half < 2; ++half) {
        const std::size_t base = out.size();
        for (const Along& c : corner) {
          while (out.size() >= base + 2 && turn(out[out.size() - 2], out.back(), c) <= 1e-11)
            out.pop_back();
          out.push_back(c);
        }
        out.pop_back();
        std::reverse(corner.begin(), corner.end());
      }
      double twice = 0;
      for (std::size_t i = 0; i < out.size(); ++i)
        twice += turn(out[0], out[i], out[(i + 1) % out.size()]);
      corner = out;
      return twice / 2;
    }
  }

  void join(std::vector<Part>& parts, std::vector<Wedge>& wedges, const std::vector<Index>& members,
            const std::vector<std::pair<Index, Index>>& contacts) {
    const auto number = [&](Index w) {
      return static_cast<Index>(std::lower_bound(members.begin(), members.end(), w) -
                                members.begin());
    };
    DisjointSets joined(parts.size());
    for (bool any = true; any;) {
      any = false;
      for (const auto& [v, w] : contacts) {
        const Index a = joined.find(number(v)), b = joined.find(number(w));
        if (a == b) continue;
        std::vector<Along> both = parts[a].corner;
        both.insert(both.end(), parts[b].corner.begin(), parts[b].corner.end());
        const double sum = parts[a].measure + parts[b].measure;
        if (hull(both) > sum * (1 + 1e-9)) continue;
        joined.unite(a, b);
        parts[joined.find(a)].corner = both;
        parts[joined.find(a)].measure = sum;
        any = true;
      }
    }
    std::vector<Index> face(parts.size());
    for (Index p = 0; p < parts.size(); ++p) {
      if (joined.find(p) != p) continue;
      face[p] = next_face();
      add_face(wedges, parts[p]);
    }
    for (Index p = 0; p < parts.size(); ++p) wedges[members[p]].merged = face[joined.find(p)];
  }

  [[nodiscard]] Index next_face() const { return static_cast<Index>(domain_->faces.size()); }
  void add_face(const std::vector<Wedge>& wedges, const Part& part) {
    Face face = wedges[part.wedge].face;
    face.origin_into = inner(face.origin, face.into);
    face.origin_side = inner(face.origin, face.side);
    face.rims_begin = static_cast<Index>(domain_->rims.size());
    if constexpr (K == 1) {
      domain_->rims.push_back({{-1}, -part.corner[0][0], part.corner[0], part.corner[0]});
      domain_->rims.push_back({{1}, part.corner[1][0], part.corner[1], part.corner[1]});
    } else if constexpr (K == 2) {
      for (std::size_t i = 0; i < part.corner.size(); ++i) {
        const Along &a = part.corner[i], &b = part.corner[(i + 1) % part.corner.size()];
        const double length = distance_of(a, b);
        const Along outward = {(b[1] - a[1]) / length, (a[0] - b[0]) / length};
        domain_->rims.push_back({outward, inner(outward, a), a, b});
      }
    }
    face.rims_end = static_cast<Index>(domain_->rims.size());
    domain_->faces.push_back(face);
  }

  /// Where several arcs of domain around one piece touch in it, and all are at most half the way
  /// round (else paths that bend there have it for a corner), paths go from one to another.
  void add_gates() {
    std::sort(arcs_.begin(), arcs_.end(), [](const Arc& a, const Arc& b) {
      if (a.wedge.corner != b.wedge.corner) return a.wedge.corner < b.wedge.corner;
      return b.wedge.face.into < a.wedge.face.into;
    });
    std::vector<Wedge> pieces;
    std::vector<std::size_t> first;  // arc of each piece
    const auto end_of = [&](std::size_t a) {
      std::size_t end = a + 1;
      while (end < arcs_.size() && arcs_[end].wedge.corner == arcs_[a].wedge.corner) ++end;
      return end;
    };
    for (std::size_t a = 0, end; a < arcs_.size(); a = end) {
      end = end_of(a);
      if (end == a + 1 || std::any_of(&arcs_[a], &arcs_[a] + (end - a),
                                      [](const Arc& arc) { return arc.angle > pi + 1e-7; }))
        continue;
      pieces.push_back(arcs_[a].wedge);
      pieces.back().face.gate = true;
      first.push_back(a);
    }
    merge_faces(pieces);
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      Point at{};
      for (const Index v : pieces[p].corner) at = plus(at, 1. / (N - 1), position(v));
      const Along middle = domain_->faces[pieces[p].merged].along_of(at);
      const std::size_t end = end_of(first[p]);
      for (std::size_t a = first[p]; a < end; ++a)
        for (const Index from : simplices_of(arcs_[a]))
          for (std::size_t b = first[p]; b < end; ++b)
            if (b != a)
              for (const Index to : simplices_of(arcs_[b]))
                domain_->gates.push_back({from, to, pieces[p].merged, middle});
    }
    std::stable_sort(domain_->gates.begin(), domain_->gates.end(),
                     [](const auto& a, const auto& b) { return a.from < b.from; });
  }

  [[nodiscard]] std::vector<Index> simplices_of(const Arc& arc) const {
    std::vector<Index> all;
    Index s = arc.wedge.simplex;
    for (std::size_t in = arc.in, out = arc.out;;) {
      all.push_back(s);
      const Index to = records_[s].across[out];
      if (to == none) return all;
      const Index leaving = records_[s].corner[in];
      s = to >> FacetAcross::simplex_shift;
      in = to & FacetAcross::facet_mask;
      out = 0;
      while (records_[s].corner[out] != leaving) ++out;
    }
  }

  /// Is the middle of a piece on which paths bend, or of one simplex in many, inside of a simplex?
  [[nodiscard]] bool overlaps() const {
    struct Probe {
      Point at;
      Index own;  // a simplex, or none
    };
    std::vector<Probe> probes;
    for (const Wedge& w : wedges_) {
      Point p{};
      for (const Index v : w.corner) p = plus(p, 1. / (N - 1), position(v));
      probes.push_back({p, none});
    }
    constexpr std::size_t samples = 256;
    const std::size_t stride = records_.size() / samples + 1;
    for (std::size_t s = 0; s < records_.size(); s += stride)
      probes.push_back({centre(records_[s]), static_cast<Index>(s)});
    std::vector<Box<N>> boxes;
    for (const Probe& probe : probes) boxes.push_back({probe.at, probe.at});
    const BoxTree<N> tree(boxes);
    for (std::size_t s = 0; s < records_.size(); ++s) {
      Box<N> box = Box<N>::empty();
      for (const Index v : records_[s].corner) box.add(position(v));
      bool inside = false;
      tree.search(
          [&](const Box<N>& b) {
            for (std::size_t d = 0; d < N; ++d)
              if (b.low[d] > box.high[d] || b.high[d] < box.low[d]) return false;
            return true;
          },
          [&](Index p) {
            if (probes[p].own != s) inside = inside || holds(records_[s], probes[p].at);
          });
      if (inside) return true;
    }
    return false;
  }

  /// Inside by more than rounding.
  [[nodiscard]] bool holds(const Record& r, const Point& p) const {
    double m[N][N + 1];
    for (std::size_t d = 0; d < N; ++d) {
      for (std::size_t i = 0; i < N; ++i)
        m[d][i] = position(r.corner[i + 1])[d] - position(r.corner[0])[d];
      m[d][N] = p[d] - position(r.corner[0])[d];
    }
    eliminate(m);
    double rest = 1;
    constexpr double least = 1e-6;
    for (std::size_t i = 0; i < N; ++i) {
      const double b = m[i][N] / m[i][i];
      if (b < least) return false;
      rest -= b;
    }
    return rest >= least;
  }

  std::span<const Record> records_;
  std::shared_ptr<FlatDomain<N>> domain_;
  std::vector<Wedge> wedges_;
  std::vector<Arc> arcs_;
};

}  // namespace plexway::detail
