#include "complex/tet_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "complex/simplex_gluing.hpp"

namespace plexway {
namespace {

// A path may bend at an edge with more than pi of solid around it (2 pi inside a metric that is not
// flat). The excess is rounding on flat boundaries of files with seven digits.
constexpr double excess = 1e-5;

using Corners = std::span<const std::array<Index, 4>>;

Index corner_of(const std::array<Index, 4>& corner, Index vertex) {
  return static_cast<Index>(std::find(corner.begin(), corner.end(), vertex) - corner.begin());
}

double dihedral(const TetPoints& p, Index i, Index j, Index k, Index l) {
  const auto edge = p[j] - p[i];
  const auto a = cross(edge, p[k] - p[i]), b = cross(edge, p[l] - p[i]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

Vector3<double> inward_normal(const TetPoints& p, Index face) {
  constexpr Index order[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // seen from outside
  const auto& [a, b, c] = order[face];
  const auto n = cross(p[c] - p[a], p[b] - p[a]);
  const double length = norm(n);
  return length > 0 ? 1 / length * n : n;
}

class Finder {
 public:
  Finder(Corners corner, Corners across, const TetCorners& corners, const TetPlaces& places)
      : vertices_(corners.begin.size() - 1),
        corner_(corner),
        across_(across),
        corners_(corners),
        places_(places),
        embedded_(places.embedded()),
        on_reflex_(vertices_, 0) {}

  TetTopology find() {
    mark_boundary();
    count_edges();
    look_around_edges();
    found_.reflex_edges = found_.reflex.size();
    if (embedded_) merge_straight();
    list_by_tet();
    find_vertices();
    return std::move(found_);
  }

 private:
  [[nodiscard]] TetPoints points(std::size_t t) const { return places_.of(t, corner_[t]); }
  [[nodiscard]] std::span<const Index> corners_at(Index v) const {
    return std::span(corners_.corner).subspan(corners_.begin[v],
                                              corners_.begin[v + 1] - corners_.begin[v]);
  }

  void mark_boundary() {
    on_boundary_.assign(vertices_, 0);
    for (std::size_t t = 0; t < corner_.size(); ++t)
      for (std::size_t k = 0; k < 4; ++k)
        if (across_[t][k] == none)
          for (std::size_t i = 0; i < 4; ++i)
            if (i != k) on_boundary_[corner_[t][i]] = 1;
  }

  void count_edges() {
    std::vector<Index> seen(vertices_, none);  // the last lower vertex that it shared an edge with
    for (Index v = 0; v < vertices_; ++v)
      for (const Index c : corners_at(v))
        for (const Index w : corner_[c / 4]) {
          found_.edges += w > v && seen[w] != v;
          if (w > v) seen[w] = v;
        }
  }

  // In ascending order of their ends. Where all is in one frame paths bend at the boundary only.
  void look_around_edges() {
    std::vector<Index> ends;
    for (Index v = 0; v < vertices_; ++v) {
      if (embedded_ && !on_boundary_[v]) continue;
      ends.clear();
      for (const Index c : corners_at(v)) {
        const auto& corner = corner_[c / 4];
        for (std::size_t k = 0; k < 4; ++k) {
          if (embedded_ && (k == c % 4 || across_[c / 4][k] != none)) continue;
          for (std::size_t i = 0; i < 4; ++i)
            if (i != k && corner[i] > v) ends.push_back(corner[i]);
        }
      }
      std::sort(ends.begin(), ends.end());
      ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
      for (const Index w : ends) {
        around_.clear();
        for (const Index c : corners_at(v))
          if (const Index j = corner_of(corner_[c / 4], w); j < 4)
            around_.push_back(6 * std::size_t{c / 4} + tet_edge(c % 4, j));
        around_edge(v, w);
      }
    }
  }

  // The fans of tetrahedra around one edge, each from boundary to boundary or closed.
  void around_edge(Index a, Index b) {
    bool any_boundary = false;
    for (const std::size_t s : around_) {
      const std::size_t t = s / 6;
      const Index i = tet_edge_ends[s % 6][0], j = tet_edge_ends[s % 6][1];
      for (Index k = 0; k < 4; ++k) any_boundary |= k != i && k != j && across_[t][k] == none;
    }
    if (!any_boundary && embedded_) return;
    std::size_t fans = 0, seen = 0;
    if (any_boundary)
      for (const std::size_t s : around_) {
        const Index t = static_cast<Index>(s / 6);
        const Index i = tet_edge_ends[s % 6][0], j = tet_edge_ends[s % 6][1];
        Index k = 0;
        while (k == i || k == j) ++k;
        const Index l = 6 - i - j - k;
        // From each boundary face; a fan is seen from both its ends and counts from the lower.
        if (across_[t][k] == none) seen += walk(t, k, l, a, b, fans);
        if (across_[t][l] == none) seen += walk(t, l, k, a, b, fans);
      }
    if (seen < around_.size()) {
      fans += 1;  // what is left is closed; more than one such fan only under a strange metric
      if (!embedded_) closed(a, b);
    }
    if (fans > 1) {
      const Index begin = static_cast<Index>(found_.pinched_edge_tets.size());
      for (const std::size_t s : around_)
        found_.pinched_edge_tets.push_back(static_cast<Index>(s / 6));
      found_.pinched_edges.push_back(
          {{a, b}, begin, static_cast<Index>(found_.pinched_edge_tets.size())});
    }
  }

  // Starts at boundary face k of tetrahedron t and leaves by face l.
  std::size_t walk(Index t, Index k, Index l, Index a, Index b, std::size_t& fans) {
    const Index first_tet = t, first_face = k;
    double angle = 0;
    fan_.clear();
    for (;;) {
      const Index i = corner_of(corner_[t], a), j = corner_of(corner_[t], b);
      angle += dihedral(points(t), i, j, k, l);
      fan_.push_back({t, tet_edge(i, j)});
      const Index o = across_[t][l];
      if (o == none) break;
      const Index shared = corner_[t][k];
      t = o / 4;
      k = o % 4;
      l = corner_of(corner_[t], shared);
    }
    // A single tetrahedron is met from both faces too: told apart by the face.
    if (std::pair(t, l) < std::pair(first_tet, first_face)) return 0;
    ++fans;
    if (angle > std::numbers::pi + excess) add_reflex(a, b, first_tet, first_face, t, l);
    return fan_.size();
  }

  void closed(Index a, Index b) {
    double angle = 0;
    for (const std::size_t s : around_) {
      const Index i = tet_edge_ends[s % 6][0], j = tet_edge_ends[s % 6][1];
      Index k = 0;
      while (k == i || k == j) ++k;
      angle += dihedral(points(s / 6), i, j, k, 6 - i - j - k);
    }
    if (angle > 2 * std::numbers::pi + excess) {
      on_reflex_[a] = on_reflex_[b] = 1;
      found_.reflex.emplace_back();
    }
  }

  void add_reflex(Index a, Index b, Index t, Index k, Index u, Index l) {
    const Index edge = static_cast<Index>(found_.reflex.size());
    const TetPoints p = points(t);
    found_.reflex.push_back({{p[corner_of(corner_[t], a)], p[corner_of(corner_[t], b)]},
                             {inward_normal(p, k), inward_normal(points(u), l)},
                             {a, b}});
    on_reflex_[a] = on_reflex_[b] = 1;
    for (const auto& [tet, slot] : fan_)
      entries_.push_back({tet, edge << ReflexEntry::edge_shift | slot << ReflexEntry::slot_shift});
  }

  // Edges in a straight row, between the same planes, are one to a path.
  void merge_straight() {
    std::vector<std::pair<Index, Index>> ends;
    for (Index e = 0; e < found_.reflex.size(); ++e)
      for (const Index v : found_.reflex[e].vertex) ends.push_back({v, e});
    std::sort(ends.begin(), ends.end());
    DisjointSets rows(found_.reflex.size());
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      const Index v = ends[i].first;
      if (ends[i + 1].first != v || (i > 0 && ends[i - 1].first == v) ||
          (i + 2 < ends.size() && ends[i + 2].first == v))
        continue;
      const TetTopology::Reflex &a = found_.reflex[ends[i].second],
                                &b = found_.reflex[ends[i + 1].second];
      if (in_a_row(a, b, v)) rows.unite(ends[i].second, ends[i + 1].second);
    }
    std::vector<Index> merged(found_.reflex.size());
    std::vector<TetTopology::Reflex> kept;
    for (Index e = 0; e < found_.reflex.size(); ++e) {
      if (rows.find(e) == e) {  // roots are the lowest of their row
        merged[e] = static_cast<Index>(kept.size());
        kept.push_back(found_.reflex[e]);
        continue;
      }
      merged[e] = merged[rows.find(e)];
      TetTopology::Reflex& row = kept[merged[e]];
      const TetTopology::Reflex& edge = found_.reflex[e];
      const auto u = row.end[1] - row.end[0];
      for (std::size_t i = 0; i < 2; ++i) {
        const double along = dot(edge.end[i] - row.end[0], u) / dot(u, u);
        if (along >= 0 && along <= 1) continue;
        const std::size_t side = along < 0 ? 0 : 1;
        row.end[side] = edge.end[i], row.vertex[side] = edge.vertex[i];
      }
    }
    found_.reflex = std::move(kept);
    for (auto& [tet, packed] : entries_)
      packed = merged[packed >> ReflexEntry::edge_shift] << ReflexEntry::edge_shift |
               (packed & ((1u << ReflexEntry::edge_shift) - 1));
  }

  static bool in_a_row(const TetTopology::Reflex& a, const TetTopology::Reflex& b, Index v) {
    const std::size_t i = a.vertex[0] == v ? 0 : 1, j = b.vertex[0] == v ? 0 : 1;
    const auto u = a.end[i] - a.end[1 - i], w = b.end[1 - j] - b.end[j];
    constexpr double near = 1e-6;
    if (!(dot(u, w) > 0) || !(norm(cross(u, w)) < near * dot(u, w))) return false;
    const auto same = [](const Vector3<double>& m, const Vector3<double>& n) {
      return norm(m - n) < near;
    };
    return (same(a.normal[0], b.normal[0]) && same(a.normal[1], b.normal[1])) ||
           (same(a.normal[0], b.normal[1]) && same(a.normal[1], b.normal[0]));
  }

  void list_by_tet() {
    std::sort(entries_.begin(), entries_.end());
    found_.first_reflex.assign(corner_.size(), none);
    for (std::size_t e = 0; e < entries_.size(); ++e) {
      const auto [tet, packed] = entries_[e];
      if (e == 0 || entries_[e - 1].first != tet) found_.first_reflex[tet] = static_cast<Index>(e);
      const bool last = e + 1 == entries_.size() || entries_[e + 1].first != tet;
      found_.reflex_list.push_back(packed | (last ? ReflexEntry::last : 0));
    }
  }

  // Tetrahedra at a vertex that are joined neither by faces nor by edges there touch in it only.
  void find_vertices() {
    // Of the corners on the boundary alone: the others' fans are whole.
    std::vector<Index> number(vertices_, none);
    Index count = 0;
    for (Index v = 0; v < vertices_; ++v) {
      if (!on_boundary_[v]) continue;
      number[v] = count;
      count += corners_.begin[v + 1] - corners_.begin[v];
    }
    DisjointSets fans(count), solids(corner_.size());
    const auto fan = [&](Index v, Index corner) {
      const auto row = corners_at(v);
      return number[v] +
             static_cast<Index>(std::lower_bound(row.begin(), row.end(), corner) - row.begin());
    };
    for (Index t = 0; t < corner_.size(); ++t) {
      const auto& corner = corner_[t];
      const bool touches = (on_boundary_[corner[0]] | on_boundary_[corner[1]] |
                            on_boundary_[corner[2]] | on_boundary_[corner[3]]) != 0;
      for (Index k = 0; k < 4; ++k) {
        const Index o = across_[t][k];
        if (o == none || o / 4 < t) continue;
        solids.unite(t, o / 4);
        if (!touches) continue;
        for (Index i = 0; i < 4; ++i)
          if (const Index v = corner[i]; i != k && on_boundary_[v])
            fans.unite(fan(v, 4 * t + i), fan(v, o - o % 4 + corner_of(corner_[o / 4], v)));
      }
    }
    for (const auto& edge : found_.pinched_edges)
      for (Index n = edge.begin + 1; n < edge.end; ++n) {
        const Index t = found_.pinched_edge_tets[n - 1], u = found_.pinched_edge_tets[n];
        solids.unite(t, u);
        for (const Index v : edge.vertex)
          fans.unite(fan(v, 4 * t + corner_of(corner_[t], v)),
                     fan(v, 4 * u + corner_of(corner_[u], v)));
      }
    for (Index v = 0; v < vertices_; ++v) {
      bool pinched = false;
      if (on_boundary_[v]) {
        const auto row = corners_at(v);
        for (Index n = 1; n < row.size(); ++n) {
          if (fans.find(number[v] + n) == fans.find(number[v])) continue;
          pinched = true;
          solids.unite(row[n] / 4, row[0] / 4);
        }
      }
      if (pinched) found_.pinched_vertices.push_back(v);
      found_.reflex_vertices += on_reflex_[v] || pinched;
    }
    for (Index t = 0; t < corner_.size(); ++t) found_.components += solids.find(t) == t;
  }

  std::size_t vertices_;
  Corners corner_, across_;
  const TetCorners& corners_;
  const TetPlaces& places_;
  bool embedded_;
  std::vector<char> on_reflex_, on_boundary_;
  std::vector<std::size_t> around_;
  std::vector<std::pair<Index, Index>> fan_, entries_;
  TetTopology found_;
};

}  // namespace

TetCorners corners_of_vertices(std::size_t vertices, Corners corner) {
  TetCorners rows;
  rows.begin.assign(vertices + 1, 0);
  for (const auto& tet : corner)
    for (const Index v : tet) ++rows.begin[v + 1];
  for (std::size_t v = 0; v < vertices; ++v) rows.begin[v + 1] += rows.begin[v];
  rows.corner.resize(4 * corner.size());
  std::vector<Index> cursor(rows.begin.begin(), rows.begin.end() - 1);
  for (std::size_t t = 0; t < corner.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i)
      rows.corner[cursor[corner[t][i]]++] = static_cast<Index>(4 * t + i);
  return rows;
}

TetTopology find_tet_topology(Corners corner, Corners across, const TetCorners& corners,
                              const TetPlaces& places) {
  return Finder(corner, across, corners, places).find();
}

}  // namespace plexway
