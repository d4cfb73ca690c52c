#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "strings/chains.hpp"
#include "strings/corner.hpp"
#include "strings/labels.hpp"
#include "strings/media_space.hpp"
#include "strings/pull.hpp"
#include "strings/solve.hpp"

/// Shortest paths through several media, by strings.
///
/// A string is a source and a chain of doors: places where it bends or goes into another medium,
/// and the medium behind. In the order of their distance nodes offer theirs to those that share an
/// edge, through each place of the point as well. It is pulled taut; where it leaves a patch it
/// slides on to the row there, where it wants back in it is let, what it lifts off is dropped, and
/// where a leg leaves its medium the bend that it touches first is put in. All distances are
/// lengths of paths.
namespace plexway::strings {

struct MediaSource {
  Point at;
  Index point = none;            ///< if it is one
  std::vector<Index> simplices;  ///< else those that have it: MediaSpace::simplices_around
  double offset = 0;
};

class MediaSolver {
 public:
  explicit MediaSolver(const MediaSpace& space);

  /// False if the expansions ended before it did.
  bool solve(std::span<const MediaSource> sources, const Limits& limits = {});
  /// To a point of the space; +inf where nothing leads.
  [[nodiscard]] double distance(Index point) const { return best_[point]; }
  /// The nearest source; none where nothing leads.
  [[nodiscard]] Index source(Index point) const {
    const auto [node, label] = best(point);
    return label == nullptr ? none : roots_[chains_.source(label->chain)].source;
  }
  /// Takes a point in these simplices for one more, numbered MediaSpace::points(), until the next.
  void attach(const Point& at, std::span<const Index> simplices);
  /// The shortest path to a point, with both ends, and the medium of each leg; empty where nothing
  /// leads.
  struct Path {
    std::vector<Point> points;
    std::vector<Index> media;
  };
  [[nodiscard]] Path path(Index point);
  [[nodiscard]] std::size_t bytes() const;

  [[nodiscard]] const Counts& counts() const { return counts_; }

 private:
  using Kind = MediaSpace::Kind;
  static constexpr double unreached = std::numeric_limits<double>::infinity();
  static constexpr double unmoved = 1e-9;  // an end that moved less did not move
  static constexpr double rounding = 1e-9;
  static constexpr double outside = 1e-6;  // of a patch
  static constexpr double gain = 1e-7;     // slopes that count, of the slowness
  static constexpr double brief = 1e-5;    // legs that may have no length

  struct Root {
    Index source, medium, node, simplex;
    Point beside;
  };
  /// A string on its way to a new end. Each leg comes from where it was free.
  struct Leg {
    Point from, to;
    bool known = false;
  };
  struct Attempt {
    String string;
    std::vector<Index> doors;
    std::vector<Leg> legs;
    Index root = 0;
    bool touched = false;
    int splits = 0;
  };
  enum class Outcome { free, longer, stuck };
  struct Offer {
    double distance;
    Index node, chain;
    friend bool operator<(const Offer& a, const Offer& b) {
      if (a.distance != b.distance) return a.distance > b.distance;
      return a.node != b.node ? a.node > b.node : a.chain > b.chain;
    }
  };
  using Spot = std::array<double, 2>;

  void seed();
  bool go_by_edges();
  void expand(Index node, const Label& label);
  void offer_through(Index node, const Label& label, Index to);
  void offer_edge(Index node, const Label& label, Index to, double found);
  void prepare(Index node, const Label& label);
  Outcome offer(Index from, const Label& label, Index to, Index door);
  [[nodiscard]] double bound(Index from, const Label& label, Index to, Index door) const;
  void go_by_corner(Index from, const Label& label, Index to);
  void offer_corner(Index from, const Label& label, Index to);
  Outcome attempt(Index from, const Label& label, Index to, Index door);
  Outcome settle(Attempt& a, Index to, double least);
  Outcome improve(Attempt& a, Index to, Outcome outcome);
  bool past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t& i);
  [[nodiscard]] double direct(Index from, const Label& label, Index to) const {
    return label.distance + slowness(medium_of(to)) * norm(at(to) - at(from));
  }

