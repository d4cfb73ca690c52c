#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/sampling/poisson_disk.hpp>

#include "fields/cut_domain.hpp"
#include "paths/simplex_places.hpp"
#include "sampling/dart_thrower.hpp"

namespace plexway::detail {

/// Of the simplices with edges up to 1 the regular one has most content: at least so many parts
/// has one of a content whose edges may be as long as `limit`.
template <std::size_t Corners>
double least_parts(double content, double limit) {
  constexpr double regular = Corners == 3 ? 0.4330127018922193 : 0.1178511301977579;
  return std::max(1., content / (regular * std::pow(limit, double{Corners - 1})));
}

/// A domain that has places, in boxes of which each is cut for itself, with as much around it as
/// decides what happens inside. Numbers, coordinates and unit inside.
template <class Complex>
class DomainBlocks {
 public:
  /// Edges are cut to `limits`, one a vertex, into no more than `most` parts a box. What is farther
  /// from a box than `reach` of these limits does not matter to it.
  DomainBlocks(const Complex& domain, std::span<const double> limits, double reach,
               std::size_t most)
      : domain_(domain), limits_(limits), reach_(reach), most_(most) {}

  /// visit(fine, box, share): what is within the box and about it, and which share of the box
  /// around the domain that is. Throws TooManyParts where what is about a box is too much already.
  template <class Visit>
  void each(const Visit& visit) const {
    Box<3> whole = Box<3>::empty();
    for (Index s = 0; s < domain_.simplex_count(); ++s) whole.add(box_around(domain_, s));
    struct Block {
      Box<3> box;
      double share;
    };
    std::vector<Block> left = {{whole, 1}};
    while (!left.empty()) {
      const auto [box, share] = left.back();
      left.pop_back();
      const double width = reach_ * greatest_limit(box);
      std::size_t longest = 0;
      for (std::size_t k = 1; k < 3; ++k)
        if (box.high[k] - box.low[k] > box.high[longest] - box.low[longest]) longest = k;
      const double side = box.high[longest] - box.low[longest];
      const bool small = side < width;  // smaller ones would consist of what is about them
      CutDomain<Complex> fine;
      try {
        if (!small && expected_parts(box) > static_cast<double>(most_)) throw TooManyParts("");
        const Near near = {box, width};
        fine = cut(domain_, limits_, small ? most_parts : most_, &near);
      } catch (const TooManyParts&) {
        if (small) throw;
        Block low = {box, share / 2}, high = low;
        low.box.high[longest] = high.box.low[longest] = box.low[longest] + side / 2;
        left.push_back(high);
        left.push_back(low);
        continue;
      }
      if (fine.copy) visit(fine, box, share);
    }
  }

 private:
  [[nodiscard]] double limit(Index s) const {
    double limit = 0;
    for (const Index v : corners_in(domain_, s)) limit = std::max(limit, limits_[v]);
    return limit;
  }

  /// Of all that reach a box.
  [[nodiscard]] double greatest_limit(const Box<3>& box) const {
    double greatest = 0;
    for (Index s = 0; s < domain_.simplex_count(); ++s)
      if (const double own = limit(s);
          own > greatest && box.distance(box_around(domain_, s)) <= reach_ * own)
        greatest = own;
    return greatest;
  }

  /// As if simplices filled the boxes around them evenly.
  [[nodiscard]] double expected_parts(const Box<3>& box) const {
    double parts = 0;
    for (Index s = 0; s < domain_.simplex_count(); ++s) {
      const Box<3> all = box_around(domain_, s);
      double share = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        const double both = std::min(box.high[k], all.high[k]) - std::max(box.low[k], all.low[k]);
        const double side = all.high[k] - all.low[k];
        share *= side > 0 ? std::max(0., both / side) : 1;
      }
      if (share > 0)
        parts +=
            share * least_parts<Complex::dimension + 1>(content_in_space(domain_, s), limit(s));
    }
    return parts;
  }

  const Complex& domain_;
  std::span<const double> limits_;
  double reach_;
  std::size_t most_;
};

/// Before any is cut: at least so many parts have edges within `limits`, one a vertex, in the unit
/// inside. Throws TooManyParts where these are more than `most`.
template <class Complex>
double check_parts(const Growth<Complex>& field, std::span<const double> limits, double radius,
                   std::size_t most) {
  constexpr std::size_t corners = Growth<Complex>::corners;
  double parts = 0;
  for (Index s = 0; s < field.simplices(); ++s) {
    double limit = 0;
    for (std::size_t i = 0; i < corners; ++i)
      limit = std::max(limit, limits[field.corners_of(s)[i]]);
    parts += least_parts<corners>(static_cast<double>(field.measure(s)), limit);
  }
  const double too_many = parts / static_cast<double>(std::min(most, most_parts));
  if (too_many <= 1) return parts;
  char text[160];
  std::snprintf(text, sizeof text,
                "the radius %.3g is too small for this domain, which would be cut into more than "
                "%.1g parts; choose %.2g or more",
                radius, parts, radius * std::pow(too_many, 1 / double{corners - 1}));
  throw TooManyParts(text);
}

