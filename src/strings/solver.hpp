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

/// Shortest paths in flat solids and through several media, by strings.
///
/// A string is a source and a chain of doors: places where it bends or goes into another medium,
/// and the medium behind. In the order of their distance nodes offer theirs to those that share an
/// edge, through each place of the point as well. It is pulled taut; where it leaves a patch it
/// slides on to the row there, where it wants back in it is let, what it lifts off is dropped, and
/// where a leg leaves its medium the bend that it touches first is put in. All distances are
/// lengths of paths.
namespace plexway::strings {

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

class Solver {
 public:
  explicit Solver(const MediaSpace& space);

  /// False if the expansions ended before it did.
  bool solve(std::span<const Source> sources, const Limits& limits = {}) {
    clear();
    return add(sources, limits);
  }
  /// No source, and nothing is reached. Cost: what was reached.
  void clear();
  /// Where sources are points of one front, as near to each other as vertices are: a vertex keeps
  /// those that may be the nearest within this share of its reach.
  void keep_near(double share);
  /// Further sources, numbered on, as far as they are nearer than those before. The limits are for
  /// these alone.
  bool add(std::span<const Source> sources, const Limits& limits);

  /// To a point of the space; +inf where nothing leads.
  [[nodiscard]] double distance(Index point) const {
    return plain_ ? nodes_[point].best().distance : best_[point];
  }
  /// The nearest source; none where nothing leads.
  [[nodiscard]] Index source(Index point) const {
    const auto [node, label] = best(point);
    return label == nullptr ? none : label->source;
  }
  /// The strings of a node, the shortest first.
  [[nodiscard]] std::span<const Label> labels(Index node) const { return nodes_[node].labels; }
  /// Takes a point of these simplices, which these sources are in, for one more, numbered
  /// MediaSpace::points(), until the next one.
  void attach(const Point& at, std::span<const Inside> inside, std::span<const Index> sources);
  /// The length of a node's string when its end is moved to another point, of which `beside` is a
  /// little inside the medium; +inf where it is not found free.
  [[nodiscard]] double moved(Index node, const Label& label, const Point& at, const Point& beside);
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
  /// A string on its way to a new end.
  struct Attempt {
    String string;
    Index root = 0;
    bool touched = false;  ///< something was put in
    int splits = 0;
  };
  enum class Outcome { free, longer, stuck };
  using Spot = std::array<double, 2>;

  void measure_reach();
  void seed(Index number, const Source& source);
  void expand(Index node, const Label& label);
  void offer_through(Index node, const Label& label, Index to);
  void offer_edge(Index node, const Label& label, Index to, double found);
  bool go_by_edges();
  void prepare(Index node, const Label& label);
  Outcome offer(Index from, const Label& label, Index to, Index door);
  [[nodiscard]] double bound(Index from, const Label& label, Index to, Index door) const;
  void go_by_corner(Index from, const Label& label, Index to);
  Outcome attempt_corner(Index from, const Label& label, Index to);
  Outcome attempt(Index from, const Label& label, Index to, Index door);
  void start(Index to);
  Outcome settle(Attempt& a, Index to, double least);
  Outcome improve(Attempt& a, Index to, Outcome outcome);
  void past_corners(Attempt& a, Index to, Outcome& outcome);
  [[nodiscard]] Index vertex_of(const Attempt& a, std::size_t k) const;
  bool past_corner(Attempt& a, Index to, Outcome& outcome, std::size_t begin, std::size_t end,
                   Index vertex);
  void past_media(Attempt& a, Index to, Outcome& outcome);
  void past_row(Attempt& a, Index to, Outcome& outcome, std::size_t k);
  bool instead(Attempt& a, Index to, Outcome& outcome, std::size_t k, std::span<const Index> doors);

  bool collapse(Attempt& a, std::size_t leg, bool& useless);
  bool rearrange(Attempt& a, Index to, bool& useless);
  bool leave_patch(Attempt& a, std::size_t k);
  bool lift_off_row(Attempt& a, std::size_t k);
  bool lift_off_corner(Attempt& a, std::size_t k);
  [[nodiscard]] bool presses(const Attempt& a, std::size_t k, const Leg& in, const Point& from,
                             Index to) const;
  bool drop_lifted(Attempt& a, std::size_t k, Index to);
  [[nodiscard]] bool gains(const Point& in, const Point& out, std::span<const Index> doors,
                           Index before, const Point& at, Index row);
  void move_apart(Attempt& a, std::size_t begin, const Point& at);
  std::size_t blocked(const Attempt& a, Index to);
  bool insert_touched(Attempt& a, std::size_t leg, Index to);
  void replace(Attempt& a, std::size_t begin, std::size_t end, std::span<const Index> doors,
               const Point& at);
  void append(Attempt& a, Index door, const Point& at);
  [[nodiscard]] Knot knot(Index door, const Point& at);

