#pragma once

#include <concepts>
#include <cstddef>

namespace plexway {

/// What runs a solve.
enum class ExecutorKind {
  serial,  ///< Serial
  openmp,  ///< OpenMP
  gl,      ///< GL
};

/// The first argument of every operation.
template <class E>
concept ExecutorType = requires {
  { E::kind } -> std::convertible_to<ExecutorKind>;
};

/// One thread.
///
/// Solving again with the same workspace gives bit-identical results and, once field and workspace
/// have their size, allocates nothing. Cost: surfaces 50 to 80 ns a face; solids 160 ns (convex)
/// to 4 us a tetrahedron; wireframes 25 to 60 ns a vertex on lattices of a million, never more than
/// O((n + m) log n) but for Schedule::fifo; clouds 100 to 160 ns a point.
struct Serial {
  /// Its rows in the table of support.hpp.
  static constexpr ExecutorKind kind = ExecutorKind::serial;
};

/// Several threads of one process.
///
/// The step is that of Serial. Threads take the front in chunks; what they offer waits with its
/// label in a queue; the least offer to a simplex becomes its label between two rounds. So the
/// result does not depend on the number of threads or on their timing: it is the same to the last
/// bit, as far as a propagation is not cut short by max_expansions. It differs from Serial's where
/// the order of updates decides which of two paths a simplex hears of first. The workspace is the
/// one that Serial takes.
///
/// Cost: on one thread 1.1 (many sources) to 1.35 (one) times that of Serial. Threads wait for each
/// other several times for each step of the front, so it takes large domains with long fronts, and
/// cores that nobody else wants; else Serial is faster. Many fields of one domain are best had by
/// `solve_each`, which takes one thread a source. Memory in float, beyond Serial's: 8 bytes a
/// simplex, and 48 (surfaces) to 64 (solids) for each label that waits; in double 16, and about
/// twice that.
///
/// Solving throws UsageError for less than one thread or an empty chunk, and NotBuiltError in a
/// build without OpenMP. The progress callback is called by the calling thread.
struct OpenMP {
  /// Its rows in the table of support.hpp.
  static constexpr ExecutorKind kind = ExecutorKind::openmp;

  int threads = 0;  ///< 0: as many as OpenMP would take (OMP_NUM_THREADS, or one a core)
  /// Simplices that a thread takes at a time. Fronts up to this size are one thread's work.
  std::size_t chunk = 128;
  /// Surfaces and clouds, Accuracy::fast: not 0, and the surface is cut into pieces of about so
  /// many triangles (2,000 to 4,000 are best), which exchange labels over their borders, a thread
  /// each, instead of rounds over the whole front. Threads then wait for each other some dozens of
  /// times a solve instead of thousands. The result is again the same to the last bit with any
  /// number of threads, and in a single piece Serial's. Another size gives other labels, all of
  /// them as accurate. Cost: the workspace keeps the pieces of the last surface, 130 to 150 bytes a
  /// triangle in float; the first solve cuts them. Other domains go in rounds whatever this says.
  std::size_t piece = 0;
};

/// Is this executor in the build?
[[nodiscard]] bool openmp_built();

/// At most so many threads work at once. Throws as solving does.
[[nodiscard]] std::size_t team_size(const OpenMP& executor);

namespace detail {

/// What a solve by `E` on a domain `D` keeps from call to call; see WorkspaceOf.
template <class E, class D>
struct WorkspaceFor;

}  // namespace detail

/// The workspace of an executor on a kind of domain: Workspace or GLWorkspace.
template <class E, class D>
using WorkspaceOf = typename detail::WorkspaceFor<E, D>::type;

}  // namespace plexway
