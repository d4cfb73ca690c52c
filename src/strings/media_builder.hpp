#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "complexes/common/disjoint_sets.hpp"
#include "strings/media_space.hpp"

/// How a MediaSpace is made: media first, then the places where strings go from one to another.
namespace plexway::detail::strings {
using Triple = std::array<Index, 3>;
using Edge = std::array<Index, 2>;
inline Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }
inline Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}
inline void add(std::vector<Index>& list, Index item) {
  const auto at = std::lower_bound(list.begin(), list.end(), item);
  if (at == list.end() || *at != item) list.insert(at, item);
}

struct MediaSpace::Builder {
  static constexpr double unbounded = std::numeric_limits<double>::infinity();
  static constexpr double same = 1e-7;  // directions and normals differ by less

  Builder(MediaSpace& s, const Parts& p) : space(s), parts(p) {}

  MediaSpace& space;
  const Parts& parts;
  std::vector<Point>& points = space.points_;
  std::vector<Index> medium_of_tet, medium_of_face, medium_of_edge;
  std::vector<Index> covered;  // by faces: covered_by
  std::vector<Triple> faces;   // the others
  std::vector<double> slow_faces;

  // A triangle between two media, or of a sheet.
  struct Interface {
    Triple corner;
    Point normal;
    Index above = none, below = none;  // media of the solids
    std::vector<Index> media;          // all of them
    Index patch = none;
  };
  std::vector<Interface> interfaces;
  struct Line {  // an edge where patches end, or a wire
    Edge end;
    std::vector<Index> media, patches;
    std::vector<std::pair<Index, Boundary::Wedge>> wedges;  // of media
    bool is_wire = false;
    Index row = none;
  };
  std::vector<Line> lines;
  std::map<Edge, Index> line_at;

