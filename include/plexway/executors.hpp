#pragma once

#include <concepts>
#include <cstddef>
#include <memory>

namespace plexway {

class GLWorkspace;
class PieceRanks;

/// The executors: they run a solve.
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
/// The step is that of Serial. Surfaces, clouds and wireframes are cut into pieces, which exchange
/// labels or windows over their borders; in solids and mixed domains that strings solve, threads
/// share the vertices of the front. Sheets that join to one surface go as that. Solids by `fast`,
/// other mixed domains and complexes of any dimension are one thread's, with Serial's bits.
/// Either way the result does not depend on the number of threads or on their timing: it is the
/// same to the last bit, also where a propagation is cut short by max_expansions. Exact windows,
/// strings, a domain of a single piece that is cut and distances in wireframes have Serial's bits.
/// Else it differs where the order of work decides, and is as accurate. The workspace is the one
/// that Serial takes.
///
/// Cost: on one thread 1.05 to 1.2 times that of Serial in pieces, and more. Many fields of one
/// domain are best had by `solve_each`, which takes one thread a source. Memory in float, beyond
/// Serial's: pieces of surfaces 130 to 150 bytes a triangle, of wireframes 20 a vertex, kept from
/// solve to solve; in double about twice that.
///
/// Solving throws UsageError for less than one thread, and NotBuiltError in a
/// build without OpenMP. The progress callback is called by the calling thread.
struct OpenMP {
  /// Its rows in the table of support.hpp.
  static constexpr ExecutorKind kind = ExecutorKind::openmp;

  int threads = 0;  ///< 0: as many as OpenMP would take (OMP_NUM_THREADS, or one a core)
  /// About so many simplices (vertices of wireframes) a piece. 0: by the domain, and a single piece
  /// where it is small (32,768) or pieces do not pay, which is the serial loop. Threads wait for
  /// each other once a superstep, some dozens to hundreds of times a solve. Another size gives
  /// other labels and merged windows, all of them as accurate. The first solve cuts the domain,
  /// which takes about as long as a solve. By windows an order other than Schedule::dual_queue, and
  /// a solve that keeps its windows for distances inside triangles, is one thread's.
  std::size_t piece = 0;
  /// Null, or processes that share the pieces (executors/piece_ranks.hpp): piece p is that of rank
  /// p modulo their number, and `threads` are this one's. Each gets the whole field, the same bits
  /// as without. Must outlive the solve. What does not go in pieces each of them solves for itself.
  PieceRanks* ranks = nullptr;
};

/// OpenGL compute shaders, on a graphics processor or on Mesa's software renderer; no window.
///
/// A context and the shaders it has compiled are made at first use, once a process and device, and
/// then kept (some 0.1 to 1 s). Any thread may call; calls on one device take turns, and what
/// context was current in the thread is so again afterwards.
///
/// Everything here throws NotBuiltError, saying what is missing, where the machine has no EGL, no
/// OpenGL 4.3, or too small a buffer for the domain.
///
/// A solve (solve.hpp) is as by Serial with these differences. Many labels are expanded at once, in
/// rounds, with the same bits each time. They differ from Serial's as those of two schedules of
/// Serial do, 2e-4 to 1e-3 in the mean and 1e-2 at worst, and are as
/// near to the exact ones (docs/contributing/methods/executors.md). On wireframes they are those of
/// Serial to the bit. Numbers are single precision; UsageError for more than 2^27 sources. Progress
/// is reported every few rounds. A bounded search costs memory and time for the whole domain. For
/// many fields `solve_each` is what a graphics processor does best. Source: Trettner, Bommes,
/// Kobbelt: Geodesic Distance Computation via Virtual Source Propagation, SGP 2021, section 5.
struct GL {
  /// Its rows in the table of support.hpp.
  static constexpr ExecutorKind kind = ExecutorKind::gl;
  /// What it keeps from call to call.
  using Workspace = GLWorkspace;

  /// Its number in gl_devices(); -1: the first that is not software, or the first.
  int device = -1;
  /// Room for so many waiting labels at first; 0: chosen by the domain. It grows when needed.
  std::size_t queue = 0;
  /// Bytes on the device that the fields of one launch may take together (`solve_each`).
  std::size_t batch_bytes = std::size_t{1} << 30;
};

/// All that a propagation keeps on the device: the domain, labels, queues. Belongs to one domain
/// and one thread at a time; the domain is copied to the device when it is first met, so that a
/// workspace that is kept makes the second solve cheaper. Movable.
class GLWorkspace {
 public:
  GLWorkspace();
  ~GLWorkspace();
  /// Moves what it holds; what is left may be assigned to or destroyed, no more.
  GLWorkspace(GLWorkspace&&) noexcept;
  /// Likewise.
  GLWorkspace& operator=(GLWorkspace&&) noexcept;

  /// Bytes on the device.
  [[nodiscard]] std::size_t bytes() const;
  /// How often the queues had to grow during the last solve.
  [[nodiscard]] std::size_t growths() const;
  /// Rounds of the last solve: one launch each.
  [[nodiscard]] std::size_t rounds() const;

  struct Implementation;
  /// For the library's own use.
  [[nodiscard]] Implementation& implementation() { return *implementation_; }

 private:
  std::unique_ptr<Implementation> implementation_;
};

/// Is OpenMP in the build?
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
