#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <vector>

#include <plexway/common/ids.hpp>

#include "strings/place.hpp"

/// What vertices know of the strings that reach them.
namespace plexway::detail::strings {

/// Chains of places that strings bend at, from a source on. Each is kept once, as the chain before
/// it and one more place, so that two strings along the same places have the same number.
class Chains {
 public:
  /// One link: what comes before it, and the place at its end. Of a root the source.
  struct Link {
    Index parent, place;
  };

  void clear() {
    links_.clear();
    table_.assign(64, none);
  }
  /// The chain with no place.
  Index root(Index source) { return with(none, source); }
  /// The chain with a place behind.
  Index with(Index parent, Index place) {
    if (2 * links_.size() > table_.size()) grow();
    Index& found = table_[slot_of(parent, place)];
    if (found == none) {
      found = static_cast<Index>(links_.size());
      links_.push_back({parent, place});
    }
    return found;
  }

  /// The same, none if there is no such chain.
  [[nodiscard]] Index find(Index parent, Index place) const {
    return table_[slot_of(parent, place)];
  }

  [[nodiscard]] const Link& operator[](Index chain) const { return links_[chain]; }
  [[nodiscard]] bool is_root(Index chain) const { return links_[chain].parent == none; }
  [[nodiscard]] Index source(Index chain) const {
    while (!is_root(chain)) chain = links_[chain].parent;
    return links_[chain].place;
  }

  [[nodiscard]] std::size_t size() const { return links_.size(); }
  [[nodiscard]] std::size_t bytes() const {
    return links_.capacity() * sizeof(Link) + table_.capacity() * sizeof(Index);
  }

 private:
  // Where it is, or is to be.
  [[nodiscard]] std::size_t slot_of(Index parent, Index place) const {
    const std::uint64_t key = std::uint64_t{parent} << 32 | place;
    std::size_t slot = (key * 0x9E3779B97F4A7C15u >> 20) & (table_.size() - 1);
    for (; table_[slot] != none; slot = (slot + 1) & (table_.size() - 1)) {
      const Link& link = links_[table_[slot]];
      if (link.parent == parent && link.place == place) break;
    }
    return slot;
  }
  void grow() {
    table_.assign(2 * table_.size(), none);
    for (Index c = 0; c < links_.size(); ++c)
      table_[slot_of(links_[c].parent, links_[c].place)] = c;
  }

  std::vector<Link> links_;
  std::vector<Index> table_;  // open addressing; a power of two
};

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
  Index chain = none, source = none;
  P last = {};              ///< its last leg's direction, unit: the field's gradient
  double leg = 0;           ///< and the time that it takes
  std::uint64_t media = 0;  ///< solids that it leads through, a bit each
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
  [[nodiscard]] std::size_t size() const { return offers_.size(); }
  [[nodiscard]] std::size_t bytes() const { return offers_.capacity() * sizeof(Offer); }

 private:
  std::vector<Offer> offers_;
};

/// What a solve took.
struct Counts {
  std::size_t expansions = 0, labels = 0;
};

/// Threads that share the work of a solve. How many there are does not change a bit of it.
struct Threads {
  using Work = std::function<void(std::size_t, std::size_t)>;
  std::size_t count = 1;
  /// Calls work(item, thread) for so many items; none: the calling thread takes all.
  std::function<void(std::size_t, const Work&)> share;
};

struct Limits {
  double radius = std::numeric_limits<double>::infinity();
  std::size_t expansions = std::numeric_limits<std::size_t>::max();
  /// Called every 1024 expansions or oftener with how many there were, and how far the front is.
  std::function<void(std::size_t, double)> progress;
  Threads threads;
};

/// Which strings of a vertex are of use, in time.
struct Spread {
  /// So near to a corner, of the longest edge there, is every point of a triangle that is nearest
  /// to it: where it is acute the circle's centre is no farther, else no point of the longest side.
  static constexpr double nearest = .7072;

  double behind;    ///< of one source and media others are at most so much longer than the first
  double reach;     ///< so far around the vertex others are kept that may be the shortest there
  double cosine;    ///< at most, between the last legs of any two of one source and media
  Index own = few;  ///< so many of one source and media at most

  static constexpr Index few = 2, many = 8;
};