/// Radii in units: what is larger than the domain covers all of it, like the domain. A dart of
/// radius rho starts at the largest radius less rho, which must leave it some digits.
template <class Real>
void check_radii(std::size_t simplices, std::vector<double>& radii) {
  // No way through the domain is longer than all edges, 3 or 6 a simplex, together.
  const double widest = 6 * static_cast<double>(simplices);
  const auto [least, largest] = std::minmax_element(radii.begin(), radii.end());
  constexpr double most = 2e-4 / double{std::numeric_limits<Real>::epsilon()};
  if (*largest > most * *least && *least < widest) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "radii from %.3g to %.3g of the mean edge are beyond %s precision: %skeep them "
                  "within 1 : %.1g",
                  *least, *largest, sizeof(Real) < sizeof(double) ? "single" : "double",
                  sizeof(Real) < sizeof(double) ? "use double, or " : "", most);
    throw PrecisionError(text);
  }
  for (double& radius : radii) radius = std::min(radius, widest);
}

/// One sample with one radius, of a domain that is cut where its simplices are too large: all at
/// once, or block by block where that would take too much memory.
template <class Complex>
class DartSample {
  using Real = typename Growth<Complex>::Number;
  using Thrower = DartThrower<Complex>;
  static constexpr std::size_t corners = Growth<Complex>::corners;
  // In radii. Simplices on the way between two darts then belong to one of them, not to others.
  static constexpr double longest_edge = 0.4;

 public:
  /// `candidates`: the vertices that darts may hit. Throws TooManyParts for more than `parts`.
  DartSample(const Complex& domain, std::span<const Index> candidates,
             const PoissonOptions& options, double radius, std::size_t parts,
             WorkspaceState<Real>& kept)
      : domain_(domain),
        candidates_(candidates),
        options_(options),
        kept_(kept),
        random_(options.seed),
        limits_(domain.vertex_count(), radius / domain.unit() * longest_edge) {
    result_.radius = radius;
    for (std::size_t v = 0; v < options.spacing.size(); ++v)
      limits_[domain.inside_vertex(static_cast<Index>(v))] *= options.spacing[v];
    std::size_t simplices = 0;
    double least = 0;
    {
      const Growth<Complex> field(domain, kept);
      simplices = field.simplices();
      least = check_parts(field, limits_, radius, parts);
    }
    // A copy may be somewhat larger than the domain in any case.
    const std::size_t at_once =
        has_places(domain) ? std::min(parts, std::max(options.at_once, 4 * simplices)) : parts;
    if (least <= static_cast<double>(at_once)) {
      try {
        throw_at(cut(domain, std::span<const double>(limits_), at_once));
        return;
      } catch (const TooManyParts&) {
        if (at_once == parts) throw;
      }
    }
    DomainBlocks<Complex>(domain, limits_, reach / longest_edge, options.at_once)
        .each([&](const auto& fine, const Box<3>& box, double share) {
          share_ = share;
          throw_at(fine, &box);
          done_ += share;
        });
    take_loose_vertices();
  }

  /// Darts in the caller's numbers.
  PoissonDisks take() {
    const SimplexNumbers<Complex> numbers(domain_);
    for (PointSource& dart : result_.darts)
      dart = dart.vertex != none ? PointSource::at(numbers.outside_vertex(dart.vertex))
                                 : numbers.outside(dart.simplex, dart.barycentric);
    return std::move(result_);
  }

 private:
  /// In radii: darts go into simplices that stick out of a box by an edge; so much farther away
  /// are those that matter, and the paths from them.
  static constexpr double reach = 1 + longest_edge;

  void throw_at(const CutDomain<Complex>& fine, const Box<3>* box = nullptr) {
    const Complex& complex = *fine.complex;
    // The copy has other numbers inside, and another unit.
    const auto inside = [&](Index v) { return fine.copy ? complex.inside_vertex(v) : v; };
    std::vector<double> radii(complex.vertex_count());
    for (Index v = 0; v < radii.size(); ++v)
      radii[inside(v)] = fine.limits[v] / longest_edge * domain_.unit() / complex.unit();
    std::vector<Index> vertices;
    for (const Index v : candidates_) {
      const Index w = domain_.inside_vertex(v);
      if (box && (!fine.has_vertex(w) || box->distance(place_of(domain_, w)) > 0)) continue;
      vertices.push_back(inside(fine.vertex_in_copy(w)));
    }

    Growth<Complex> field(complex, fine.copy ? cut_workspace_ : kept_);
    check_radii<Real>(field.simplices(), radii);
    SimplexNumbers<Complex> own(complex);
    typename Thrower::Target target{
        .radii = radii, .vertices = vertices, .open = {}, .earlier = {}};
    if (box) {
      target.open = simplices_in(fine, *box, own);
      target.earlier = darts_near(fine, *box, own);
    }
    const Thrower thrower(field, std::move(target), options_, random_, [&](double share) {
      const double all = done_ + share_ * std::clamp(share, 0., 1.);
      if (options_.progress && !options_.progress(std::min(all, 1.)))
        throw Cancelled("cancelled by the progress callback");
    });
    result_.thrown += thrower.thrown();
    result_.taken_back += thrower.taken_back();
    const PropagateStatistics& totals = field.totals();
    result_.statistics.expansions += totals.expansions;
    result_.statistics.updates += totals.updates;
    result_.statistics.reached_simplices += totals.reached_simplices;
    for (const auto& dart : thrower.darts()) result_.darts.push_back(in_domain(dart, fine, own));
  }