  void build() {
    scale();
    find_media();
    find_interfaces();
    find_patches();
    find_lines();
    find_rows();
    make_places();
    number_simplices();
  }
  void number_simplices() {
    auto& all = space.simplices_;
    for (Index t = 0; t < parts.tets.size(); ++t) all.push_back({parts.tets[t], medium_of_tet[t]});
    for (Index f = 0, sheet = 0; f < parts.faces.size(); ++f) {
      const auto& c = parts.faces[f];
      const Index medium = covered[f] == none ? medium_of_face[sheet++] : medium_of_tet[covered[f]];
      all.push_back({{c[0], c[1], c[2], none}, medium});
    }
    for (Index e = 0; e < parts.edges.size(); ++e)
      all.push_back({{parts.edges[e][0], parts.edges[e][1], none, none}, medium_of_edge[e]});
    auto& begin = space.around_begin_;
    begin.assign(points.size() + 1, 0);
    const auto each = [&](const auto& visit) {
      for (Index s = 0; s < all.size(); ++s)
        for (const Index v : all[s].corner)
          if (v != none) visit(s, v);
    };
    each([&](Index, Index v) { ++begin[v + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    space.around_.resize(begin.back());
    std::vector<Index> next(begin);
    each([&](Index s, Index v) { space.around_[next[v]++] = s; });
  }

  [[nodiscard]] static bool alike(const Point& a, const Point& b) {
    const Point d = a - b;
    return dot(d, d) < same * same;
  }
  [[nodiscard]] Point normal_of(const Triple& t) const {
    return strings::unit(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]));
  }

  void scale() {
    Point low = {unbounded, unbounded, unbounded}, high = -1. * low;
    double sum = 0;
    std::size_t count = 0;
    const auto length = [&](Index a, Index b) {
      sum += norm(parts.points[a] - parts.points[b]);
      ++count;
      for (const Index v : {a, b}) {
        const Point& p = parts.points[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
      }
    };
    for (const auto& t : parts.tets)
      for (const auto& e : tet_edge_ends) length(t[e[0]], t[e[1]]);
    for (const auto& t : parts.faces)
      for (std::size_t k = 0; k < 3; ++k) length(t[k], t[(k + 1) % 3]);
    for (const auto& e : parts.edges) length(e[0], e[1]);
    space.unit_ = sum > 0 ? sum / double(count) : 1;
    const Point middle = space.middle_ = .5 * (low + high);
    points.clear();
    for (const Point& p : parts.points) points.push_back(1 / space.unit_ * (p - middle));
  }

  void find_media() {
    covered = covered_by(parts);
    for (Index f = 0; f < parts.faces.size(); ++f)
      if (covered[f] == none) {
        faces.push_back(parts.faces[f]);
        slow_faces.push_back(parts.slow_faces[f]);
      }
    find_solids();
    find_sheets();
    find_wires();
    space.nodes_begin_.assign(points.size() + 1, 0);
    for (Medium& m : space.media_) {
      m.first_node = static_cast<Index>(space.medium_of_.size());
      space.medium_of_.insert(space.medium_of_.end(), m.points.size(),
                              static_cast<Index>(&m - space.media_.data()));
      for (const Index p : m.points) ++space.nodes_begin_[p + 1];
    }
    std::partial_sum(space.nodes_begin_.begin(), space.nodes_begin_.end(),
                     space.nodes_begin_.begin());
    space.nodes_.resize(space.medium_of_.size());
    std::vector<Index> next(space.nodes_begin_);
    for (const Medium& m : space.media_)
      for (Index n = 0; n < m.points.size(); ++n)
        space.nodes_[next[m.points[n]]++] = m.first_node + n;
  }
  std::vector<std::pair<Triple, Index>> tets_at;  // of faces, ascending
  template <class Visit>                          // visit(face, tetrahedra)
  void each_face(const Visit& visit) const {
    std::vector<Index> tets;
    for (std::size_t i = 0, j = 0; i < tets_at.size(); i = j) {
      tets.clear();
      for (; j < tets_at.size() && tets_at[j].first == tets_at[i].first; ++j)
        tets.push_back(tets_at[j].second);
      visit(tets_at[i].first, tets);
    }
  }
  void find_solids() {
    tets_at.reserve(4 * parts.tets.size());
    for (Index t = 0; t < parts.tets.size(); ++t)
      for (std::size_t i = 0; i < 4; ++i) {
        const auto& c = parts.tets[t];
        tets_at.push_back({sorted({c[(i + 1) % 4], c[(i + 2) % 4], c[(i + 3) % 4]}), t});
      }
    std::sort(tets_at.begin(), tets_at.end());
    DisjointSets sets(parts.tets.size());
    each_face([&](const Triple&, const std::vector<Index>& tets) {
      for (const Index t : tets)
        if (parts.slow_tets[t] == parts.slow_tets[tets[0]]) sets.unite(tets[0], t);
    });
    medium_of_tet.assign(parts.tets.size(), none);
    std::vector<std::vector<Index>> members;
    for (Index t = 0; t < parts.tets.size(); ++t) {
      const Index r = sets.find(t);
      if (r == t) {
        medium_of_tet[t] = static_cast<Index>(members.size());
        members.emplace_back();
      }
      members[medium_of_tet[t] = medium_of_tet[r]].push_back(t);
    }
    std::vector<Index> number(points.size(), none);
    for (const auto& tets : members) {
      std::vector<Index> used;
      std::vector<std::array<double, 3>> places;
      std::vector<std::array<Index, 4>> own;
      for (const Index t : tets) {
        own.push_back(parts.tets[t]);
        for (Index& v : own.back()) {
          if (number[v] == none) {
            number[v] = static_cast<Index>(used.size());
            used.push_back(v);
            places.push_back({points[v].x, points[v].y, points[v].z});
          }
          v = number[v];
        }
      }
      const TetMesh<double> mesh(places, own, 1);
      Medium medium{parts.slow_tets[tets[0]], true, nullptr, {}, 0, 0, {}, {}, {}};
      medium.points.resize(used.size());
      std::vector<Point> inside(used.size());
      for (Index v = 0; v < used.size(); ++v) {
        medium.points[mesh.inside_vertex(v)] = used[v];
        inside[mesh.inside_vertex(v)] = points[used[v]];
        number[used[v]] = none;
      }
      medium.room = std::make_shared<const SolidSpace>(mesh, std::move(inside));
      space.media_.push_back(std::move(medium));
    }
  }
  // What joins simplices of a lower dimension to a medium: they share a face, and go straight on.
  template <std::size_t K>
  void find_flat(const std::vector<std::array<Index, K>>& simplices,
                 const std::vector<double>& slowness, std::vector<Index>& medium_of) {
    std::map<std::vector<Index>, std::vector<Index>> at;
    for (Index s = 0; s < simplices.size(); ++s)
      for (std::size_t i = 0; i < K; ++i) {
        std::vector<Index> face;
        for (std::size_t j = 0; j < K; ++j)
          if (j != i) face.push_back(simplices[s][j]);
        std::sort(face.begin(), face.end());
        at[face].push_back(s);
      }
    const auto straight = [&](Index a, Index b, const std::vector<Index>& face) {
      if (slowness[a] != slowness[b]) return false;
      const auto off = [&](Index s) {  // square to the face
        for (const Index v : simplices[s]) {
          if (std::find(face.begin(), face.end(), v) != face.end()) continue;
          Point d = points[v] - points[face[0]];
          if (K == 3) {
            const Point along = strings::unit(points[face[K - 2]] - points[face[0]]);
            d = d - dot(d, along) * along;
          }
          return strings::unit(d);
        }
        return Point{0, 0, 0};
      };
      return alike(off(a), -1. * off(b));
    };
    DisjointSets sets(simplices.size());
    for (const auto& [face, all] : at)
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
          if (straight(all[i], all[j], face)) sets.unite(all[i], all[j]);
    medium_of.assign(simplices.size(), none);
    const std::size_t first = space.media_.size();
    std::vector<std::map<Index, std::vector<Index>>> joined;
    for (Index s = 0; s < simplices.size(); ++s) {
      const Index r = sets.find(s);
      if (r == s) {
        medium_of[s] = static_cast<Index>(space.media_.size());
        space.media_.push_back({slowness[s], false, nullptr, {}, 0, 0, {}, {}, {}});
        joined.emplace_back();
      }
      medium_of[s] = medium_of[r];
      for (const Index a : simplices[s])
        for (const Index b : simplices[s])
          if (a != b) add(joined[medium_of[s] - first][a], b);
    }
    for (std::size_t m = first; m < space.media_.size(); ++m) {
      Medium& medium = space.media_[m];
      std::map<Index, Index> number;
      for (const auto& [p, others] : joined[m - first]) {
        number[p] = static_cast<Index>(medium.points.size());
        medium.points.push_back(p);
      }
      medium.begin.push_back(0);
      for (const auto& [p, others] : joined[m - first]) {
        for (const Index q : others) medium.neighbours.push_back(number[q]);
        medium.begin.push_back(static_cast<Index>(medium.neighbours.size()));
      }
    }
  }
  void find_sheets() {
    const std::size_t first = space.media_.size();
    find_flat(faces, slow_faces, medium_of_face);
    std::vector<std::vector<Index>> members(space.media_.size() - first);
    for (Index f = 0; f < this->faces.size(); ++f) members[medium_of_face[f] - first].push_back(f);
    for (std::size_t m = 0; m < members.size(); ++m)
      build_room(space.media_[first + m], members[m]);
  }
  // What is not convex has walls: those of a prism that it is the bottom of.
  void build_room(Medium& sheet, const std::vector<Index>& faces) {
    sheet.up = normal_of(this->faces[faces[0]]);
    if (faces.size() == 1 || is_convex(faces)) return;
    const auto count = static_cast<Index>(sheet.points.size());
    std::vector<Point> corners;
    for (const double height : {0., 1.})
      for (const Index p : sheet.points) corners.push_back(points[p] + height * sheet.up);
    std::vector<std::array<Index, 4>> tets;
    for (const Index f : faces) {
      Triple t = sorted(this->faces[f]);
      for (Index& v : t)
        v = static_cast<Index>(std::lower_bound(sheet.points.begin(), sheet.points.end(), v) -
                               sheet.points.begin());
      tets.push_back({t[0], t[1], t[2], t[2] + count});
      tets.push_back({t[0], t[1], t[1] + count, t[2] + count});
      tets.push_back({t[0], t[0] + count, t[1] + count, t[2] + count});
    }
    std::vector<std::array<double, 3>> places;
    for (const Point& p : corners) places.push_back({p.x, p.y, p.z});
    const TetMesh<double> mesh(places, tets, 1);
    std::vector<Point> inside(corners.size());
    for (Index v = 0; v < inside.size(); ++v) inside[mesh.inside_vertex(v)] = corners[v];
    for (Index v = 0; v < count; ++v) sheet.vertex.push_back(mesh.inside_vertex(v));
    sheet.room = std::make_shared<const SolidSpace>(mesh, std::move(inside));
  }
  // Is all of it in front of each edge of its border?
  [[nodiscard]] bool is_convex(const std::vector<Index>& faces) const {
    std::vector<std::pair<Edge, Index>> edges;  // and the corner opposite
    for (const Index f : faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& t = this->faces[f];
        edges.push_back({edge_of(t[k], t[(k + 1) % 3]), t[(k + 2) % 3]});
      }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<Edge, Index>> border;
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
      while (j < edges.size() && edges[j].first == edges[i].first) ++j;
      if (j == i + 1) border.push_back(edges[i]);
    }
    for (const auto& [edge, corner] : border) {
      const Point &a = points[edge[0]], along = strings::unit(points[edge[1]] - a),
                  off = points[corner] - a, in = strings::unit(off - dot(off, along) * along);
      for (const auto& other : border)
        if (dot(in, points[other.first[0]] - a) < -same) return false;
    }
    return true;
  }
  void find_wires() { find_flat(parts.edges, parts.slow_edges, medium_of_edge); }

  void find_interfaces() {
    std::map<Triple, std::vector<Index>> sheets;
    for (Index f = 0; f < this->faces.size(); ++f)
      sheets[sorted(this->faces[f])].push_back(medium_of_face[f]);
    each_face([&](const Triple& face, const std::vector<Index>& tets) {
      const auto sheet = sheets.find(face);
      const bool two = tets.size() == 2 && medium_of_tet[tets[0]] != medium_of_tet[tets[1]];
      if (!two && sheet == sheets.end()) return;
      Interface i{face, normal_of(face), none, none, {}, none};
      for (const Index t : tets) {
        Point middle = {0, 0, 0};
        for (const Index v : parts.tets[t]) middle = middle + .25 * points[v];
        (dot(middle - points[face[0]], i.normal) > 0 ? i.above : i.below) = medium_of_tet[t];
        add(i.media, medium_of_tet[t]);
      }
      if (sheet != sheets.end()) {
        for (const Index m : sheet->second) add(i.media, m);
        sheets.erase(sheet);
      }
      interfaces.push_back(i);
    });
    for (const auto& [face, media] : sheets) {
      Interface i{face, normal_of(face), none, none, {}, none};
      for (const Index m : media) add(i.media, m);
      interfaces.push_back(i);
    }
  }
  std::vector<std::vector<Index>> patch_faces;
  std::vector<std::vector<Index>> row_lines;
  void find_patches();
  // Edges where solids meet that have no face in common there.
  void find_touching();
  void find_lines();
  void find_rows();
  void make_places();
  [[nodiscard]] Boundary::Wedge wedge_of(Index t, const Edge& edge) const;
};

}  // namespace plexway::detail::strings
