// Point clouds: errors against exact answers, times against Boost's Dijkstra on the graph of the 16
// nearest neighbours, memory. Clouds with exact answers from a folder, and generated ones, as they
// are or noisy, and smoothed.

#if defined(PLEXWAY_HAS_FLANN) && defined(PLEXWAY_HAS_BOOST_GRAPH)

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/flann/neighbours.hpp>
#include <plexway/surface/normals.hpp>
#include <plexway/surface/smoothing.hpp>

#include "data/cloud_shapes.hpp"
#include "solver.hpp"

namespace bench::clouds {

using Points = std::vector<std::array<double, 3>>;

struct Cloud {
  std::string name;
  Points points;
  std::vector<Truth> truths;
};

struct Settings {
  Effort effort{8, 2, 20};
  std::size_t k = 16;
  plexway::CloudOptions cloud;
  bool smooth = false;
};

Cloud read_cloud(const std::filesystem::path& file) {
  Cloud cloud{file.stem().string(), {}, {}};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    std::array<double, 3> p{};
    if (numbers >> p[0] >> p[1] >> p[2]) cloud.points.push_back(p);
  }
  cloud.truths = read_truths(file.parent_path(), cloud.name, cloud.points.size());
  return cloud;
}

Cloud generate(const std::string& kind, std::size_t n) {
  const std::uint64_t seed = 1;
  samples::Cloud made;
  if (kind == "plane") made = samples::plane_cloud(n, seed);
  if (kind == "sphere") made = samples::sphere_cloud(n, seed, 0);
  if (kind == "sphn") made = samples::sphere_cloud(n, seed, .08 * std::sqrt(12.566 / double(n)));
  if (kind == "swiss") made = samples::swiss_cloud(n, seed);
  if (kind == "cylinder") made = samples::cylinder_cloud(n, seed);
  if (kind == "wall") made = samples::wall_cloud(n, seed);
  Truth truth{0, std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) truth.distance[i] = made.distance(0, i);
  return {kind + "_" + std::to_string(n), std::move(made.points), {std::move(truth)}};
}

plexway::boost_graph::EdgeGraph graph_of(const Cloud& cloud,
                                         const plexway::Neighbours& neighbours) {
  std::vector<std::array<Index, 2>> edges;
  std::vector<double> lengths;
  for (Index i = 0; i < cloud.points.size(); ++i)
    for (const Index j : neighbours.around(i)) {
      if (j < i) continue;  // the lists are symmetric
      edges.push_back({i, j});
      lengths.push_back(samples::between(cloud.points[i], cloud.points[j]));
    }
  return {cloud.points.size(), edges, lengths};
}

/// Adds the mean error with its sign and the largest farther than three spacings from the source.
template <class Real>
void add_more(const Truth& truth, const std::vector<Real>& found, double spacing, Row& row) {
  double worst = 0, sum = 0, count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double off = static_cast<double>(found[i]) / truth.distance[i] - 1;
    if (!(truth.distance[i] > 0) || !std::isfinite(off)) continue;
    sum += off, ++count;
    if (truth.distance[i] > 3 * spacing) worst = std::max(worst, std::abs(off));
  }
  const Value* before = row.find("beyond");
  row["beyond"] = before != nullptr ? std::max(before->number(), worst) : worst;
  row["bias"] = sum / count;
}

