#include "strings/media_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

namespace plexway::strings {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

class Sets {
 public:
  explicit Sets(std::size_t n) : of_(n) { std::iota(of_.begin(), of_.end(), Index{0}); }
  Index root(Index i) {
    while (of_[i] != i) i = of_[i] = of_[of_[i]];
    return i;
  }
  void join(Index a, Index b) { of_[std::max(root(a), root(b))] = std::min(root(a), root(b)); }

 private:
  std::vector<Index> of_;
};

using Edge = std::array<Index, 2>;
using Triple = std::array<Index, 3>;
Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }
Triple sorted(Triple t) {
  std::sort(t.begin(), t.end());
  return t;
}
void add(std::vector<Index>& list, Index item) {
  const auto at = std::lower_bound(list.begin(), list.end(), item);
  if (at == list.end() || *at != item) list.insert(at, item);
}

}  // namespace

std::vector<Index> covered_by(const Parts& parts) {
  std::vector<std::pair<Triple, Index>> faces;
  for (Index f = 0; f < parts.faces.size(); ++f) faces.push_back({sorted(parts.faces[f]), f});
  std::sort(faces.begin(), faces.end());
  std::vector<Index> by(parts.faces.size(), none);
  if (faces.empty()) return by;
  constexpr double rounding = 1e-9;
  for (Index t = 0; t < parts.tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& c = parts.tets[t];
      const std::pair<Triple, Index> key = {
          sorted({c[(i + 1) % 4], c[(i + 2) % 4], c[(i + 3) % 4]}), 0};
      for (auto f = std::lower_bound(faces.begin(), faces.end(), key);
           f != faces.end() && f->first == key.first; ++f) {
        Index& best = by[f->second];
        const double least =
            best == none ? parts.slow_faces[f->second] * (1 + rounding) : parts.slow_tets[best];
        if (best == none ? parts.slow_tets[t] <= least : parts.slow_tets[t] < least) best = t;
      }
    }
  return by;
}

