#include "fields/bisection.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <utility>

#include <plexway/error.hpp>

namespace plexway::detail {

void Splits::halve(Index simplex, std::size_t i, std::size_t j) {
  const Index split = static_cast<Index>(splits_.size());
  const Index before = last_[simplex];
  (before == none ? first_[simplex] : splits_[before / 2].next[before % 2]) = split;
  splits_.push_back({static_cast<Index>(last_.size()),
                     {none, none},
                     static_cast<std::uint8_t>(i),
                     static_cast<std::uint8_t>(j)});
  last_[simplex] = 2 * split;
  last_.push_back(2 * split + 1);
}

Index Splits::part(Index simplex, std::array<double, 4>& weights) const {
  for (Index n = first_[simplex]; n != none;) {
    const Split& split = splits_[n];
    double &a = weights[split.i], &b = weights[split.j];
    if (a >= b) {
      a -= b, b *= 2;
      n = split.next[0];
    } else {
      b -= a, a *= 2;
      simplex = split.other;
      n = split.next[1];
    }
  }
  return simplex;
}

template <int N>
Bisection<N>::Bisection(std::size_t vertices, std::span<const std::array<Index, corners>> simplices,
                        std::span<const std::array<Index, sides>> edges, std::vector<Edge> lengths,
                        const Excess& excess, std::size_t most, bool shape_kept)
    : vertices_(vertices),
      most_(std::min(most, most_parts)),
      edges_(std::move(lengths)),
      around_(edges_.size()),
      splits_(simplices.size()) {
  simplices_.reserve(simplices.size());
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    for (const Index e : edges[s]) around_[e].push_back(static_cast<Index>(s));
    simplices_.push_back({simplices[s], edges[s], static_cast<Index>(s)});
  }
  std::priority_queue<std::pair<double, Index>> longest;
  const auto consider = [&](Index e) {
    const double much = excess(*this, e);
    if (much > 1) longest.emplace(much, e);
  };
  for (Index e = 0; e < edges_.size(); ++e) consider(e);
  while (!longest.empty()) {
    const Index wanted = longest.top().second;
    longest.pop();
    const Index e = shape_kept ? longest_near(wanted) : wanted;
    const std::size_t before = edges_.size();
    bisect(e);
    if (e != wanted) consider(wanted);
    consider(e);  // now its first half
    for (std::size_t n = before; n < edges_.size(); ++n) consider(static_cast<Index>(n));
  }
  around_ = {};
  splits_.end();
}

template <int N>
Index Bisection<N>::longest_near(Index edge) const {
  for (;;) {
    Index longest = edge;
    for (const Index s : around_[edge])
      for (const Index e : simplices_[s].edge)
        if (edges_[e].length > edges_[longest].length * (1 + 1e-9)) longest = e;
    if (longest == edge) return edge;
    edge = longest;
  }
}

template <int N>
void Bisection<N>::bisect(Index edge) {
  if (edges_.size() > none / 4 || simplices_.size() > most_)
    throw TooManyParts(
        "the radius is too small for this domain: its simplices would have to be cut "
        "into more than " +
        std::to_string(most_) + " parts");
  const Edge old = edges_[edge];
  const Index middle = static_cast<Index>(vertices_ + halved_.size());
  halved_.emplace_back(old.vertex[0], old.vertex[1]);
  edges_[edge] = {{old.vertex[0], middle}, old.length / 2};
  const Index second = static_cast<Index>(edges_.size());
  edges_.push_back({{middle, old.vertex[1]}, old.length / 2});
  around_.emplace_back();
  const std::vector<Index> around = std::exchange(around_[edge], {});
  // Edges from the middle to other corners: simplices that share the triangle share the edge.
  std::vector<std::pair<std::pair<Index, Index>, Index>> medians;
  for (const Index s : around) {
    const Simplex whole = simplices_[s];
    std::size_t i = 0, j = 1;
    for (std::size_t b = 1; b < corners; ++b)
      for (std::size_t a = 0; a < b; ++a)
        if (whole.edge[side(a, b)] == edge) i = a, j = b;
    if (whole.vertex[i] != old.vertex[0]) std::swap(i, j);
    Simplex first = whole, last = whole;
    const Index other = static_cast<Index>(simplices_.size());
    first.vertex[j] = last.vertex[i] = middle;
    first.edge[side(i, j)] = edge;
    last.edge[side(i, j)] = second;
    for (std::size_t k = 0; k < corners; ++k) {
      if (k == i || k == j) continue;
      const Index to_first = whole.edge[side(i, k)], to_last = whole.edge[side(j, k)];
      const std::pair<Index, Index> key(to_first, to_last);
      auto known = std::find_if(medians.begin(), medians.end(),
                                [&](const auto& m) { return N > 2 && m.first == key; });
      if (known == medians.end()) {
        const double a = edges_[to_first].length, b = edges_[to_last].length, c = old.length;
        const double length = std::sqrt(std::max(0., (2 * a * a + 2 * b * b - c * c) / 4));
        medians.emplace_back(key, static_cast<Index>(edges_.size()));
        known = medians.end() - 1;
        edges_.push_back({{whole.vertex[k], middle}, length});
        around_.emplace_back();
      }
      first.edge[side(j, k)] = last.edge[side(i, k)] = known->second;
      around_[known->second].push_back(s);
      around_[known->second].push_back(other);
    }
    // What the last part took over.
    for (std::size_t b = 1; b < corners; ++b)
      for (std::size_t a = 0; a < b; ++a) {
        if (a == i || b == i) continue;
        auto& list = around_[last.edge[side(a, b)]];
        if (a == j || b == j)
          std::replace(list.begin(), list.end(), s, other);
        else
          list.push_back(other);  // an edge that both parts have
      }
    around_[edge].push_back(s);
    around_[second].push_back(other);
    splits_.halve(s, i, j);
    simplices_[s] = first;
    simplices_.push_back(last);
  }
}

template class Bisection<2>;
template class Bisection<3>;

}  // namespace plexway::detail
