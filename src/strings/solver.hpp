#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "strings/extender.hpp"
#include "strings/state.hpp"

/// Shortest paths in flat solids and through several media, by strings.
///
/// A string is a source and a chain of doors: places where it bends or goes into another medium,
/// and the medium behind. In the order of their distance nodes offer theirs to those that share an
/// edge. All distances are lengths of paths.
namespace plexway::detail::strings {

class Solver {
 public:
  explicit Solver(const MediaSpace& space) : space_(&space), state_(space) {
    extenders_.emplace_back(state_);
    if (!state_.plain) measure_reach();
  }
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;

  /// False if the expansions ended before it did.
  bool solve(std::span<const Source> sources, const Limits& limits = {}) {
    clear();
    return add(sources, limits);
  }
  /// No source, and nothing is reached. Cost: what was reached.
  void clear();
  /// Where sources are points of one front, as near to each other as vertices are: a vertex keeps
  /// those that may be the nearest within this share of its reach.
  void keep_near(double share) { state_.near = share * Spread::nearest; }
  /// Further sources, numbered on, as far as they are nearer than those before. The limits are for
  /// these alone.
  bool add(std::span<const Source> sources, const Limits& limits);

  /// To a point of the space; +inf where nothing leads.
  [[nodiscard]] double distance(Index point) const { return state_.distance(point); }
  /// The nearest source; none where nothing leads.
  [[nodiscard]] Index source(Index point) const {
    const auto [node, label] = best(point);
    return label == nullptr ? none : label->source;
  }
  /// The strings of a node, the shortest first.
  [[nodiscard]] std::span<const Label> labels(Index node) const {
    return state_.nodes[node].labels;
  }
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
  /// A node whose turn it is, and what it offers.
  struct Turn {
    Index node = none;
    Label label;
    Offers offers;
  };

  void measure_reach();
  void seed(Index number, const Source& source);
  std::size_t gather(const Limits& limits);
  void take_all(const Offers& offers);
  void take(Index node, const Label& label);
  bool go_by_edges();
  void set_attached(const Point& at, Index medium, const Point& beside);
  [[nodiscard]] std::pair<Index, const Label*> best(Index point) const;

  const MediaSpace* space_;
  State state_;
  std::vector<Index> reached_;                 // nodes
  std::vector<std::pair<Index, Index>> left_;  // edges for the end
  Queue queue_;
  std::deque<Extender> extenders_;  // of threads
  std::vector<Turn> turns_;         // as many as are taken at once
  Offers offers_;
  Counts counts_;
};

}  // namespace plexway::detail::strings
