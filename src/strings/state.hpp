#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "strings/labels.hpp"
#include "strings/media_space.hpp"

/// What is known while strings are looked for: sources, chains, and the strings of each node.
namespace plexway::detail::strings {

/// A point as one of a simplex.
struct Inside {
  Index simplex, medium;
  std::array<Index, 4> corner;  ///< points; none beyond
  Point beside;                 ///< a little inside the medium
};

/// `inside` is looked at only when the source is added.
struct Source {
  Point at;
  Index point = none;              ///< of the space, if it is one
  std::span<const Inside> inside;  ///< else all simplices that have it
  double offset = 0;
};

/// Where the last bend of a chain is, along its place and across it.
using Spot = std::array<double, 2>;

/// What one node offers to others: strings, and chains that it tried in vain.
struct Offers {
  struct Bend {
    Index door;
    Spot at;
  };
  struct One {
    Index to;
    std::size_t end;  ///< of its bends, which begin where those of the one before end
    Label label;      ///< its chain is what comes before the bends; +inf long if it was in vain
  };
  std::vector<One> strings;
  std::vector<Bend> bends;
  std::vector<std::pair<Index, Index>> left;  ///< edges that nothing was found along

  [[nodiscard]] std::size_t bytes() const {
    return strings.capacity() * sizeof(One) + bends.capacity() * sizeof(Bend) +
           left.capacity() * sizeof(left[0]);
  }
  void clear() {
    strings.clear();
    bends.clear();
    left.clear();
  }
};

/// Read by those who make offers, any number at once, and written between that.
struct State {
  static constexpr double unreached = std::numeric_limits<double>::infinity();
  static constexpr double rounding = 1e-9;

  /// What is kept of a source.
  struct Origin {
    Point at;
    double offset;
  };
  /// A source in one medium.
  struct Root {
    Index source, medium, node, simplex;
    Point beside;
  };

  explicit State(const MediaSpace& whole) : space(&whole), plain(whole.is_plain()) {}

  const MediaSpace* space;
  bool plain;  ///< one solid, its points the nodes
  std::vector<Origin> sources;
  std::vector<Root> roots;
  Chains chains;
  std::vector<Spot> hints;  ///< of a chain: where its last place was bent at last
  std::vector<VertexLabels> nodes;
  std::vector<double> best;   ///< of points, unless they are the nodes
  std::vector<double> reach;  ///< of nodes: the time of their longest edge; none from one source in
                              ///< one solid
  double near = Spread::nearest;  ///< what of it is around a node
  /// The point that comes last, which is not one of the space.
  Point attached = {0, 0, 0}, attached_beside = {0, 0, 0};
  Index attached_medium = 0;

  /// To a point of the space; +inf where nothing leads.
  [[nodiscard]] double distance(Index point) const {
    return plain ? nodes[point].best().distance : best[point];
  }
  [[nodiscard]] double slowness(Index medium) const { return space->media()[medium].slowness; }
  /// With the attached one, which comes last.
  [[nodiscard]] Index point_of(Index node) const {
    if (plain) return node;
    return node == space->nodes() ? static_cast<Index>(space->points()) : space->point_of(node);
  }
  [[nodiscard]] Index medium_of(Index node) const {
    if (plain) return 0;
    return node == space->nodes() ? attached_medium : space->medium_of(node);
  }
  [[nodiscard]] const Point& at(Index node) const {
    return node == space->nodes() ? attached : space->point(point_of(node));
  }
  [[nodiscard]] const Root& root_of(const Label& label) const {
    return roots[chains.source(label.chain)];
  }
  /// Of a point in several media no string of one is of use that is an edge longer than the best.
  [[nodiscard]] double longest(Index node) const {
    const Index p = point_of(node);
    return p == space->points() || space->nodes_at(p).size() < 2 ? unreached
                                                                 : best[p] + reach[node];
  }
  [[nodiscard]] Spread spread(Index node) const {
    // Two that come from nearly one direction may have parted before.
    constexpr double cosine = 1 - 1e-10;
    const bool sharp = space->is_sharp(node);
    const double behind = sharp ? .75 : .5;
    return {behind * slowness(medium_of(node)), reach.empty() ? 0 : near * reach[node], cosine,
            sharp ? Spread::many : Spread::few};
  }
  [[nodiscard]] double limit(Index node, Index source, std::uint64_t media, const Point& last,
                             double length) const {
    const double limit = nodes[node].limit(source, last, spread(node), length, media);
    return plain ? limit : std::min(limit, longest(node));
  }
  /// A solid as a bit, where there are no more than these. On wires and sheets strings come from
  /// places that all have in common.
  [[nodiscard]] std::uint64_t bit(Index medium) const {
    const auto& media = space->media();
    return media.size() <= 64 && media[medium].is_solid ? std::uint64_t{1} << medium : 0;
  }
  /// Along the edge.
  [[nodiscard]] double direct(Index from, const Label& label, Index to) const {
    return label.distance + slowness(medium_of(to)) * norm(at(to) - at(from));
  }
  /// Is the edge shorter than what was found?
  [[nodiscard]] bool is_shorter(Index from, const Label& label, Index to) const {
    return direct(from, label, to) < distance(point_of(to)) * (1 - rounding);
  }
};

}  // namespace plexway::detail::strings
