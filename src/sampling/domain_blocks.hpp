#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "fields/cut_domain.hpp"
#include "paths/simplex_places.hpp"

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

}  // namespace plexway::detail
