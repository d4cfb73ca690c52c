// What building costs before the first solve: surfaces, the same by way of Delaunay triangles, and
// solids. Times are medians of the processor, one thread, or with --threads of the clock;
// instructions and cycles are those of the processor's own counters for the thread that calls,
// which other programs disturb not at all and little (Linux; blank where they are not to be had);
// memory is what is allocated beyond the input, at the peak and held.
//
// bench/first.py --before builds this file with the library of an earlier commit: what is asked of
// the library stands in built.hpp.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#ifdef __linux__
#include <linux/perf_event.h>
#include <malloc.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <plexway/io/tets.hpp>

#include "built.hpp"
#include "compare.hpp"
#include "processor_time.hpp"

namespace {

std::atomic<std::size_t> held = 0, peak = 0;

void reach(std::size_t now) {
  std::size_t known = peak;
  while (known < now && !peak.compare_exchange_weak(known, now)) {
  }
}

void* counted(std::size_t size) {
  void* p = std::malloc(size > 0 ? size : 1);
  if (p == nullptr) throw std::bad_alloc();
#ifdef __linux__
  held += malloc_usable_size(p);
#endif
  reach(held);
  return p;
}
void release(void* p) {
#ifdef __linux__
  if (p != nullptr) held -= malloc_usable_size(p);
#endif
  std::free(p);
}
void* counted(std::size_t size, std::align_val_t align) {
  const std::size_t a = static_cast<std::size_t>(align);
  void* p = std::aligned_alloc(a, (size + a - 1) / a * a);
  if (p == nullptr) throw std::bad_alloc();
#ifdef __linux__
  held += malloc_usable_size(p);
#endif
  reach(held);
  return p;
}

}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t align) { return counted(size, align); }
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace {

/// What the processor counts of this thread outside the kernel.
class Counter {
 public:
  enum class Of { instructions, cycles };
  explicit Counter([[maybe_unused]] Of what) {
#ifdef __linux__
    perf_event_attr wanted{};
    wanted.type = PERF_TYPE_HARDWARE;
    wanted.size = sizeof wanted;
    wanted.config = what == Of::cycles ? PERF_COUNT_HW_CPU_CYCLES : PERF_COUNT_HW_INSTRUCTIONS;
    wanted.exclude_kernel = 1;
    file_ = static_cast<int>(syscall(SYS_perf_event_open, &wanted, 0, -1, -1, 0));
#endif
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  ~Counter() {
#ifdef __linux__
    if (file_ >= 0) close(file_);
#endif
  }
  [[nodiscard]] std::uint64_t now() const {
    std::uint64_t count = 0;
#ifdef __linux__
    if (file_ >= 0 && read(file_, &count, sizeof count) != sizeof count) count = 0;
#endif
    return count;
  }

 private:
  int file_ = -1;
};

struct Cost {
  double ns = 0, instructions = 0, cycles = 0, peak = 0, held = 0;  // a unit
};

/// `make` returns what is built, so that what it holds can be told.
template <class Make>
Cost measure(std::size_t units, int repeats, bool by_clock, const Make& make) {
  const Counter instructions(Counter::Of::instructions), cycles(Counter::Of::cycles);
  std::vector<double> times, counts, cycle_counts;
  Cost cost;
  const double n = static_cast<double>(units);
  for (int i = 0; i < repeats; ++i) {
    const std::size_t before = held;
    peak = held.load();
    const std::uint64_t start = instructions.now(), first_cycle = cycles.now();
    std::uint64_t end = start, last_cycle = first_cycle;
    const auto work = [&] {
      const auto made = make();
      end = instructions.now();
      last_cycle = cycles.now();
      cost.held = static_cast<double>(held - before) / n;
    };
    times.push_back(1e9 / n * (by_clock ? bench::seconds(work) : bench::processor_seconds(work)));
    counts.push_back(static_cast<double>(end - start) / n);
    cycle_counts.push_back(static_cast<double>(last_cycle - first_cycle) / n);
    cost.peak = static_cast<double>(peak - before) / n;
  }
  cost.ns = bench::median(times);
  cost.instructions = bench::median(counts);
  cost.cycles = bench::median(cycle_counts);
  return cost;
}

nlohmann::ordered_json cells(const Cost& cost) {
  nlohmann::ordered_json row = {
      {"ns", cost.ns}, {"peak_bytes", cost.peak}, {"held_bytes", cost.held}};
  if (cost.instructions > 0) row["instructions"] = cost.instructions;
  if (cost.cycles > 0) row["cycles"] = cost.cycles;
  return row;
}

bool is_solid(const std::filesystem::path& file) {
  return file.extension() == ".node" || file.extension() == ".ele" || file.extension() == ".mesh";
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {400000};
  int repeats = 5, threads = 0;
  double limit = 600;
  bench::Report report;
  CLI::App app("What building costs: a vertex of a surface, a tetrahedron of a solid");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl), solids (.node .ele .mesh)");
  app.add_option("--sizes", sizes, "Vertices of generated surfaces besides")->delimiter(',');
  app.add_option("--repeats", repeats, "Of each")->capture_default_str();
  app.add_option("--threads", threads, "By the clock with so many (default: one, processor time)");
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"input", "input"},
                      {"built", "built"},
                      {"units", "vertices or tets", "%.0f"},
                      {"ns", "ns each", "%.0f"},
                      {"instructions", "instructions each", "%.0f"},
                      {"cycles", "cycles each", "%.0f"},
                      {"peak_bytes", "peak bytes each", "%.0f"},
                      {"held_bytes", "held bytes each", "%.0f"},
                      {"note", "note"}});
  const auto add = [&](const std::string& input, const char* built, std::size_t units,
                       const auto& make) {
    nlohmann::ordered_json row = {{"input", input}, {"built", built}, {"units", units}};
    row.update(
        bench::isolated(limit, [&] { return cells(measure(units, repeats, threads > 0, make)); }));
    table.add(std::move(row));
  };
  const auto add_surface = [&](const bench::Surface& s) {
    bench::built_of_surface(s, std::max(threads, 1), [&](const char* built, const auto& make) {
      add(s.name, built, s.positions.size(), make);
    });
  };
  return report.write(table, [&] {
    for (const std::filesystem::path mesh : meshes) {
      if (!is_solid(mesh)) {
        add_surface(bench::read_surface(mesh));
        continue;
      }
      const auto read = plexway::io::read_tets(mesh);
      bench::built_of_solid(read.positions, read.tets, std::max(threads, 1),
                            [&](const char* built, const auto& make) {
                              add(mesh.stem().string(), built, read.tets.size(), make);
                            });
    }
    for (const std::size_t size : sizes) add_surface(bench::bumpy_surface(size));
  });
}