struct MediaSpace::Builder {
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
    Sets sets(parts.tets.size());
    each_face([&](const Triple&, const std::vector<Index>& tets) {
      for (const Index t : tets)
        if (parts.slow_tets[t] == parts.slow_tets[tets[0]]) sets.join(tets[0], t);
    });
    medium_of_tet.assign(parts.tets.size(), none);
    std::vector<std::vector<Index>> members;
    for (Index t = 0; t < parts.tets.size(); ++t) {
      const Index r = sets.root(t);
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
      medium.room = std::make_unique<SolidSpace>(mesh, std::move(inside));
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
    Sets sets(simplices.size());
    for (const auto& [face, all] : at)
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
          if (straight(all[i], all[j], face)) sets.join(all[i], all[j]);
    medium_of.assign(simplices.size(), none);
    const std::size_t first = space.media_.size();
    std::vector<std::map<Index, std::vector<Index>>> joined;
    for (Index s = 0; s < simplices.size(); ++s) {
      const Index r = sets.root(s);
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
    sheet.room = std::make_unique<SolidSpace>(mesh, std::move(inside));
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
  void find_patches() {
    std::map<Edge, std::vector<Index>> at;
    for (Index i = 0; i < interfaces.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        at[edge_of(interfaces[i].corner[k], interfaces[i].corner[(k + 1) % 3])].push_back(i);
    Sets sets(interfaces.size());
    const auto one = [&](const Interface& a, const Interface& b) {
      if (a.media != b.media) return false;
      if (alike(a.normal, b.normal)) return a.above == b.above && a.below == b.below;
      return alike(a.normal, -1. * b.normal) && a.above == b.below && a.below == b.above;
    };
    for (const auto& [edge, all] : at)
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
          if (one(interfaces[all[i]], interfaces[all[j]])) sets.join(all[i], all[j]);
    for (Index i = 0; i < interfaces.size(); ++i) {
      const Index r = sets.root(i);
      if (r == i) {
        interfaces[i].patch = static_cast<Index>(patch_faces.size());
        patch_faces.emplace_back();
      }
      patch_faces[interfaces[i].patch = interfaces[r].patch].push_back(i);
    }
    for (const auto& [edge, all] : at) {
      std::vector<Index> borders;  // patches with one triangle here
      for (const Index i : all) {
        std::size_t count = 0;
        for (const Index j : all) count += interfaces[j].patch == interfaces[i].patch;
        if (count == 1) add(borders, interfaces[i].patch);
      }
      if (borders.empty()) continue;
      line_at[edge] = static_cast<Index>(lines.size());
      lines.push_back({edge, {}, borders, {}, false, none});
    }
  }

  // Edges where solids meet that have no face in common there.
  void find_touching() {
    std::vector<Edge> inside;
    for (const Interface& i : interfaces)
      for (std::size_t k = 0; k < 3; ++k)
        inside.push_back(edge_of(i.corner[k], i.corner[(k + 1) % 3]));
    std::sort(inside.begin(), inside.end());
    std::vector<std::pair<Edge, Index>> at;  // and the medium
    for (Index t = 0; t < parts.tets.size(); ++t)
      for (const auto& e : tet_edge_ends) {
        const Edge edge = edge_of(parts.tets[t][e[0]], parts.tets[t][e[1]]);
        if (space.nodes_at(edge[0]).size() > 1 && space.nodes_at(edge[1]).size() > 1 &&
            !std::binary_search(inside.begin(), inside.end(), edge))
          at.push_back({edge, medium_of_tet[t]});
      }
    std::sort(at.begin(), at.end());
    for (std::size_t i = 1; i < at.size(); ++i)
      if (at[i].first == at[i - 1].first && at[i].second != at[i - 1].second &&
          line_at.insert({at[i].first, static_cast<Index>(lines.size())}).second)
        lines.push_back({at[i].first, {}, {}, {}, false, none});
  }

  void find_lines() {
    for (Index e = 0; e < parts.edges.size(); ++e) {
      const Edge edge = edge_of(parts.edges[e][0], parts.edges[e][1]);
      const auto [at, is_new] = line_at.insert({edge, static_cast<Index>(lines.size())});
      if (is_new) lines.push_back({edge, {}, {}, {}, false, none});
      lines[at->second].is_wire = true;
      add(lines[at->second].media, medium_of_edge[e]);
    }
    find_touching();
    const auto line = [&](Index a, Index b) -> Line* {
      const auto at = line_at.find(edge_of(a, b));
      return at == line_at.end() ? nullptr : &lines[at->second];
    };
    for (Index t = 0; t < parts.tets.size(); ++t)
      for (const auto& e : tet_edge_ends)
        if (Line* l = line(parts.tets[t][e[0]], parts.tets[t][e[1]])) {
          add(l->media, medium_of_tet[t]);
          l->wedges.push_back({medium_of_tet[t], wedge_of(t, l->end)});
        }
    for (Index f = 0; f < this->faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        if (Line* l = line(this->faces[f][k], this->faces[f][(k + 1) % 3])) {
          add(l->media, medium_of_face[f]);
          const Point& up = space.media_[medium_of_face[f]].up;
          const Point &a = points[l->end[0]], along = strings::unit(points[l->end[1]] - a),
                      off = points[this->faces[f][(k + 2) % 3]] - a,
                      in = strings::unit(off - dot(off, along) * along);
          l->wedges.push_back({medium_of_face[f], {{in, up}, strings::unit(in + up)}});
        }
  }

  std::vector<std::vector<Index>> row_lines;
  void find_rows() {
    std::map<Index, std::vector<Index>> at;
    for (Index l = 0; l < lines.size(); ++l)
      for (const Index v : lines[l].end) at[v].push_back(l);
    Sets sets(lines.size());
    for (const auto& [v, all] : at)
      for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j) {
          const Line &a = lines[all[i]], &b = lines[all[j]];
          if (a.media != b.media || a.patches != b.patches || a.is_wire != b.is_wire) continue;
          const auto from = [&](const Line& l) {
            return strings::unit(points[l.end[0] == v ? l.end[1] : l.end[0]] - points[v]);
          };
          if (alike(from(a), -1. * from(b))) sets.join(all[i], all[j]);
        }
    for (Index l = 0; l < lines.size(); ++l) {
      const Index r = sets.root(l);
      if (r == l) {
        lines[l].row = static_cast<Index>(row_lines.size());
        row_lines.emplace_back();
      }
      row_lines[lines[l].row = lines[r].row].push_back(l);
    }
  }

  void make_places() {
    std::vector<Place>& places = space.places_;
    const Point zero = {0, 0, 0};
    for (Medium& m : space.media_) {
      m.first_bend = static_cast<Index>(places.size());
      if (m.room) places.insert(places.end(), m.room->places().begin(), m.room->places().end());
    }
    space.first_patch_ = static_cast<Index>(places.size());
    std::vector<std::vector<Index>> media_at;  // of patches, then of rows
    space.at_.resize(points.size());
    for (const auto& faces : patch_faces) {
      const Interface& first = interfaces[faces[0]];
      Place place{points[first.corner[0]], zero, -unbounded, unbounded, zero, zero, zero, 0};
      place.along = strings::unit(points[first.corner[1]] - place.origin);
      place.wide = cross(first.normal, place.along);
      place.is_plane = true;
      for (const Index i : faces)
        for (const Index v : interfaces[i].corner)
          add(space.at_[v], static_cast<Index>(places.size()));
      space.patches_.push_back({first.normal, first.above, first.below, {}, {}});
      media_at.push_back(first.media);
      places.push_back(place);
    }
    space.first_row_ = static_cast<Index>(places.size());
    for (const auto& own : row_lines) {
      const Line& first = lines[own[0]];
      const auto number = static_cast<Index>(places.size());
      Place place{points[first.end[0]], zero, 0, 0, zero, zero, zero, 0};
      place.along = strings::unit(points[first.end[1]] - place.origin);
      std::array<Index, 2> ends = {first.end[0], first.end[0]};
      for (const Index l : own)
        for (const Index v : lines[l].end) {
          const double t = dot(points[v] - place.origin, place.along);
          if (t < place.low) place.low = t, ends[0] = v;
          if (t > place.high) place.high = t, ends[1] = v;
          if (first.media.size() > 1) add(space.at_[v], number);
        }
      space.ends_.push_back(ends);
      std::vector<Index> patches;
      for (const Index p : first.patches) {
        patches.push_back(space.first_patch_ + p);
        Patch& patch = space.patches_[p];
        const Place& plane = places[space.first_patch_ + p];
        std::array<double, 4> side;
        for (std::size_t k = 0; k < 2; ++k) {
          const Point d = points[ends[k]] - plane.origin;
          side[2 * k] = dot(d, plane.along);
          side[2 * k + 1] = dot(d, plane.wide);
        }
        patch.rows.push_back(number);
        patch.sides.push_back(side);
      }
      space.patches_of_.push_back(patches);
      media_at.push_back(first.media);
      places.push_back(place);
    }
    for (Index m = 0; m < space.media_.size(); ++m)
      if (const auto& medium = space.media_[m]; medium.room)
        for (std::size_t i = 0; i < medium.room->places().size(); ++i) {
          space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
          space.doors_.push_back({medium.first_bend + static_cast<Index>(i), m, 0, 0});
        }
    for (Index p = space.first_patch_; p < places.size(); ++p) {
      space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
      for (const Index m : media_at[p - space.first_patch_]) {
        Door door{p, m, static_cast<Index>(space.wedges_.size()), 0};
        if (p >= space.first_row_) {
          const Line& line = lines[row_lines[p - space.first_row_][0]];
          for (const auto& [medium, wedge] : line.wedges)
            if (medium == m) space.wedges_.push_back(wedge);
        }
        door.last_wedge = static_cast<Index>(space.wedges_.size());
        space.doors_.push_back(door);
      }
    }
    for (Index p = 0; p < points.size(); ++p) {
      space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
      for (const Index n : space.nodes_at(p))
        space.doors_.push_back({space.corner(p), space.medium_of_[n], 0, 0});
    }
    space.first_door_.push_back(static_cast<Index>(space.doors_.size()));
  }
  [[nodiscard]] Boundary::Wedge wedge_of(Index t, const Edge& edge) const {
    const Point along = strings::unit(points[edge[1]] - points[edge[0]]);
    Point side[2];
    std::size_t n = 0;
    for (const Index v : parts.tets[t]) {
      if (v == edge[0] || v == edge[1]) continue;
      const Point d = points[v] - points[edge[0]];
      side[n++] = strings::unit(d - dot(d, along) * along);
    }
    const auto inward = [&](const Point& in, const Point& off) {
      return strings::unit(off - dot(off, in) * in);
    };
    return {{inward(side[0], side[1]), inward(side[1], side[0])}, strings::unit(side[0] + side[1])};
  }
};

MediaSpace::MediaSpace(const Parts& parts) {
  Builder builder(*this, parts);
  builder.build();
}

}  // namespace plexway::strings
