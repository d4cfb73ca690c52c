#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "strings/chains.hpp"
#include "strings/corner.hpp"
#include "strings/labels.hpp"
#include "strings/pull.hpp"
#include "strings/solid_space.hpp"

/// Shortest paths in flat solids, by strings.
///
/// A string is a source and a chain of places where it bends. In the order of their distance
/// vertices offer theirs to all vertices that share an edge: the string is pulled taut to the new
/// end, places that it lifts off are dropped, and where a leg leaves the solid the place that it
/// touches first, on the way from the old end to the new one, is put in. All distances are lengths
/// of paths.
namespace plexway::strings {

struct Source {
  Point at;
  Point beside;                       ///< a little inside; unless it is a vertex
  Index vertex = none;                ///< if it is one
  std::array<Index, 4> corners = {};  ///< else those of the tetrahedron that it is in
  double offset = 0;
};

struct Limits {
  double radius = std::numeric_limits<double>::infinity();
  std::size_t expansions = std::numeric_limits<std::size_t>::max();
  /// Called every 1024 expansions or oftener with how many there were, and how far the front is.
  std::function<void(std::size_t, double)> progress;
};

/// What it took.
struct Counts {
  std::size_t expansions = 0, labels = 0;
};

class Solver {
 public:
  explicit Solver(const SolidSpace& space) : space_(&space) {}

  /// False if the expansions ended before it did.
  bool solve(std::span<const Source> sources, const Limits& limits) {
    clear();
    return add(sources, limits);
  }
  /// No source, and nothing is reached. Cost: what was reached.
  void clear();
  /// Further sources, numbered on, as far as they are nearer than those before. The limits are for
  /// these alone.
  bool add(std::span<const Source> sources, const Limits& limits);

  /// +inf where nothing leads.
  [[nodiscard]] double distance(Index vertex) const { return vertices_[vertex].best().distance; }
  /// The nearest source; none where nothing leads.
  [[nodiscard]] Index source(Index vertex) const {
    const Index chain = vertices_[vertex].best().chain;
    return chain == none ? none : chains_.source(chain);
  }
  /// The strings of a vertex, the shortest first.
  [[nodiscard]] std::span<const Label> labels(Index vertex) const {
    return vertices_[vertex].labels;
  }
  [[nodiscard]] Index source_of(const Label& label) const { return chains_.source(label.chain); }
  /// Vertices with strings, in the order that they were reached.
  [[nodiscard]] std::span<const Index> reached() const { return reached_; }
  /// Takes a point of the tetrahedron with these corners, which these sources are in, for one more
  /// vertex, numbered SolidSpace::vertices(), until the next one.
  void attach(const Point& at, const std::array<Index, 4>& corners, std::span<const Index> sources);
  /// The length of a vertex' string when its end is moved to another point, of which `beside` is a
  /// little inside the solid; +inf where it is not found free.
  [[nodiscard]] double moved(Index vertex, const Label& label, const Point& at,
                             const Point& beside);
  /// The shortest path to a vertex, its bends and both ends, from the source on. Empty where
  /// nothing leads.
  [[nodiscard]] std::vector<Point> path(Index vertex);
  [[nodiscard]] const Counts& counts() const { return counts_; }
  [[nodiscard]] std::size_t bytes() const;

 private:
  /// A string on its way to a new end. Each leg comes from where it was free.
  struct Leg {
    Point from, to;      // where it was free, a little inside the solid
    bool known = false;  // it was seen to be free there
  };
  struct Attempt {
    String string;
    std::vector<Index> places;
    std::vector<Leg> legs;
    Index source = 0;
    bool touched = false;  // something was put in
  };
  enum class Outcome { free, longer, stuck };
  struct Offer {
    double distance;
    Index vertex, chain;
    friend bool operator<(const Offer& a, const Offer& b) {
      if (a.distance != b.distance) return a.distance > b.distance;
      return a.vertex != b.vertex ? a.vertex > b.vertex : a.chain > b.chain;
    }
  };

  void seed(Index source);
  void expand(Index vertex, const Label& label);
  void prepare(Index vertex, const Label& label);
  void offer(Index from, const Label& label, Index to);
  Outcome attempt(Index from, const Label& label, Index to);
  Outcome attempt_corner(Index from, const Label& label, Index to);
  Outcome settle(Attempt& attempt, Index to, double least);
  Outcome past_corners(Attempt& attempt, Index to, Outcome outcome);
  bool past_corner(Attempt& attempt, Index to, Outcome& outcome, std::size_t begin, std::size_t end,
                   Index vertex);
  static Point last_leg(const Attempt& a) {
    return unit(a.string.to - a.string.corner(a.places.size()));
  }
  [[nodiscard]] bool is_edge(const Attempt& attempt) const;
  bool drop_lifted(Attempt& attempt, Index to);
  std::size_t blocked(const Attempt& attempt, Index to);
  bool insert_touched(Attempt& attempt, std::size_t leg, Index to);
  void insert(Attempt& attempt, std::size_t n, Index place, const Point& at, const Point& beside);
  static void drop(Attempt& attempt, std::size_t n, const Point& beside);
  Point end_of_leg(const Attempt& attempt, std::size_t corner, std::size_t other, Index to) const;
  Point toward(const Attempt& attempt, std::size_t corner, std::size_t other, Index to) const;
  void accept(const Attempt& attempt, Index to);
  void take(Index vertex, const Label& label);
  const Place* place(Index number);
  [[nodiscard]] const Point& point(Index vertex) const {
    return vertex == space_->vertices() ? attached_ : space_->point(vertex);
  }

  const SolidSpace* space_;
  std::vector<Source> sources_;
  Chains chains_;
  std::vector<double> hints_;  // of a chain: where its last place was bent at last
  std::vector<VertexLabels> vertices_;
  std::vector<Index> reached_;
  std::vector<Offer> queue_;
  std::unordered_map<Index, Place> corners_;
  Puller puller_;
  Corner corner_;
  Attempt base_, attempt_, other_;
  Index from_ = none;  // the vertex that offers
  Point attached_ = {0, 0, 0}, attached_beside_ = {0, 0, 0};
  bool prepared_ = false;
  Index base_vertex_ = none, base_chain_ = none;  // whose string `base_` is, if it is prepared
  double direct_ = 0;  // on from there along the edge: a string that is offered is no longer
  double behind_ = .5;
  Counts counts_;
};

}  // namespace plexway::strings