template <class Real>
Row measure(const Cloud& cloud, const Settings& settings) {
  const double n = static_cast<double>(cloud.points.size());
  Row row;
  const double before = status_bytes("VmRSS").value_or(0);
  const plexway::flann::NeighbourOptions search{.k = settings.k, .threads = settings.cloud.threads};
  plexway::Neighbours neighbours;
  std::unique_ptr<plexway::PointCloud<Real>> domain;
  double searched = 1e300, built = 1e300;
  for (int i = 0; i < (n < 200000 ? 3 : 1); ++i) {  // the best of three
    searched = std::min(searched, seconds([&] {
                          neighbours = plexway::flann::surface_neighbours(cloud.points, search);
                        }));
    built = std::min(built, seconds([&] {
                       Points smoothed;
                       if (settings.smooth)
                         smoothed = plexway::smooth(cloud.points, neighbours,
                                                    {.threads = settings.cloud.threads});
                       domain = std::make_unique<plexway::PointCloud<Real>>(
                           settings.smooth ? smoothed : cloud.points, neighbours, settings.cloud);
                     }));
  }
  if (const auto peak = status_bytes("VmHWM")) row["peak_bytes"] = (*peak - before) / n;
  row["search_us"] = 1e6 * searched / n;
  row["build_us"] = 1e6 * built / n;
  row["setup_us"] = 1e6 * (searched + built) / n;
  row["noise"] = plexway::noise_level(cloud.points, neighbours, 1);

  Solver solver(*domain, one_label());
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra(graph_of(cloud, neighbours));
  const Times times = take_turns(
      spread_numbers(settings.effort.sources, cloud.points.size()), settings.effort,
      [&](Index v) { dijkstra.run(v); }, [&](Index v) { solver(v); });
  row["ns"] = 1e9 * times.second / n;
  row["dijkstra_ns"] = 1e9 * times.first / n;
  row["ratio"] = times.ratio;
  row["bytes"] = static_cast<double>(domain->bytes() + solver.workspace().bytes() +
                                     solver.distance().capacity() * sizeof(Real)) /
                 n;
  row["triangles"] = static_cast<double>(domain->summary().triangles) / n;

  Errors errors, edges;
  for (const Truth& truth : cloud.truths) {
    solver(truth.source);
    errors.add(truth, solver.distance());
    add_more(truth, solver.distance(), domain->summary().mean_spacing, row);
    dijkstra.run(truth.source);
    edges.add(truth, dijkstra.distance());
  }
  add_errors(row, errors);
  if (const auto e = edges.summary()) row["dijkstra_mean"] = e->mean;
  return row;
}

void run(Arguments& arguments) {
  Settings settings;
  std::string folder;
  std::vector<std::string> kinds = {"plane", "sphere", "swiss", "wall", "sphn"};
  std::vector<std::size_t> sizes;
  bool twice = false;
  settings.cloud.threads = 1;
  settings.effort.add_options(arguments);
  arguments.option("--clouds", &folder, "Folder of NAME.xyz with exact answers NAME.vID.txt");
  arguments.option("--generated", &sizes, "Also generated clouds of so many points");
  arguments.option("--kinds", &kinds, "Of these, spread evenly",
                   {"plane", "sphere", "sphn", "swiss", "cylinder", "wall"});
  arguments.option("--smooth", &settings.smooth, "Smoothed first");
  arguments.option("-k", &settings.k, "Neighbours");
  arguments.option("--threads", &settings.cloud.threads, "For the set-up");
  arguments.add_limit();
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "cloud; noise %.3f; mean: mean error %.1e; bias: with its sign %+.1e; p99 %.1e; max %.1e;"
      "beyond: max beyond 3 spacings %.1e; below: most below %.1e; wrong;"
      "dijkstra_mean: Dijkstra mean %.1e; search_us: neighbours us %.2f; build_us: cloud us %.2f;"
      "setup_us: set-up us %.2f; ns: solve ns %.0f; dijkstra_ns: Dijkstra ns %.0f; ratio %.2f;"
      "bytes %.0f; peak_bytes: peak bytes %.0f; triangles %.3f; note");
  const auto on = [&](const Cloud& cloud) {
    table.measure({{"cloud", cloud.name}}, arguments.limit, [&] {
      return twice ? measure<double>(cloud, settings) : measure<float>(cloud, settings);
    });
  };
  std::vector<std::filesystem::path> files;
  if (!folder.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".xyz") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) on(read_cloud(file));
  for (const std::string& kind : kinds)
    for (const std::size_t size : sizes) on(generate(kind, size));
}
const Command command("clouds", "point clouds against exact answers and Boost's Dijkstra", run);

}  // namespace bench::clouds

#endif
