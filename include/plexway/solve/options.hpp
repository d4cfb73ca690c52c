#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include <plexway/solve/accuracy.hpp>
#include <plexway/solve/probe_table.hpp>

namespace plexway {

/// When does a simplex see the virtual source through a hinge, and where does the path bend if not?
enum class Visibility {
  /// Default: each label remembers the saddle nearest to its line of sight on either side, and
  /// bends there; elsewhere it keeps its source until a whole hinge lies in shadow.
  saddles,
  /// Probe between centroid and apex by a table (GSP 2021, section 4): PropagateOptions::probe.
  tuned,
  /// Probe the centroid.
  centroid,
  /// Probe the apex: coarser, but no distance is below the exact one.
  upper_bound,
};

/// Which label propagates next?
enum class Schedule {
  dual_queue,  ///< default: first in first out, nearer labels than the current limit first
  fifo,        ///< first in first out
  priority,    ///< nearest first: fewest expansions, a heap to pay for them
};

/// How far along a propagation is.
struct Progress {
  std::size_t expansions;  ///< simplices expanded so far
  std::size_t reached;     ///< simplices reached so far
  std::size_t simplices;   ///< in the whole domain
  double distance;         ///< the front is about here, in the domain's unit
};

/// How far a propagation goes, and by which rule.
struct PropagateOptions {
  /// Of windows count below schedule, radius, max_expansions and progress. With others (visibility,
  /// step, vectorised) `usual` is `fast`, and windows asked for by name are refused.
  Accuracy accuracy = Accuracy::usual();
  /// When a simplex sees a virtual source.
  Visibility visibility = Visibility::saddles;
  /// Which label propagates next.
  Schedule schedule = Schedule::dual_queue;
  /// Width of the dual queue's limit, in mean edge lengths, > 0.
  double step = 1;
  /// Simplices whose centre is farther than this (domain's unit) are not expanded.
  double radius = std::numeric_limits<double>::infinity();
  /// Stop after this many expansions; what is known by then stays (DistanceField::complete).
  std::size_t max_expansions = std::numeric_limits<std::size_t>::max();
  /// Called about every 65536 expansions; returning false stops with Cancelled.
  std::function<bool(const Progress&)> progress = {};
  /// false: the full rule for every hinge, instead of the vectorised step where that is enough. The
  /// same rule; rounding may choose between equal paths. For tests and benchmarks.
  bool vectorised = true;
  /// The table of Visibility::tuned. Shares from 0 to 1.5, thresholds finite.
  ProbeTable probe = ProbeTable::learned();
};

/// Options whose order is known when a program is compiled. Executors without order do not take
/// them: that is then an error of the compiler, where PropagateOptions would give one at run time.
struct NearestFirst : PropagateOptions {
  NearestFirst() { schedule = Schedule::priority; }
};

}  // namespace plexway
