#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <plexway/common/ids.hpp>

namespace plexway::detail {

/// An axis-parallel box of R^N.
template <int N>
struct Box {
  std::array<double, N> low, high;

  [[nodiscard]] static Box empty() {
    Box box;
    box.low.fill(std::numeric_limits<double>::infinity());
    box.high.fill(-std::numeric_limits<double>::infinity());
    return box;
  }
  void add(const std::array<double, N>& point) {
    for (std::size_t d = 0; d < N; ++d) {
      low[d] = std::min(low[d], point[d]);
      high[d] = std::max(high[d], point[d]);
    }
  }
  void add(const Box& box) {
    add(box.low);
    add(box.high);
  }
  void widen(double by) {
    for (std::size_t d = 0; d < N; ++d) low[d] -= by, high[d] += by;
  }
  /// Half of its surface, or in other dimensions what is proportional to the lines that meet it.
  [[nodiscard]] double area() const {
    double sum = 0;
    for (std::size_t d = 0; d < N; ++d) {
      double face = 1;
      for (std::size_t e = 0; e < N; ++e) face *= e == d ? 1 : high[e] - low[e];
      sum += face;
    }
    return sum;
  }
  /// From another box, or a point; 0 where they meet.
  [[nodiscard]] double distance(const Box& other) const {
    double sum = 0;
    for (std::size_t d = 0; d < N; ++d) {
      const double gap = std::max({0., other.low[d] - high[d], low[d] - other.high[d]});
      sum += gap * gap;
    }
    return std::sqrt(sum);
  }
  [[nodiscard]] double distance(const std::array<double, N>& point) const {
    return distance(Box{point, point});
  }
};

/// Boxes, parted along the widest axis until a few are left: finds those that a region may meet.
/// Cost: n log^2 n to build; a search visits nodes that the region meets.
template <int N>
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::span<const Box<N>> boxes) : items_(boxes.size()) {
    std::iota(items_.begin(), items_.end(), Index{0});
    if (!boxes.empty()) grow(boxes, 0, static_cast<Index>(boxes.size()));
  }

  [[nodiscard]] bool empty() const { return items_.empty(); }

  /// visit(item) for the items of all leaves whose box, and those above, `meets`.
  template <class Meets, class Visit>
  void search(const Meets& meets, const Visit& visit) const {
    for (Index at = 0; at < nodes_.size();) {
      const Node& node = nodes_[at];
      if (!meets(node.box)) {
        at = node.skip;
        continue;
      }
      for (Index i = node.begin; i < node.end; ++i) visit(items_[i]);
      ++at;
    }
  }

  [[nodiscard]] std::size_t bytes() const {
    return nodes_.capacity() * sizeof(Node) + items_.capacity() * sizeof(Index);
  }

 private:
  static constexpr Index leaf = 3;  // items at most

  /// In depth-first order; `skip` is the first node that is not below this one. Items of leaves.
  struct Node {
    Box<N> box;
    Index skip, begin, end;
  };

  /// How many of a row of items one side has where the sides, weighed by how many they have, are
  /// met by the fewest lines (Goldsmith and Salmon, Automatic creation of object hierarchies for
  /// ray tracing, 1987).
  static Index split(std::span<const Box<N>> boxes, std::span<const Index> items) {
    const auto n = static_cast<Index>(items.size());
    std::vector<double> cost(n, 0);
    for (const bool back : {false, true}) {
      Box<N> side = Box<N>::empty();
      for (Index i = 0; i + 1 < n; ++i) {
        side.add(boxes[items[back ? n - 1 - i : i]]);
        cost[back ? n - 1 - i : i + 1] += side.area() * (i + 1);
      }
    }
    // The middle, unless another is better: where all cost the same the tree is not to be a list.
    constexpr double rounding = 1e-12;
    Index best = n / 2;
    for (Index i = 1; i < n; ++i)
      if (cost[i] < cost[best] * (1 - rounding)) best = i;
    return best;
  }

  void grow(std::span<const Box<N>> boxes, Index begin, Index end) {
    const std::size_t at = nodes_.size();
    Box<N> box = Box<N>::empty(), middles = Box<N>::empty();
    const auto middle = [&](Index i, std::size_t d) { return boxes[i].low[d] + boxes[i].high[d]; };
    for (Index i = begin; i < end; ++i) {
      box.add(boxes[items_[i]]);
      std::array<double, N> m;
      for (std::size_t d = 0; d < N; ++d) m[d] = middle(items_[i], d);
      middles.add(m);
    }
    nodes_.push_back({box, 0, begin, end - begin > leaf ? begin : end});
    if (end - begin > leaf) {
      std::size_t axis = 0;
      for (std::size_t d = 1; d < N; ++d)
        if (middles.high[d] - middles.low[d] > middles.high[axis] - middles.low[axis]) axis = d;
      std::sort(items_.begin() + begin, items_.begin() + end, [&](Index a, Index b) {
        const double l = middle(a, axis), r = middle(b, axis);
        return l != r ? l < r : a < b;
      });
      const Index half = begin + split(boxes, std::span(items_).subspan(begin, end - begin));
      grow(boxes, begin, half);
      grow(boxes, half, end);
    }
    nodes_[at].skip = static_cast<Index>(nodes_.size());
  }

  std::vector<Node> nodes_;
  std::vector<Index> items_;
};

}  // namespace plexway::detail
