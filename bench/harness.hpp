#pragma once

// What the benchmarks share: surfaces, sources that rotate, times side by side, errors against
// exact answers.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <plexway/complex/ids.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/propagate/options.hpp>

#include "processor_time.hpp"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bench {

/// Labels, one a triangle: what tables call fast, and what orders, policies and executors are
/// compared with. What is not asked for by name is windows (bench_windows compares both).
inline plexway::PropagateOptions one_label() {
  plexway::PropagateOptions options;
  options.accuracy = plexway::Accuracy::fast();
  return options;
}

using plexway::Index;

struct Surface {
  std::string name;
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<Index, 3>> faces;
};

inline Surface read_surface(const std::filesystem::path& file) {
  auto read = plexway::io::read_triangles(file);
  return {file.stem().string(), std::move(read.positions), std::move(read.triangles)};
}

// ---- Times ----

inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// Seconds that `work` takes.
template <class Work>
double seconds(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// How often to measure: every source `repeats` times, but no longer than `budget` seconds.
struct Effort {
  std::size_t sources = 16;
  std::size_t repeats = 3;
  double budget = 20;
  /// An untimed solve before each timed one: caches then hold the solver's own data, as when one
  /// field after another is computed, rather than the other solver's.
  bool warm = false;
  /// Times are the processor's: for one thread on a machine that others use too.
  bool processor = false;
};

/// Medians of two solvers that took turns.
struct Times {
  double first = 0;  ///< seconds a solve
  double second = 0;
  double ratio = 0;  ///< of second to first, the median over the turns
  std::size_t turns = 0;
};

/// Lets two solvers take turns (A B A B ...), so that both meet the same clock and the same noise.
/// The source changes with each turn, and the second solver is half a rotation ahead: the branch
/// predictor learns a run by heart, be it the last one of the same solver or of one like it.
template <class First, class Second>
Times take_turns(std::span<const Index> sources, const Effort& effort, const First& first,
                 const Second& second) {
  std::vector<double> a;
  std::vector<double> b;
  std::vector<double> ratios;
  const auto timed = [&](const auto& work) {
    return effort.processor ? processor_seconds(work) : seconds(work);
  };
  const auto turn = [&](std::size_t i) {
    const std::size_t ahead = (i + sources.size() / 2) % sources.size();
    const std::size_t other = (i + sources.size() / 3) % sources.size();
    if (effort.warm) first(sources[other]);
    a.push_back(timed([&] { first(sources[i]); }));
    if (effort.warm) second(sources[other]);
    b.push_back(timed([&] { second(sources[ahead]); }));
    ratios.push_back(b.back() / a.back());
    return a.back() + b.back();
  };
  // The first turn warms up, unless a single turn is all that the budget allows.
  double spent = turn(sources.size() - 1);
  if (spent < effort.budget) {
    a.clear();
    b.clear();
    ratios.clear();
  }
  for (std::size_t repeat = 0; repeat < effort.repeats; ++repeat)
    for (std::size_t i = 0; i < sources.size(); ++i)
      if (ratios.empty() || spent < effort.budget) spent += turn(i);
  return {median(a), median(b), median(ratios), ratios.size()};
}

// ---- Sources ----

/// `count` numbers below `size`, in steps of the golden section: spread out, and never two
/// neighbours in a row.
inline std::vector<Index> spread_numbers(std::size_t count, std::size_t size) {
  std::vector<Index> numbers;
  double place = 0.5;
  for (std::size_t i = 0; i < count; ++i) {
    numbers.push_back(static_cast<Index>(place * static_cast<double>(size)));
    place = std::fmod(place + 0.6180339887498949, 1.0);
  }
  return numbers;
}

/// `count` vertices from all over the largest component; always the same for the same surface.
inline std::vector<Index> rotating_sources(const Surface& surface, std::size_t count) {
  std::vector<Index> parent(surface.positions.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root = [&](Index v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [a, b, c] : surface.faces) {
    parent[root(a)] = root(b);
    parent[root(b)] = root(c);
  }
  std::vector<std::size_t> size(parent.size(), 0);
  for (Index v = 0; v < parent.size(); ++v) ++size[root(v)];
  const auto largest =
      static_cast<Index>(std::max_element(size.begin(), size.end()) - size.begin());
  std::vector<Index> members;
  for (Index v = 0; v < parent.size(); ++v)
    if (root(v) == largest) members.push_back(v);
  auto sources = spread_numbers(count, members.size());
  for (Index& source : sources) source = members[source];
  return sources;
}

// ---- Exact answers ----

struct Truth {
  Index source = 0;
  std::vector<double> distance;  ///< one a vertex; NaN where not known
};

/// The exact answers NAME.vID.txt in `folder`: one value a line in vertex order, from vertex ID.
inline std::vector<Truth> read_truths(const std::filesystem::path& folder, const Surface& surface) {
  std::vector<Truth> truths;
  if (folder.empty() || !std::filesystem::is_directory(folder)) return truths;
  const std::string prefix = surface.name + ".v";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (!file.starts_with(prefix) || !file.ends_with(".txt")) continue;
    const std::string id = file.substr(prefix.size(), file.size() - prefix.size() - 4);
    if (id.empty() || id.find_first_not_of("0123456789") != std::string::npos) continue;
    Truth truth{static_cast<Index>(std::stoul(id)), {}};
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) truth.distance.push_back(std::stod(line));
    if (truth.distance.size() != surface.positions.size() || truth.source >= truth.distance.size())
      throw std::runtime_error(entry.path().string() + ": not one value for each vertex of " +
                               surface.name);
    truths.push_back(std::move(truth));
  }
  std::sort(truths.begin(), truths.end(),
            [](const Truth& a, const Truth& b) { return a.source < b.source; });
  return truths;
}

