#include "complex/vertex_fans.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace plexway {
namespace {

class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index find(Index a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void join(Index a, Index b) { parent_[find(a)] = find(b); }
  std::size_t count() {
    std::size_t roots = 0;
    for (Index a = 0; a < parent_.size(); ++a) roots += find(a) == a;
    return roots;
  }

 private:
  std::vector<Index> parent_;
};

}  // namespace

template <class Real>
VertexFans find_vertex_fans(std::span<const TriangleRecord<Real>> triangles, std::size_t vertices) {
  const std::size_t faces = triangles.size() - 1;
  VertexFans fans;
  fans.corner.assign(vertices, none);
  fans.on_boundary.assign(vertices, 0);
  std::vector<Index> corners(vertices, 0);
  for (std::size_t f = faces; f-- > 0;)
    for (Index i = 0; i < 3; ++i) {
      const Index v = triangles[f].corner[i];
      fans.corner[v] = static_cast<Index>(3 * f + i);
      ++corners[v];
      if (triangles[f].across[i] >> Across::face_shift == faces)
        fans.on_boundary[v] = fans.on_boundary[triangles[f].corner[i == 2 ? 0 : i + 1]] = 1;
    }
  std::vector<Index> row(vertices, none);
  for (Index v = 0; v < vertices; ++v) {
    if (fans.corner[v] == none) continue;
    Index found = 0;
    walk_fan<Real>(triangles, fans.corner[v], [&](Index) { ++found; });
    if (found == corners[v]) continue;
    row[v] = static_cast<Index>(fans.irregular.size());
    fans.irregular.push_back(v);
  }

  Sets components(faces);
  for (Index f = 0; f < faces; ++f)
    for (const Index across : triangles[f].across)
      if (across >> Across::face_shift != faces) components.join(f, across >> Across::face_shift);

  fans.irregular_begin.assign(fans.irregular.size() + 1, 0);
  for (std::size_t r = 0; r < fans.irregular.size(); ++r)
    fans.irregular_begin[r + 1] = fans.irregular_begin[r] + corners[fans.irregular[r]];
  fans.irregular_corners.resize(fans.irregular_begin.back());
  std::vector<Index> cursor(fans.irregular_begin.begin(), fans.irregular_begin.end() - 1);
  if (!fans.irregular.empty())
    for (Index f = 0; f < faces; ++f)
      for (Index i = 0; i < 3; ++i)
        if (const Index r = row[triangles[f].corner[i]]; r != none)
          fans.irregular_corners[cursor[r]++] = 3 * f + i;

  // Pinched: the corners fall into several sets when joined over all edges at the vertex, fans too.
  for (std::size_t r = 0; r < fans.irregular.size(); ++r) {
    const auto first = fans.irregular_corners.begin() + fans.irregular_begin[r];
    const auto last = fans.irregular_corners.begin() + fans.irregular_begin[r + 1];
    const auto place = [&](Index corner) {
      return static_cast<Index>(std::lower_bound(first, last, corner) - first);
    };
    Sets sheets(static_cast<std::size_t>(last - first));
    for (auto c = first; c != last; ++c) {
      const Index f = *c / 3, i = *c % 3;
      for (const bool by_start : {true, false}) {
        const Index across = triangles[f].across[by_start ? i : (i == 0 ? 2 : i - 1)];
        const Index g = across >> Across::face_shift, j = across & Across::edge_mask;
        if (g == faces) continue;
        const bool at_start = by_start == ((across & Across::flip) != 0);
        sheets.join(place(*c), place(3 * g + (at_start ? j : (j == 2 ? 0 : j + 1))));
      }
    }
    if (sheets.count() > 1) fans.pinched.push_back(fans.irregular[r]);
    for (auto c = first; c != last; ++c) components.join(*first / 3, *c / 3);
  }
  fans.components = components.count();
  return fans;
}

template <class Real>
bool is_open_book(std::span<const TriangleRecord<Real>> triangles, std::span<const Index> corners) {
  const Index sentinel = static_cast<Index>(triangles.size() - 1);
  constexpr double rounding = 1e-5;
  std::size_t pages = 0, rims = 0;
  std::vector<Index> spine;  // what lies across the edges on it
  std::vector<char> seen(corners.size(), 0);
  for (std::size_t c = 0; c < corners.size(); ++c) {
    if (seen[c]) continue;
    ++pages;
    double angle = 0;
    std::size_t ends = 0, rim = 0;
    walk_fan(triangles, corners[c], [&](Index corner) {
      seen[static_cast<std::size_t>(std::find(corners.begin(), corners.end(), corner) -
                                    corners.begin())] = 1;
      const TriangleRecord<Real>& t = triangles[corner / 3];
      const std::size_t i = corner % 3;
      angle += std::atan2(static_cast<double>(t.sine(i)), static_cast<double>(t.cosine[i]));
      for (const std::size_t edge : {i, edge_before(i)}) {
        const Index across = t.across[edge];
        if (across >> Across::face_shift == sentinel)
          ++ends, ++rim;
        else if (across & Across::fan)
          ++ends, spine.push_back(across);
      }
    });
    if (ends != 2 || rim > 1 || angle > std::numbers::pi / (rim == 1 ? 2 : 1) + rounding)
      return false;
    rims += rim;
  }
  if (rims != 0 && rims != pages) return false;
  // Each edge of the spine joins all pages.
  for (const Index start : spine) {
    std::size_t joined = 0;
    Index across = start;
    do {
      ++joined;
      across = triangles[across >> Across::face_shift].across[across & Across::edge_mask];
    } while (joined <= pages && ((across ^ start) & ~Across::special) != 0);
    if (joined != pages) return false;
  }
  return !spine.empty();
}

template bool is_open_book(std::span<const TriangleRecord<float>>, std::span<const Index>);
template bool is_open_book(std::span<const TriangleRecord<double>>, std::span<const Index>);
template VertexFans find_vertex_fans<float>(std::span<const TriangleRecord<float>>, std::size_t);
template VertexFans find_vertex_fans<double>(std::span<const TriangleRecord<double>>, std::size_t);

}  // namespace plexway
