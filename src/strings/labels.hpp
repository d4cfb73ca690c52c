#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <plexway/common/ids.hpp>

#include "strings/place.hpp"

/// What vertices know of the strings that reach them.
namespace plexway::strings {

/// Of unit vectors.
inline double cosine_of(const Point& a, const Point& b) { return dot(a, b); }
template <std::size_t N>
double cosine_of(const std::array<double, N>& a, const std::array<double, N>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
}

/// A string to a vertex; `P` is a point of its space.
template <class P>
struct LabelIn {
  double distance = std::numeric_limits<double>::infinity();
  Index chain = none;
  P last = {};  ///< its last leg's direction, unit: the field's gradient
};
using Label = LabelIn<Point>;

/// Strings that vertices are to offer on, the nearest first.
class Queue {
 public:
  struct Offer {
    double distance;
    Index vertex, chain;
    friend bool operator<(const Offer& a, const Offer& b) {
      if (a.distance != b.distance) return a.distance > b.distance;
      return a.vertex != b.vertex ? a.vertex > b.vertex : a.chain > b.chain;
    }
  };
  void push(const Offer& offer) {
    offers_.push_back(offer);
    std::push_heap(offers_.begin(), offers_.end());
  }
  Offer pop() {
    std::pop_heap(offers_.begin(), offers_.end());
    const Offer next = offers_.back();
    offers_.pop_back();
    return next;
  }
  void clear() { offers_.clear(); }
  [[nodiscard]] bool empty() const { return offers_.empty(); }
  [[nodiscard]] std::size_t bytes() const { return offers_.capacity() * sizeof(Offer); }

 private:
  std::vector<Offer> offers_;
};

/// What a solve took.
struct Counts {
  std::size_t expansions = 0, labels = 0;
};

struct Limits {
  double radius = std::numeric_limits<double>::infinity();
  std::size_t expansions = std::numeric_limits<std::size_t>::max();
  /// Called every 1024 expansions or oftener with how many there were, and how far the front is.
  std::function<void(std::size_t, double)> progress;
};

/// A vertex keeps the shortest strings that come to it from different sides: one that is not much
/// longer than the shortest may be the shortest of a neighbour.
template <class P>
struct VertexLabelsIn {
  using Label = LabelIn<P>;
  static constexpr std::size_t most = 2;
  static constexpr std::size_t remembered = 6;
  static constexpr double same_side = .99;  ///< cosine between the last legs of two strings
  std::array<Label, most> labels;           ///< by their distance
  std::array<Index, remembered> tried;      ///< chains of late
  Index next = 0;

  VertexLabelsIn() { tried.fill(none); }
  [[nodiscard]] const Label& best() const { return labels[0]; }
  /// The label, if it is still one of the vertex.
  [[nodiscard]] const Label* find(Index chain, double distance) const {
    for (const Label& l : labels)
      if (l.chain == chain && l.distance == distance) return &l;
    return nullptr;
  }
  [[nodiscard]] bool knows(Index chain) const {
    for (const Label& l : labels)
      if (l.chain == chain) return true;
    for (const Index t : tried)
      if (t == chain) return true;
    return false;
  }
  void remember(Index chain) {
    tried[next] = chain;
    next = (next + 1) % remembered;
  }
  /// Strings as long as this, that end in this direction, are of no use.
  [[nodiscard]] double limit(double behind, const P& last, double cosine = same_side) const {
    double limit = std::min(best().distance + behind, labels[most - 1].distance);
    for (const Label& l : labels)
      if (cosine_of(l.last, last) >= cosine) limit = std::min(limit, l.distance);
    return limit;
  }
  /// Takes a string; false if it is of no use.
  bool take(const Label& label, double behind, double cosine = same_side) {
    if (!(label.distance < limit(behind, label.last, cosine))) return false;
    // Those that are longer and alike, or too long now, make room.
    std::array<Label, most> kept;
    std::size_t n = 0;
    bool placed = false;
    const double longest = std::min(label.distance, best().distance) + behind;
    for (const Label& l : labels) {
      if (!placed && !(l.distance < label.distance)) {
        placed = true;
        if (n < most) kept[n++] = label;
      }
      const bool after =
          placed && (l.chain == label.chain || cosine_of(l.last, label.last) >= cosine);
      if (n < most && l.chain != none && !after && l.distance < longest) kept[n++] = l;
    }
    if (!placed && n < most) kept[n] = label;
    labels = kept;
    return true;
  }
};

using VertexLabels = VertexLabelsIn<Point>;

}  // namespace plexway::strings