  bool collapse(Attempt& a, std::size_t leg, bool& useless);
  bool rearrange(Attempt& a, Index to, bool& useless);
  bool leave_patch(Attempt& a, std::size_t i);
  bool lift_off_row(Attempt& a, std::size_t i);
  bool lift_off_corner(Attempt& a, std::size_t i);
  bool drop_lifted(Attempt& a, std::size_t i, Index to);
  [[nodiscard]] bool gains(const Point& in, const Point& out, std::span<const Index> doors,
                           Index before, const Point& at, Index row);
  void move_apart(Attempt& a, std::size_t begin, const Point& at);
  std::size_t blocked(const Attempt& a, Index to);
  bool insert_touched(Attempt& a, std::size_t leg, Index to);
  void replace(Attempt& a, std::size_t begin, std::size_t end, std::span<const Index> doors,
               const Point& at);
  void append(Attempt& a, Index door, const Point& at);

  [[nodiscard]] Index medium_of_leg(const Attempt& a, std::size_t leg) const {
    return leg == 0 ? roots_[a.root].medium : space_->medium_behind(a.doors[leg - 1]);
  }
  [[nodiscard]] double slowness(Index medium) const { return space_->media()[medium].slowness; }
  [[nodiscard]] Index place_of(const Attempt& a, std::size_t i) const {
    return space_->place_of(a.doors[i]);
  }
  [[nodiscard]] double offset(const Attempt& a) const {
    return sources_[roots_[a.root].source].offset;
  }
  [[nodiscard]] Point end_of_leg(const Attempt& a, std::size_t corner, std::size_t other,
                                 Index to) const;
  [[nodiscard]] Point toward(const Attempt& a, std::size_t corner, std::size_t other,
                             Index to) const;
  [[nodiscard]] bool is_edge(const Attempt& a) const;
  [[nodiscard]] double limit(Index node, const Point& last) const;
  [[nodiscard]] Point last_leg(const Attempt& a) const {
    return unit(a.string.to - a.string.corner(a.doors.size()));
  }
  void accept(const Attempt& a, Index to);
  void take(Index node, const Label& label);
  /// With the attached one, which comes last.
  [[nodiscard]] Index point_of(Index node) const {
    return node == space_->nodes() ? static_cast<Index>(space_->points()) : space_->point_of(node);
  }
  [[nodiscard]] Index medium_of(Index node) const {
    return node == space_->nodes() ? attached_medium_ : space_->medium_of(node);
  }
  [[nodiscard]] const Point& at(Index node) const {
    return node == space_->nodes() ? attached_ : space_->point(space_->point_of(node));
  }
  [[nodiscard]] std::pair<Index, const Label*> best(Index point) const;
  const Place* place(Index number);

  const MediaSpace* space_;
  std::span<const MediaSource> sources_;
  std::vector<Root> roots_;
  Chains chains_;
  std::vector<Spot> hints_;
  std::vector<VertexLabels> nodes_;
  std::vector<double> best_;   // of points
  std::vector<double> reach_;  // of nodes: the time of their longest edge
  std::vector<Offer> queue_;
  std::unordered_map<Index, Place> corners_;
  Puller puller_;
  Corner corner_;
  Attempt base_, attempt_, other_;
  std::vector<Place> copies_;  // of a problem at one point
  std::vector<Point> apart_;   // and where its places are
  Index from_ = none;
  Point attached_ = {0, 0, 0}, attached_beside_ = {0, 0, 0};
  Index attached_medium_ = none;
  bool prepared_ = false;
  double direct_ = 0;  // on from there along the edge: a string that is offered is no longer
  double behind_ = .5;
  double other_side_;  // cosine between last legs that differ
  Counts counts_;
};

}  // namespace plexway::strings
