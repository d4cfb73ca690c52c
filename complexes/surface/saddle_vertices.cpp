#include "complexes/surface/gluing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

}  // namespace plexway::detail
