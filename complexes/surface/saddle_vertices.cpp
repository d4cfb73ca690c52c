#include "complexes/surface/gluing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "complexes/cloud/crease.hpp"
#include "complexes/common/building_blocks.hpp"

namespace plexway::detail {
namespace {

// What a vertex and its inner neighbours say about it.
struct SaddleSupport {
  double sum;        // of the excess, its own included
  double lack;       // by how much neighbours are below flat
  double agreement;  // the sum again, where none counts more than the vertex itself, of vertices
                     // that have little,
  double most;       // and what that would be if all had one sign
  double count;      // of neighbours
};

// In arrays of at most 16 bytes a vertex: those find room where the layout's were, and so do not
// add to the peak.
class Neighbourhoods {
 public:
  /// `little`: up to which excess agreement is asked for.
  Neighbourhoods(std::span<const double> excess, double little)
      : excess_(excess),
        little_(little),
        sums_(excess.size()),
        agreements_(excess.size()),
        heard_(excess.size()) {}

  // An edge inside is met from both its triangles. Of one on the boundary both ends are there.
  // Nobody asks for that of a vertex which is no saddle by itself.
  void hear(Index of, Index from) {
    const double mine = excess_[of], theirs = excess_[from];
    if (!(mine > 0)) return;
    sums_[of].all += theirs / 2;
    sums_[of].lack += std::max(0.0, -theirs) / 2;
    ++heard_[of];
    if (mine > little_) return;
    agreements_[of].all += std::clamp(theirs, -mine, mine) / 2;
    agreements_[of].most += std::min(mine, std::abs(theirs)) / 2;
  }
  [[nodiscard]] SaddleSupport operator[](std::size_t v) const {
    return {sums_[v].all + excess_[v], sums_[v].lack, agreements_[v].all + excess_[v],
            agreements_[v].most + std::abs(excess_[v]), 0.5 * heard_[v]};
  }

