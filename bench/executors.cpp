// OpenMP against Serial: one field from many sources on a large surface, a batch of fields, what
// the size of a chunk does, and from what size and number of sources a team is faster. A row says
// what is asked of it, where something is, and what was measured.

#include <algorithm>
#include <thread>

#include "solver.hpp"

namespace bench::executors {

using plexway::OpenMP, plexway::PointSource, plexway::Serial;

struct Settings {
  std::size_t vertices = 1'000'000, batch_vertices = 50'000;
  std::vector<std::size_t> sources = {1, 1000};
  std::size_t batch = 64, repeats = 5;
  std::vector<int> threads;
  std::vector<std::size_t> chunks = {16, 32, 64, 128, 256, 512, 1024, 4096};
  std::vector<std::size_t> sizes = {25'000, 100'000, 400'000}, counts = {1, 8, 64, 512};
};

/// What is asked of a team of so many threads, in times Serial; 0: nothing.
double asked_of_field(int threads, std::size_t sources) {
  if (threads == 1) return 1 / 1.5;
  return threads == 2 && sources >= 1000 ? 1.6 : 0;
}
double asked_of_batch(int threads) { return threads == 2 ? 1.9 : 0; }

void add_row(Table& table, Row row, double asked) {
  if (asked > 0) {
    row["asked"] = asked;
    row["met"] = row["speed"].number() >= asked ? "yes" : "no";
  }
  table.add(std::move(row));
}

std::vector<PointSource> sources_on(const Surface& surface, std::size_t count) {
  std::vector<PointSource> sources;
  for (const Index v : rotating_sources(surface, count)) sources.push_back(PointSource::at(v));
  return sources;
}

/// Seconds of each of `works`, the least of `repeats`; they take turns, so that all see the same
/// machine.
std::vector<double> least_of(std::size_t repeats, const std::vector<std::function<void()>>& works) {
  std::vector<double> least(works.size(), 1e300);
  for (std::size_t r = 0; r < repeats; ++r)
    for (std::size_t i = 0; i < works.size(); ++i) least[i] = std::min(least[i], seconds(works[i]));
  return least;
}

std::string named(const std::string& what, int threads) {
  return what + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

template <class Real>
void measure_field(const Surface& surface, const Settings& settings, std::size_t count,
                   const std::vector<std::pair<std::string, OpenMP>>& teams, Table& table) {
  const plexway::TriangleMesh<Real> mesh(surface.positions, surface.faces);
  const auto sources = sources_on(surface, count);
  plexway::Workspace<Real> workspace;
  plexway::DistanceField<Real> field;
  std::vector<std::size_t> expansions(teams.size() + 1);
  std::vector<std::function<void()>> works;
  const auto add = [&](const auto& executor) {
    works.push_back([&, executor, i = works.size()] {
      plexway::solve(executor, mesh, sources, one_label(), workspace, field);
      expansions[i] = field.statistics.expansions;
    });
  };
  add(Serial{});
  for (const auto& team : teams) add(team.second);
  const auto seconds = least_of(settings.repeats, works);
  for (std::size_t i = 0; i < works.size(); ++i)
    add_row(table,
            {{"what", "field, " + std::to_string(count) + (count == 1 ? " source" : " sources")},
             {"vertices", surface.positions.size()},
             {"executor", i == 0 ? "Serial" : teams[i - 1].first},
             {"ms", 1e3 * seconds[i]},
             {"speed", seconds[0] / seconds[i]},
             {"expansions",
              static_cast<double>(expansions[i]) / static_cast<double>(surface.faces.size())}},
            i == 0 ? 0 : asked_of_field(teams[i - 1].second.threads, count));
}

/// As much as this machine's cores can do: threads that share nothing, each with a mesh, a
/// workspace and a field of its own that are there before the clock starts, and the same number of
/// sources.
template <class Real>
class Strangers {
 public:
  Strangers(const Surface& surface, int threads) : own_(static_cast<std::size_t>(threads)) {
    for (auto& mine : own_) mine = std::make_unique<Own>(surface);
  }
  void solve(std::span<const PointSource> sources) {
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < own_.size(); ++i)
      threads.emplace_back([&, i] {
        for (std::size_t k = i; k < sources.size(); k += own_.size())
          plexway::solve(Serial{}, own_[i]->mesh, sources.subspan(k, 1), one_label(),
                         own_[i]->workspace, own_[i]->field);
      });
    for (std::thread& thread : threads) thread.join();
  }

 private:
  struct Own {
    explicit Own(const Surface& surface) : mesh(surface.positions, surface.faces) {}
    plexway::TriangleMesh<Real> mesh;
    plexway::Workspace<Real> workspace;
    plexway::DistanceField<Real> field;
  };
  std::vector<std::unique_ptr<Own>> own_;
};

template <class Real>
void measure_batch(const Surface& surface, const Settings& settings, Table& table) {
  const plexway::TriangleMesh<Real> mesh(surface.positions, surface.faces);
  const auto list = sources_on(surface, settings.batch);
  const std::span<const PointSource> sources(list);
  std::vector<std::function<void()>> works = {
      [&] { (void)solve_each(Serial{}, mesh, sources, one_label()); }};
  for (const int threads : settings.threads)
    works.push_back(
        [&, threads] { (void)solve_each(OpenMP{.threads = threads}, mesh, sources, one_label()); });
  Strangers<Real> one(surface, 1), all(surface, settings.threads.back());
  works.push_back([&] { one.solve(sources); });
  works.push_back([&] { all.solve(sources); });
  const auto seconds = least_of(settings.repeats, works);
  const std::size_t teams = settings.threads.size();
  const auto row = [&](const std::string& executor, double time, double reference, double asked) {
    add_row(table,
            {{"what", "batch of " + std::to_string(settings.batch)},
             {"vertices", surface.positions.size()},
             {"executor", executor},
             {"ms", 1e3 * time},
             {"speed", reference / time}},
            asked);
  };
  row("Serial", seconds[0], seconds[0], 0);
  for (std::size_t i = 0; i < teams; ++i)
    row(named("OpenMP", settings.threads[i]), seconds[i + 1], seconds[0],
        asked_of_batch(settings.threads[i]));
  // Of one such thread: what is lost here is the machine's.
  row(named("nothing shared", settings.threads.back()), seconds[teams + 2], seconds[teams + 1], 0);
}

/// From what size and number of sources is a team faster? What `auto` in the tool goes by.
template <class Real>
void measure_sizes(const Settings& settings, Table& table) {
  const int threads = settings.threads.back();
  for (const std::size_t size : settings.sizes) {
    const Surface surface = bumpy_surface(size);
    for (const std::size_t count : settings.counts)
      measure_field<Real>(surface, settings, count,
                          {{named("OpenMP", threads), OpenMP{.threads = threads}}}, table);
  }
}

template <class Real>
void measure_all(const Settings& settings, Table& table) {
  const Surface large = bumpy_surface(settings.vertices);
  std::vector<std::pair<std::string, OpenMP>> teams;
  for (const int threads : settings.threads)
    teams.push_back({named("OpenMP", threads), OpenMP{.threads = threads}});
  for (const std::size_t count : settings.sources)
    measure_field<Real>(large, settings, count, teams, table);
  measure_batch<Real>(bumpy_surface(settings.batch_vertices), settings, table);
  measure_sizes<Real>(settings, table);
  if (settings.chunks.empty()) return;
  teams.clear();
  for (const std::size_t chunk : settings.chunks)
    teams.push_back({named("OpenMP", settings.threads.back()) + ", chunk " + std::to_string(chunk),
                     OpenMP{.threads = settings.threads.back(), .chunk = chunk}});
  for (const std::size_t count : settings.sources)
    measure_field<Real>(large, settings, count, teams, table);
}

void run(Arguments& arguments) {
  Settings settings;
  bool twice = false;
  arguments.option("--vertices", &settings.vertices, "Of the surface that one field is solved on");
  arguments.option("--batch-vertices", &settings.batch_vertices, "Of the surface of the batch");
  arguments.option("--sources", &settings.sources, "Of one field");
  arguments.option("--batch", &settings.batch, "Fields in the batch");
  arguments.option("--repeats", &settings.repeats, "Turns; the least time counts");
  arguments.option("--threads", &settings.threads, "Teams (default: 1 and one a core)");
  arguments.option("--chunks", &settings.chunks,
                   "Chunks for the last team; `none` leaves that out");
  arguments.option("--sizes", &settings.sizes, "Vertices of surfaces that teams are tried on");
  arguments.option("--counts", &settings.counts, "Sources on each of them");
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "what; vertices; executor; ms %.1f; speed: times Serial %.2f; asked %.2f; met;"
      "expansions: expansions a face %.3f");
  if (settings.threads.empty())
    settings.threads = {1, static_cast<int>(std::max(std::thread::hardware_concurrency(), 1u))};
  twice ? measure_all<double>(settings, table) : measure_all<float>(settings, table);
}
const Command command("executors", "several threads beside one: fields, batches, chunks, sizes",
                      run);

}  // namespace bench::executors