  [[nodiscard]] double slowness(Index medium) const { return space_->media()[medium].slowness; }
  [[nodiscard]] Index place_of(const Knot& knot) const { return space_->place_of(knot.door); }
  [[nodiscard]] Kind kind(const Knot& knot) const { return space_->kind(place_of(knot)); }
  [[nodiscard]] const Root& root_of(const Label& label) const {
    return roots_[chains_.source(label.chain)];
  }
  [[nodiscard]] double offset(const Attempt& a) const {
    return sources_[roots_[a.root].source].offset;
  }
  [[nodiscard]] double length(const Attempt& a) const { return offset(a) + a.string.length; }
  [[nodiscard]] Point end_of_leg(const Attempt& a, std::size_t k, std::size_t other,
                                 Index to) const;
  [[nodiscard]] Point toward(const Attempt& a, std::size_t k, std::size_t other, Index to) const;
  [[nodiscard]] bool is_edge(const Attempt& a) const;
  /// Of a point in several media no string of one is of use that is an edge longer than the best.
  [[nodiscard]] double longest(Index node) const {
    const Index p = point_of(node);
    return p == space_->points() || space_->nodes_at(p).size() < 2 ? unreached
                                                                   : best_[p] + reach_[node];
  }
  [[nodiscard]] Spread spread(Index node) const {
    return {behind_ * slowness(medium_of(node)),
            reach_.empty() ? 0 : Spread::nearest * reach_[node], other_side_};
  }
  [[nodiscard]] double limit(Index node, Index source, const Point& last, double length) const {
    const double limit = nodes_[node].limit(source, last, spread(node), length);
    return plain_ ? limit : std::min(limit, longest(node));
  }
  [[nodiscard]] double direct(Index from, const Label& label, Index to) const {
    return label.distance + slowness(medium_of(to)) * norm(at(to) - at(from));
  }
  /// Is the edge shorter than what was found?
  [[nodiscard]] bool is_shorter(Index from, const Label& label, Index to) const {
    return direct(from, label, to) < distance(point_of(to)) * (1 - rounding);
  }
  [[nodiscard]] static Point last_leg(const Attempt& a) {
    return a.string.direction(a.string.bends());
  }
  void accept(const Attempt& a, Index to);
  void take(Index node, const Label& label);
  /// With the attached one, which comes last.
  [[nodiscard]] Index point_of(Index node) const {
    if (plain_) return node;
    return node == space_->nodes() ? static_cast<Index>(space_->points()) : space_->point_of(node);
  }
  [[nodiscard]] Index medium_of(Index node) const {
    if (plain_) return 0;
    return node == space_->nodes() ? attached_medium_ : space_->medium_of(node);
  }
  [[nodiscard]] const Point& at(Index node) const {
    return node == space_->nodes() ? attached_ : space_->point(point_of(node));
  }
  [[nodiscard]] std::pair<Index, const Label*> best(Index point) const;
  const Place* place(Index number);

  const MediaSpace* space_;
  bool plain_;  // one solid, its points the nodes
  std::vector<Origin> sources_;
  std::vector<Root> roots_;
  Chains chains_;
  std::vector<Spot> hints_;  // of a chain: where its last place was bent at last
  std::vector<VertexLabels> nodes_;
  std::vector<double> best_;  // of points, unless they are the nodes
  std::vector<double>
      reach_;  // of nodes: the time of their longest edge; none from one source in one solid
  std::vector<Index> reached_;                 // nodes
  std::vector<std::pair<Index, Index>> left_;  // edges for the end
  Queue queue_;
  std::unordered_map<Index, Place> corners_;
  Puller puller_;
  Corner corner_;
  Attempt base_;  // the string of the node that offers
  Index base_node_ = none, base_chain_ = none;
  Attempt attempt_, other_;
  String single_;              // a problem at one point
  std::vector<Place> copies_;  // of its places
  std::vector<Point> apart_;   // and where they are
  std::vector<Index> doors_, places_;
  Index from_ = none;
  Point attached_ = {0, 0, 0}, attached_beside_ = {0, 0, 0};
  Index attached_medium_ = 0;
  double direct_ = 0;  // on from there along the edge: a string that is offered is no longer
  double behind_ = .5;
  double other_side_ = .99;  // cosine between last legs that differ
  Counts counts_;
};

}  // namespace plexway::strings
