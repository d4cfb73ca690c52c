#include "complex/tet_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace plexway {
namespace {

// A path may bend at an edge with more than pi of solid around it (2 pi inside a metric that is not
// flat). The excess is rounding on flat boundaries of files with seven digits.
constexpr double excess = 1e-5;

using Corners = std::span<const std::array<Index, 4>>;

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index root(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

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
  Finder(std::size_t vertices, Corners corner, Corners across, std::span<const TetPoints> points,
         bool embedded)
      : vertices_(vertices),
        corner_(corner),
        across_(across),
        points_(points),
        embedded_(embedded),
        on_reflex_(vertices, 0) {}

  TetTopology find() {
    find_edges();
    found_.reflex_edges = found_.reflex.size();
    if (embedded_) merge_straight();
    list_by_tet();
    find_vertices();
    return std::move(found_);
  }

 private:
  void find_edges() {
    std::vector<std::size_t> begin(vertices_ + 1, 0);
    for (std::size_t t = 0; t < corner_.size(); ++t)
      for (Index e = 0; e < 6; ++e) {
        const Index a = corner_[t][tet_edge_ends[e][0]], b = corner_[t][tet_edge_ends[e][1]];
        ++begin[std::min(a, b) + 1];
      }
    for (std::size_t v = 0; v < vertices_; ++v) begin[v + 1] += begin[v];
    std::vector<std::pair<Index, std::size_t>> slots(corner_.size() * 6);
    {
      std::vector<std::size_t> cursor(begin.begin(), begin.end() - 1);
      for (std::size_t t = 0; t < corner_.size(); ++t)
        for (Index e = 0; e < 6; ++e) {
          const Index a = corner_[t][tet_edge_ends[e][0]], b = corner_[t][tet_edge_ends[e][1]];
          slots[cursor[std::min(a, b)]++] = {std::max(a, b), 6 * t + e};
        }
    }
    for (std::size_t v = 0; v < vertices_; ++v) {
      const auto first = slots.begin() + static_cast<std::ptrdiff_t>(begin[v]);
      const auto last = slots.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]);
      std::sort(first, last);
      for (auto run = first; run != last;) {
        auto end = run + 1;
        while (end != last && end->first == run->first) ++end;
        around_.clear();
        for (auto s = run; s != end; ++s) around_.push_back(s->second);
        around_edge(static_cast<Index>(v), run->first);
        ++found_.edges;
        run = end;
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
      angle += dihedral(points_[t], i, j, k, l);
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
      angle += dihedral(points_[s / 6], i, j, k, 6 - i - j - k);
    }
    if (angle > 2 * std::numbers::pi + excess) {
      on_reflex_[a] = on_reflex_[b] = 1;
      found_.reflex.emplace_back();
    }
  }

  void add_reflex(Index a, Index b, Index t, Index k, Index u, Index l) {
    const Index edge = static_cast<Index>(found_.reflex.size());
    const TetPoints& p = points_[t];
    found_.reflex.push_back({{p[corner_of(corner_[t], a)], p[corner_of(corner_[t], b)]},
                             {inward_normal(p, k), inward_normal(points_[u], l)},
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
      if (in_a_row(a, b, v)) rows.join(ends[i].second, ends[i + 1].second);
    }
    std::vector<Index> merged(found_.reflex.size());
    std::vector<TetTopology::Reflex> kept;
    for (Index e = 0; e < found_.reflex.size(); ++e) {
      if (rows.root(e) == e) {  // roots are the lowest of their row
        merged[e] = static_cast<Index>(kept.size());
        kept.push_back(found_.reflex[e]);
        continue;
      }
      merged[e] = merged[rows.root(e)];
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
    std::vector<char> on_boundary(vertices_, 0);
    for (std::size_t t = 0; t < corner_.size(); ++t)
      for (Index k = 0; k < 4; ++k)
        if (across_[t][k] == none)
          for (Index i = 0; i < 4; ++i)
            if (i != k) on_boundary[corner_[t][i]] = 1;
    DisjointSets fans(corner_.size() * 4), solids(corner_.size());
    for (Index t = 0; t < corner_.size(); ++t)
      for (Index k = 0; k < 4; ++k) {
        const Index o = across_[t][k];
        if (o == none || o / 4 < t) continue;
        solids.join(t, o / 4);
        for (Index i = 0; i < 4; ++i)
          if (i != k && on_boundary[corner_[t][i]])
            fans.join(4 * t + i, o - o % 4 + corner_of(corner_[o / 4], corner_[t][i]));
      }
    for (const auto& edge : found_.pinched_edges)
      for (Index n = edge.begin + 1; n < edge.end; ++n) {
        const Index t = found_.pinched_edge_tets[n - 1], u = found_.pinched_edge_tets[n];
        solids.join(t, u);
        for (const Index v : edge.vertex)
          fans.join(4 * t + corner_of(corner_[t], v), 4 * u + corner_of(corner_[u], v));
      }
    std::vector<Index> first(vertices_, none);
    std::vector<char> pinched(vertices_, 0);
    for (Index t = 0; t < corner_.size(); ++t)
      for (Index i = 0; i < 4; ++i) {
        const Index v = corner_[t][i];
        if (!on_boundary[v]) continue;
        if (first[v] == none) first[v] = 4 * t + i;
        if (fans.root(4 * t + i) != fans.root(first[v])) {
          pinched[v] = 1;
          solids.join(t, first[v] / 4);
        }
      }
    for (Index v = 0; v < vertices_; ++v) {
      if (pinched[v]) found_.pinched_vertices.push_back(v);
      found_.reflex_vertices += on_reflex_[v] || pinched[v];
    }
    for (Index t = 0; t < corner_.size(); ++t) found_.components += solids.root(t) == t;
  }

  std::size_t vertices_;
  Corners corner_, across_;
  std::span<const TetPoints> points_;
  bool embedded_;
  std::vector<char> on_reflex_;
  std::vector<std::size_t> around_;
  std::vector<std::pair<Index, Index>> fan_, entries_;
  TetTopology found_;
};

}  // namespace

TetTopology find_tet_topology(std::size_t vertices, std::span<const std::array<Index, 4>> corner,
                              std::span<const std::array<Index, 4>> across,
                              std::span<const TetPoints> points, bool embedded) {
  return Finder(vertices, corner, across, points, embedded).find();
}

}  // namespace plexway
