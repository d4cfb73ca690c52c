#pragma once

// What benchmarks measure with: surfaces, sources that rotate, times side by side, errors against
// exact answers.

#include <array>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "errors.hpp"
#include "harness.hpp"

namespace bench {

// ---- Surfaces ----

struct Surface {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
};

Surface read_surface(const std::filesystem::path& file);
/// The bumpy sphere with about as many vertices as asked for.
Surface bumpy_surface(std::size_t vertices);

/// The exact answers NAME.vID.txt in `folder`: one value a line in vertex order, from vertex ID.
std::vector<Truth> read_truths(const std::filesystem::path& folder, const std::string& name,
                               std::size_t vertices);

/// The surfaces that a benchmark is given, and their exact answers, which lie beside them.
struct Meshes {
  std::vector<std::string> files;
  std::vector<std::size_t> sizes;  ///< of bumpy spheres besides
  std::string truth;               ///< the folder of exact answers instead

  /// MESH, --truth-dir and, where bumpy spheres are asked for by `sizes_named`, that.
  void add_options(Arguments& arguments, const std::string& sizes_named = "");
  void each(const std::function<void(const Surface&, const std::vector<Truth>&)>& work) const;
};

// ---- Times ----

double median(std::vector<double> values);

/// Seconds that `work` takes, by the clock.
template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}
/// Of the processor, of all threads: what else runs does not count.
template <class Work>
double processor_seconds(const Work& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// How often to measure: every source `repeats` times, but no longer than `budget` seconds.
struct Effort {
  std::size_t sources = 16;
  std::size_t repeats = 3;
  double budget = 20;
  /// Times are the processor's: for one thread on a machine that others use too.
  bool processor = false;

  void add_options(Arguments& arguments);
};

/// Medians of two solvers that took turns.
struct Times {
  double first = 0;  ///< seconds a solve
  double second = 0;
  double ratio = 0;  ///< of second to first, the median over the turns
  std::size_t turns = 0;
};

using Solve = std::function<void(Index)>;

/// Lets two solvers take turns (A B A B ...), so that both meet the same clock and the same noise.
/// The source changes with each turn, and the second solver is half a rotation ahead: the branch
/// predictor learns a run by heart, be it the last one of the same solver or of one like it.
Times take_turns(std::span<const Index> sources, const Effort& effort, const Solve& first,
                 const Solve& second);

// ---- Sources ----

/// `count` numbers below `size`, in steps of the golden section: spread out, and never two
/// neighbours in a row.
std::vector<Index> spread_numbers(std::size_t count, std::size_t size);
/// `count` vertices from all over the largest component; always the same for the same surface.
std::vector<Index> rotating_sources(const Surface& surface, std::size_t count);

// ---- Errors ----

/// Adds mean, p99, max, below and wrong to a row; nothing without errors.
void add_errors(Row& row, const Errors& errors);

/// How far fields are from those of another solver, relative.
struct Apart {
  double sum = 0, most = 0;
  std::size_t count = 0;

  template <class One, class Other>
  void add(const One& one, const Other& other) {
    for (std::size_t v = 0; v < one.size(); ++v) {
      const double a = static_cast<double>(one[v]), b = static_cast<double>(other[v]);
      if (!(a > 0) || !std::isfinite(a) || !std::isfinite(b)) continue;
      sum += std::abs(b / a - 1);
      most = std::max(most, std::abs(b / a - 1));
      ++count;
    }
  }
  [[nodiscard]] double mean() const {
    return sum / static_cast<double>(std::max<std::size_t>(count, 1));
  }
};

// ---- Memory ----

/// Gives freed memory back to the system, where that can be asked for, so that it does not count as
/// resident.
void return_free_memory();
/// A line of this process's status, such as VmRSS (resident now) or VmHWM (its peak), in bytes;
/// nothing on systems without it.
std::optional<double> status_bytes(std::string_view key);

}  // namespace bench