/// A vertex keeps the shortest strings that come to it from different directions, a few from each
/// source through each set of solids: one that is not much longer than the shortest may be the
/// shortest of a neighbour. Two are enough but where edges are sharp (SolidSpace::is_sharp). Of
/// other sources it keeps all that may be the shortest within reach, and likewise through other
/// solids, up to four of a source or as many as `own`. In a convex solid all vertices find theirs
/// by that: a source that is the nearest at one is so all the way from it, thus kept at the nearest
/// corner of each face that the way passes, and corners of faces in turn share edges.
template <class P>
struct VertexLabelsIn {
  using Label = LabelIn<P>;
  static constexpr std::size_t remembered = 6;
  static constexpr Index most = 4;      ///< strings of one source, or `own` if that is more
  std::vector<Label> labels;            ///< by their distance
  std::array<Index, remembered> tried;  ///< chains of late
  Index next = 0;

  VertexLabelsIn() { tried.fill(none); }
  void clear() {
    labels.clear();
    tried.fill(none);
    next = 0;
  }
  [[nodiscard]] bool empty() const { return labels.empty(); }
  /// +inf long, and of no chain, if there is none.
  [[nodiscard]] const Label& best() const {
    static const Label unknown;
    return labels.empty() ? unknown : labels[0];
  }
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
  /// Strings of a source, through these media, as long as this, that end in this direction, are of
  /// no use; 0 for any direction. Not more exact than needed for one of a length.
  [[nodiscard]] double limit(Index source, const P& last, const Spread& spread, double length,
                             std::uint64_t media = 0) const {
    double limit = std::numeric_limits<double>::infinity();
    const Index all = std::max(most, spread.own);
    Index count = 0, owned = 0;
    for (const Label& l : labels) {
      if (limit <= length || limit <= l.distance) break;
      if (l.source == source && ++count == all) return std::min(limit, l.distance);
      const bool own = l.source == source && l.media == media;
      owned += own ? 1 : 0;
      limit = std::min(limit, l.distance + (own ? own_lead(l, last, spread, owned)
                                                : lead(l, last, spread.reach)));
    }
    return limit;
  }
  /// Takes a string; false if it is of no use.
  bool take(const Label& label, const Spread& spread) {
    for (const Label& l : labels)
      if (l.chain == label.chain && !(label.distance < l.distance)) return false;
    if (!(label.distance < limit(label.source, label.last, spread, label.distance, label.media)))
      return false;
    std::size_t n = 0;
    while (n < labels.size() && labels[n].distance < label.distance) ++n;
    // Those behind it that are of no use now make room.
    const auto is_of_source = [&](const Label& l) { return l.source == label.source; };
    const auto is_own = [&](const Label& l) { return is_of_source(l) && l.media == label.media; };
    const auto end = labels.begin() + static_cast<std::ptrdiff_t>(n);
    const auto first = std::find_if(labels.begin(), end, is_own);
    const double longest = (first != end ? first->distance : label.distance) + spread.behind;
    std::size_t kept = n;
    const auto up_to_here = [&](const auto& is) {
      return static_cast<Index>(std::count_if(labels.begin(), end, is)) + 1;
    };
    const Index all = std::max(most, spread.own);
    Index count = up_to_here(is_of_source), owned = up_to_here(is_own);
    for (std::size_t k = n; k < labels.size(); ++k) {
      const Label l = labels[k];
      const bool own = is_own(l);
      if (is_of_source(l) && count == all) continue;
      if (own && (l.chain == label.chain || !(l.distance < longest))) continue;
      if (!(l.distance < label.distance + (own ? own_lead(label, l.last, spread, owned)
                                               : lead(label, l.last, spread.reach))))
        continue;
      owned += own ? 1 : 0;
      count += is_of_source(l) ? 1 : 0;
      labels[kept++] = l;
    }
    labels.resize(kept);
    labels.reserve(2);
    labels.insert(labels.begin() + static_cast<std::ptrdiff_t>(n), label);
    return true;
  }

 private:
  /// By how much others of one source and media may be longer than the `number`th that is kept.
  static double own_lead(const Label& own, const P& other, const Spread& spread, Index number) {
    return number >= spread.own || cosine_of(own.last, other) >= spread.cosine ? 0 : spread.behind;
  }
  /// And of another: by as much as they may get shorter within reach at most. A string's
  /// length grows as its last leg's, the other's is convex.
  static double lead(const Label& own, const P& other, double reach) {
    if (cosine_of(other, other) == 0 || own.leg <= reach / 2) return 2 * reach;
    const double apart = std::sqrt(std::max(0., 2 - 2 * cosine_of(own.last, other)));
    return std::min(2., apart + reach / (2 * own.leg)) * reach;
  }
};

using VertexLabels = VertexLabelsIn<Point>;

}  // namespace plexway::detail::strings