/// Relative errors, pooled over sources. `wrong` counts what has no error in per cent: NaN, a
/// finite distance where no path leads, +inf where one does, a source that is not at 0.
class Errors {
 public:
  void add(const Truth& truth, std::span<const double> found) {
    for (std::size_t v = 0; v < found.size(); ++v) {
      const double exact = truth.distance[v];
      if (std::isnan(exact)) continue;
      const bool comparable = std::isfinite(exact) && std::isfinite(found[v]);
      if (comparable && exact > 0)
        signed_.push_back(found[v] / exact - 1);
      else if (found[v] != exact)  // both +inf, or both 0, are right
        ++wrong_;
    }
  }

  struct Summary {
    double mean, p99, max;
    double most_below;  ///< most negative signed error; 0 if there is none
    std::size_t wrong;
  };

  [[nodiscard]] std::optional<Summary> summary() const {
    if (signed_.empty()) return std::nullopt;
    std::vector<double> size(signed_.size());
    std::transform(signed_.begin(), signed_.end(), size.begin(),
                   [](double e) { return std::abs(e); });
    std::sort(size.begin(), size.end());
    const double count = static_cast<double>(size.size());
    const auto rank = static_cast<std::size_t>(std::ceil(0.99 * count)) - 1;
    return Summary{std::accumulate(size.begin(), size.end(), 0.0) / count, size[rank], size.back(),
                   std::min(0.0, *std::min_element(signed_.begin(), signed_.end())), wrong_};
  }

 private:
  std::vector<double> signed_;
  std::size_t wrong_ = 0;
};

// ---- Memory ----

/// Gives freed memory back to the system, where that can be asked for, so that it does not count as
/// resident.
inline void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// A line of this process's status, such as VmRSS (resident now) or VmHWM (its peak), in bytes;
/// nothing on systems without it.
inline std::optional<double> status_bytes(std::string_view key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == ':')
      return 1024 * std::stod(line.substr(key.size() + 1));
  return std::nullopt;
}

}  // namespace bench
