// What building costs before the first solve: surfaces, the same by way of Delaunay triangles, and
// solids. Times are medians of the processor, one thread, or with --threads of the clock;
// instructions and cycles are those of the processor's own counters for the thread that calls,
// which other programs disturb not at all and little (Linux; blank where they are not to be had);
// memory is what is allocated beyond the input, at the peak and held.

#include <atomic>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <linux/perf_event.h>
#include <malloc.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

#include <plexway/io/tets.hpp>
#include <plexway/solid/tet_mesh.hpp>
#include <plexway/surface/intrinsic_delaunay.hpp>
#include <plexway/surface/triangle_mesh.hpp>

#include "measure.hpp"

namespace {

std::atomic<bool> counting = false;  // only while this command measures
std::atomic<std::size_t> held = 0, peak = 0;

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (counting) {
    const std::size_t now = held += malloc_usable_size(p);
    for (std::size_t known = peak; known < now && !peak.compare_exchange_weak(known, now);) {
    }
  }
#endif
  return p;
}
void release(void* p) {
#ifdef __linux__
  if (counting && p != nullptr) held -= malloc_usable_size(p);
#endif
  std::free(p);
}

}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size > 0 ? size : 1)); }
void* operator new(std::size_t size, std::align_val_t align) {
  const auto a = static_cast<std::size_t>(align);
  return counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
void operator delete(void* p) noexcept { release(p); }
void operator delete(void* p, std::size_t) noexcept { release(p); }
void operator delete(void* p, std::align_val_t) noexcept { release(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }

namespace bench::build {

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

/// `make` returns what is built, so that what it holds can be told. Figures are of a unit.
template <class Make>
Row measure(std::size_t units, int repeats, bool by_clock, const Make& make) {
  const Counter instructions(Counter::Of::instructions), cycles(Counter::Of::cycles);
  std::vector<double> times, counts, cycle_counts;
  const double n = static_cast<double>(units);
  double held_each = 0, peak_each = 0;
  counting = true;
  for (int i = 0; i < repeats; ++i) {
    const std::size_t before = held;
    peak = held.load();
    const std::uint64_t start = instructions.now(), first_cycle = cycles.now();
    std::uint64_t end = start, last_cycle = first_cycle;
    const auto work = [&] {
      const auto made = make();
      end = instructions.now();
      last_cycle = cycles.now();
      held_each = static_cast<double>(held - before) / n;
    };
    times.push_back(1e9 / n * (by_clock ? seconds(work) : processor_seconds(work)));
    counts.push_back(static_cast<double>(end - start) / n);
    cycle_counts.push_back(static_cast<double>(last_cycle - first_cycle) / n);
    peak_each = static_cast<double>(peak - before) / n;
  }
  counting = false;
  Row row = {{"ns", median(times)}, {"peak_bytes", peak_each}, {"held_bytes", held_each}};
  if (median(counts) > 0) row["instructions"] = median(counts);
  if (median(cycle_counts) > 0) row["cycles"] = median(cycle_counts);
  return row;
}

/// What can be built of a surface, by add(name, make).
template <class Add>
void of_surface(const Surface& s, int threads, const Add& add) {
  using plexway::TriangleMesh;
  plexway::SurfaceHints hints;
  hints.threads = threads;
  add("surface, float", [&] { return TriangleMesh<float>(s.positions, s.faces, hints); });
  add("surface, double", [&] { return TriangleMesh<double>(s.positions, s.faces, hints); });
  add("surface or what pays, float",
      [&] { return plexway::triangulate<float>(s.positions, s.faces, {}, threads); });
  add("by Delaunay, float", [&] {
    return plexway::triangulate<float>(s.positions, s.faces, plexway::Retriangulation::flips,
                                       threads);
  });
}

void run(Arguments& arguments) {
  std::vector<std::string> meshes;
  std::vector<std::size_t> sizes = {400000};
  int repeats = 5, threads = 0;
  arguments.option("MESH", &meshes, "Surfaces (.obj .off .ply .stl), solids (.node .ele .mesh)");
  arguments.option("--sizes", &sizes, "Vertices of generated surfaces besides");
  arguments.option("--repeats", &repeats, "Of each");
  arguments.option("--threads", &threads, "By the clock with so many (0: one, processor time)");
  arguments.add_limit();
  Table& table = arguments.table(
      "input; built; units: vertices or tets %.0f; ns: ns each %.0f;"
      "instructions: instructions each %.0f; cycles: cycles each %.0f;"
      "peak_bytes: peak bytes each %.0f; held_bytes: held bytes each %.0f; note");
  const auto add = [&](const std::string& input, const char* built, std::size_t units,
                       const auto& make) {
    table.measure({{"input", input}, {"built", built}, {"units", units}}, arguments.limit,
                  [&] { return measure(units, repeats, threads > 0, make); });
  };
  const int team = std::max(threads, 1);
  const auto add_surface = [&](const Surface& s) {
    of_surface(s, team, [&](const char* built, const auto& make) {
      add(s.name, built, s.positions.size(), make);
    });
  };
  for (const std::filesystem::path mesh : meshes) {
    const std::string kind = mesh.extension().string();
    if (kind != ".node" && kind != ".ele" && kind != ".mesh") {
      add_surface(read_surface(mesh));
      continue;
    }
    const auto read = plexway::io::read_tets(mesh);
    add(mesh.stem().string(), "solid, float", read.tets.size(),
        [&] { return plexway::TetMesh<float>(read.positions, read.tets, team); });
  }
  for (const std::size_t size : sizes) add_surface(bumpy_surface(size));
}
const Command command("build", "what building surfaces and solids costs: time, memory", run);

}  // namespace bench::build