  /// Candidates of no simplex are in no box; each is its own dart, as where all is done at once.
  void take_loose_vertices() {
    std::vector<bool> used(domain_.vertex_count());
    for (Index s = 0; s < domain_.simplex_count(); ++s)
      for (const Index v : corners_in(domain_, s)) used[v] = true;
    for (const Index v : candidates_) {
      if (used[domain_.inside_vertex(v)]) continue;
      result_.darts.push_back(PointSource::at(domain_.inside_vertex(v)));
      ++result_.thrown;
    }
  }

  /// Numbers inside the domain.
  [[nodiscard]] PointSource in_domain(const typename Thrower::Dart& dart,
                                      const CutDomain<Complex>& fine,
                                      const SimplexNumbers<Complex>& own) const {
    if (!fine.copy)
      return {.vertex = dart.vertex, .simplex = dart.simplex, .barycentric = dart.weights};
    if (dart.vertex != none)  // the copy knows vertices by their numbers inside the domain
      return PointSource::at(fine.vertex_in_domain(own.outside_vertex(dart.vertex)));
    const Index parent = fine.parent[own.outside(dart.simplex, dart.weights).simplex];
    std::array<Index, corners> around;
    for (std::size_t i = 0; i < corners; ++i)
      around[i] = fine.vertex_in_copy(corners_in(domain_, parent)[i]);
    const std::size_t given = fine.partial ? fine.vertices.size() : domain_.vertex_count();
    Weights weights{};
    for (std::size_t i = 0; i < corners; ++i) {
      const Index v = own.outside_vertex(corners_in(*fine.complex, dart.simplex)[i]);
      const Weights place = place_in(fine.halved, given, around, v);
      for (std::size_t k = 0; k < 4; ++k) weights[k] += dart.weights[i] * place[k];
    }
    return {.simplex = parent, .barycentric = weights};
  }

  /// Those of a block's copy that meet its box.
  [[nodiscard]] std::vector<bool> simplices_in(const CutDomain<Complex>& fine, const Box<3>& box,
                                               const SimplexNumbers<Complex>& own) const {
    const Complex& complex = *fine.complex;
    std::vector<bool> found(complex.simplex_count());
    for (Index s = 0; s < found.size(); ++s) {
      Box<3> around = Box<3>::empty();
      for (const Index v : corners_in(complex, s)) around.add(fine.places[own.outside_vertex(v)]);
      found[s] = !(box.distance(around) > 0);
    }
    return found;
  }

  /// Darts thrown before that may cover something of a block, as its copy numbers them.
  [[nodiscard]] std::vector<typename Thrower::Dart> darts_near(const CutDomain<Complex>& fine,
                                                               const Box<3>& box,
                                                               SimplexNumbers<Complex>& own) const {
    std::vector<typename Thrower::Dart> found;
    for (const PointSource& dart : result_.darts) {
      if (dart.vertex != none) {
        if (!fine.has_vertex(dart.vertex) ||
            box.distance(place_of(domain_, dart.vertex)) > reach_of(limits_[dart.vertex]))
          continue;
        const Index v = fine.vertex_in_copy(dart.vertex);
        found.push_back({fine.copy->inside_vertex(v), none, {}});
        continue;
      }
      std::array<double, 3> at{};
      double limit = 0;
      for (std::size_t i = 0; i < corners; ++i) {
        const Index v = corners_in(domain_, dart.simplex)[i];
        limit += dart.barycentric[i] * limits_[v];
        for (std::size_t k = 0; k < 3; ++k) at[k] += dart.barycentric[i] * place_of(domain_, v)[k];
      }
      if (box.distance(at) > reach_of(limit)) continue;
      Weights weights = dart.barycentric;
      const Index s = fine.simplex_in_copy(dart.simplex, weights);
      const auto [simplex, place] = own.inside({.simplex = s, .barycentric = weights});
      found.push_back({none, simplex, place});
    }
    return found;
  }
  static double reach_of(double limit) { return limit * (reach / longest_edge); }

  const Complex& domain_;
  std::span<const Index> candidates_;
  const PoissonOptions& options_;
  WorkspaceState<Real>& kept_;
  WorkspaceState<Real> cut_workspace_;
  Random random_;
  std::vector<double> limits_;
  PoissonDisks result_;
  double done_ = 0, share_ = 1;  // of the domain: before, and what is under way
};

}  // namespace plexway::detail