 private:
  struct Sum {
    double all = 0, lack = 0;
  };
  struct Agreement {
    double all = 0, most = 0;
  };
  std::span<const double> excess_;
  double little_;
  std::vector<Sum> sums_;
  std::vector<Agreement> agreements_;
  std::vector<Index> heard_;
};

template <class Real>
Neighbourhoods look_around(std::span<const TriangleRecord<Real>> triangles,
                           std::span<const Index> first_use, std::span<const double> excess,
                           std::span<const char> boundary, double little, int threads) {
  Neighbourhoods around(excess, little);
  tell_vertices<Index>(
      first_use, triangles.size(), threads,
      [&](std::size_t first, std::size_t last, const auto& tell) {
        for (const TriangleRecord<Real>& t : triangles.subspan(first, last - first))
          for (std::size_t i = 0; i < 3; ++i) {
            const Index v = t.corner[i], w = t.corner[edge_after(i)];
            if (!boundary[w]) tell(v, w);
            if (!boundary[v]) tell(w, v);
          }
      },
      [&](Index of, Index from) { around.hear(of, from); });
  return around;
}

// May paths bend at this inner vertex? See docs/contributing/methods/surfaces.md, "Which vertices
// are saddles".
bool is_inner_saddle(double excess, const SaddleSupport& n, double least,
                     const SaddleThresholds& saddles) {
  if (!(excess > 0)) return false;
  if (n.count == 0) return excess > saddles.interior;
  if (excess <= saddles.interior) return excess > least && n.agreement > saddles.agreement * n.most;
  return n.sum > 0 || excess > std::min(saddles.most_noise, saddles.noise_share * n.lack / n.count);
}

}  // namespace

template <class Real>
void mark_saddles(std::span<TriangleRecord<Real>> triangles, const VertexFans& fans,
                  std::span<const Index> first_use, std::vector<double> excess,
                  const SurfaceHints& hints, std::size_t of_whole) {
  const std::size_t vertices = excess.size();
  const std::span<const TriangleRecord<Real>> all = triangles;
  // What is below this is below a thousandth of a sphere's curvature, all vertices together.
  const double least =
      4e-3 * std::numbers::pi / static_cast<double>(of_whole > 0 ? of_whole : vertices);
  // Samples count by what they and their neighbourhood have beyond rounding.
  const double rounding = hints.samples ? hints.saddles.interior : 0;
  for (std::size_t v = 0; v < vertices; ++v)
    if (!fans.on_boundary[v]) excess[v] -= rounding;

  std::vector<char> saddle(vertices);
  {
    const Neighbourhoods around =
        look_around<Real>(all.first(all.size() - 1), first_use, excess, fans.on_boundary,
                          hints.saddles.interior, hints.threads);
    over_blocks(vertices, hints.threads, [&](std::size_t first, std::size_t last) {
      for (std::size_t v = first; v < last; ++v)
        saddle[v] = fans.on_boundary[v] ? excess[v] > hints.saddles.boundary
                    : hints.samples     ? excess[v] > 0 && around[v].sum > 0
                                    : is_inner_saddle(excess[v], around[v], least, hints.saddles);
    });
  }
  for (std::size_t r = 0; r < fans.irregular.size(); ++r) {
    const auto corners = std::span<const Index>(fans.irregular_corners)
                             .subspan(fans.irregular_begin[r],
                                      fans.irregular_begin[r + 1] - fans.irregular_begin[r]);
    saddle[fans.irregular[r]] = !is_open_book<Real>(all, corners);
  }
  over_blocks(triangles.size() - 1, hints.threads, [&](std::size_t first, std::size_t last) {
    for (TriangleRecord<Real>& t : triangles.subspan(first, last - first))
      for (std::size_t i = 0; i < 3; ++i)
        if (saddle[t.corner[i]]) t.signed_sine[i] = std::copysign(t.signed_sine[i], Real(-1));
  });
}

template void mark_saddles(std::span<TriangleRecord<float>>, const VertexFans&,
                           std::span<const Index>, std::vector<double>, const SurfaceHints&,
                           std::size_t);
template void mark_saddles(std::span<TriangleRecord<double>>, const VertexFans&,
                           std::span<const Index>, std::vector<double>, const SurfaceHints&,
                           std::size_t);

namespace {

using Triangle = SheetWedges::Triangle;

double corner_angle(const Places& places, Index corner, Index a, Index b) {
  const Point3 p = minus(places.at[a], places.at[corner]),
               q = minus(places.at[b], places.at[corner]);
  const Point3 n = cross(p, q);
  return std::atan2(std::sqrt(dot(n, n)), dot(p, q));
}

// Measured on a square with a block in it, 5k to 100k points, six draws each: mean errors of 4.4e-3
// to 5.4e-3 without, 2.1e-3, 1.7e-3 and 1.0e-3 so. Twice as far is no better.
constexpr double least_angle = std::numbers::pi * (1 + 10.0 / 180);
constexpr double farthest = 8;  // spacings
constexpr int rounds = 6;

struct Saddle {
  double angle;
  Index place;
};

std::vector<Saddle> find_saddles(const Places& places, const SheetWedges& sheet) {
  std::vector<Saddle> saddles;
  for (Index p = 0; p < places.near.point_count(); ++p) {
    if (!sheet.open(p)) continue;
    const double taken = sheet.angle_taken(p);
    if (taken > least_angle) saddles.push_back({taken, p});
  }
  std::stable_sort(saddles.begin(), saddles.end(),
                   [](const Saddle& a, const Saddle& b) { return a.angle > b.angle; });
  return saddles;
}

// The triangle on the other side of the edge of f from x to y, if there is one and no more.
SheetWedges::Wedge beyond(const SheetWedges& sheet, Index x, Index y, Index f) {
  SheetWedges::Wedge found = {none, none, none, none};
  int count = 0;
  sheet.around(x, [&](const SheetWedges::Wedge& w) {
    if (w.a != y && w.b != y) return;
    ++count;
    if (w.triangle != f) found = w;
  });
  if (count != 2) found.triangle = none;
  return found;
}

// Could the edge from c to z take the place of that from x to y, between them?
bool can_flip(const Places& places, Index c, Index x, Index y, Index z) {
  constexpr double most = std::numbers::pi - 0.04;
  return corner_angle(places, x, c, y) + corner_angle(places, x, y, z) < most &&
         corner_angle(places, y, c, x) + corner_angle(places, y, x, z) < most;
}

}  // namespace

void widen_boundary_saddles(const Places& places, std::span<const TangentFrame> frames,
                            const SheetRule& rule, SheetWedges& sheet) {
  const std::vector<Saddle> saddles = find_saddles(places, sheet);
  std::vector<char> is_saddle(places.at.size(), 0);
  for (const Saddle& s : saddles) is_saddle[s.place] = 1;
  std::vector<Index> star;
  for (int round = 0; round < rounds; ++round)
    for (const Saddle& s : saddles) {
      const Index c = s.place;
      const double most = farthest * static_cast<double>(frames[c].spacing);
      star.clear();
      sheet.around(c, [&](const SheetWedges::Wedge& w) { star.push_back(w.triangle); });
      for (const Index f : star) {
        const Triangle t = sheet.triangles()[f];
        const std::size_t i = t[0] == c ? 0 : t[1] == c ? 1 : 2;
        const Index x = t[(i + 1) % 3], y = t[(i + 2) % 3];
        const SheetWedges::Wedge other = beyond(sheet, x, y, f);
        if (other.triangle == none) continue;
        const Index z = other.a == y ? other.b : other.a;
        if (z == c || is_saddle[x] || is_saddle[y] || is_saddle[z]) continue;
        const Point3 far = minus(places.at[z], places.at[c]);
        if (dot(far, far) > most * most || !can_flip(places, c, x, y, z)) continue;
        // Over a crease the edge would be no straight line on the sheet.
        if (crease_between(places, frames, rule, c, z) || !same_sheet(places, frames, rule, c, z))
          continue;
        sheet.remove(f);
        sheet.remove(other.triangle);
        sheet.add({c, x, z});
        sheet.add({c, z, y});
      }
    }
}

}  // namespace plexway::detail
