// Point clouds: errors against exact answers, times against Boost's Dijkstra on the graph of the 16
// nearest neighbours, memory. Clouds with exact answers from a folder, and generated ones.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <plexway/boost_graph/dijkstra.hpp>
#include <plexway/boost_graph/edge_graph.hpp>
#include <plexway/flann/neighbours.hpp>
#include <plexway/solve.hpp>

#include "../data/cloud_shapes.hpp"
#include "compare.hpp"

namespace {

using bench::Index;

struct Measured {
  std::string name;
  std::vector<std::array<double, 3>> points;
  std::vector<bench::Truth> truths;
};

struct Options {
  bench::Effort effort{8, 2, 20};
  std::size_t k = 16;
  int threads = 1;
  plexway::CloudOptions cloud;
};

Measured read_cloud(const std::filesystem::path& file) {
  Measured cloud{file.stem().string(), {}, {}};
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream numbers(line);
    std::array<double, 3> p{};
    if (numbers >> p[0] >> p[1] >> p[2]) cloud.points.push_back(p);
  }
  bench::Surface as_surface{cloud.name, cloud.points, {}};
  cloud.truths = bench::read_truths(file.parent_path(), as_surface);
  return cloud;
}

Measured generate(const std::string& kind, std::size_t n) {
  samples::Cloud made;
  if (kind == "plane") made = samples::plane_cloud(n);
  if (kind == "sphere") made = samples::sphere_cloud(n);
  if (kind == "sphn") made = samples::sphere_cloud(n, 1, 0.08 * std::sqrt(12.566 / double(n)));
  if (kind == "swiss") made = samples::swiss_cloud(n);
  if (kind == "cylinder") made = samples::cylinder_cloud(n);
  if (kind == "wall") made = samples::wall_cloud(n);
  if (made.points.empty())
    throw CLI::ValidationError(kind, "plane, sphere, sphn, swiss, cylinder or wall");
  bench::Truth truth{0, std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) truth.distance[i] = made.distance(0, i);
  return {kind + "_" + std::to_string(n), std::move(made.points), {std::move(truth)}};
}

plexway::boost_graph::EdgeGraph graph_of(const Measured& cloud,
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

// The largest error farther than three spacings from the source.
double worst_beyond(const bench::Truth& truth, std::span<const double> found, double nearest) {
  double worst = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    if (truth.distance[i] > nearest && std::isfinite(found[i]))
      worst = std::max(worst, std::abs(found[i] / truth.distance[i] - 1));
  return worst;
}

template <class Real>
nlohmann::ordered_json measure(const Measured& cloud, const Options& options) {
  const double n = static_cast<double>(cloud.points.size());
  nlohmann::ordered_json row;
  const double before = bench::status_bytes("VmRSS").value_or(0);
  plexway::Neighbours neighbours;
  std::unique_ptr<plexway::PointCloud<Real>> domain;
  double search = 0, build = 0;
  for (int i = 0; i < (n < 200000 ? 3 : 1); ++i) {  // the best of three
    const double s = bench::seconds([&] {
      neighbours = plexway::flann::surface_neighbours(cloud.points,
                                                      {.k = options.k, .threads = options.threads});
    });
    const double b = bench::seconds([&] {
      domain = std::make_unique<plexway::PointCloud<Real>>(cloud.points, neighbours, options.cloud);
    });
    search = i == 0 ? s : std::min(search, s);
    build = i == 0 ? b : std::min(build, b);
  }
  if (const auto peak = bench::status_bytes("VmHWM")) row["peak_bytes"] = (*peak - before) / n;
  row["search_us"] = 1e6 * search / n;
  row["build_us"] = 1e6 * build / n;
  row["setup_us"] = 1e6 * (search + build) / n;

  plexway::Workspace<Real> workspace;
  plexway::DistanceField<Real> field;
  const auto solve = [&](Index v) {
    const auto source = plexway::PointSource::at(v);
    plexway::solve(plexway::Serial{}, *domain, std::span(&source, 1), bench::one_label(), workspace,
                   field);
  };
  plexway::boost_graph::EdgeDijkstra<Real> dijkstra(graph_of(cloud, neighbours));
  const auto sources = bench::spread_numbers(options.effort.sources, cloud.points.size());
  const auto times = bench::take_turns(
      sources, options.effort, [&](Index v) { dijkstra.run(v); }, solve);
  row["ns"] = 1e9 * times.second / n;
  row["dijkstra_ns"] = 1e9 * times.first / n;
  row["ratio"] = times.ratio;
  row["bytes"] = static_cast<double>(domain->bytes() + workspace.bytes() +
                                     field.distance.capacity() * sizeof(Real)) /
                 n;
  row["triangles"] = static_cast<double>(domain->summary().triangles) / n;

  bench::Errors errors, edges;
  double beyond = 0;
  for (const bench::Truth& truth : cloud.truths) {
    solve(truth.source);
    const std::vector<double> found(field.distance.begin(), field.distance.end());
    errors.add(truth, found);
    beyond = std::max(beyond, worst_beyond(truth, found, 3 * domain->summary().mean_spacing));
    dijkstra.run(truth.source);
    edges.add(truth, std::vector<double>(dijkstra.distance().begin(), dijkstra.distance().end()));
  }
  if (const auto e = errors.summary()) {
    row["mean"] = e->mean;
    row["p99"] = e->p99;
    row["max"] = e->max;
    row["beyond"] = beyond;
    row["below"] = e->most_below;
    row["wrong"] = e->wrong;
  }
  if (const auto e = edges.summary()) row["dijkstra_mean"] = e->mean;
  return row;
}

bench::Table cloud_table() {
  return bench::Table({{"cloud", "cloud"},
                       {"mean", "mean error", "%.1e"},
                       {"p99", "p99", "%.1e"},
                       {"max", "max", "%.1e"},
                       {"beyond", "max beyond 3 spacings", "%.1e"},
                       {"below", "most below", "%.1e"},
                       {"wrong", "wrong"},
                       {"dijkstra_mean", "Dijkstra mean", "%.1e"},
                       {"search_us", "neighbours us", "%.2f"},
                       {"build_us", "cloud us", "%.2f"},
                       {"setup_us", "set-up us", "%.2f"},
                       {"ns", "solve ns", "%.0f"},
                       {"dijkstra_ns", "Dijkstra ns", "%.0f"},
                       {"ratio", "ratio", "%.2f"},
                       {"bytes", "bytes", "%.0f"},
                       {"peak_bytes", "peak bytes", "%.0f"},
                       {"triangles", "triangles", "%.3f"}});
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  std::string folder;
  std::vector<std::string> kinds = {"plane", "sphere", "swiss", "wall", "sphn"};
  std::vector<std::size_t> sizes;
  double limit = 600;
  bool double_precision = false;
  bench::Report report;
  CLI::App app("Point clouds against exact answers and Boost's Dijkstra; figures are per point");
  bench::add_effort_options(app, options.effort);
  app.add_option("--clouds", folder, "Folder of NAME.xyz with exact answers NAME.vID.txt");
  app.add_option("--generated", sizes, "Also generated clouds of so many points");
  app.add_option("--kinds", kinds, "plane sphere sphn swiss cylinder wall")->capture_default_str();
  app.add_option("-k", options.k, "Neighbours")->capture_default_str();
  app.add_option("--threads", options.threads, "For the set-up")->capture_default_str();
  app.add_option("--lengths", options.cloud.lengths, "automatic, space or tangential")
      ->transform(CLI::CheckedTransformer(std::map<std::string, plexway::EdgeLengths>{
          {"automatic", plexway::EdgeLengths::automatic},
          {"space", plexway::EdgeLengths::in_space},
          {"tangential", plexway::EdgeLengths::tangential}}));
  app.add_option("--boundary-circle", options.cloud.widest_boundary_circle)->capture_default_str();
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  app.add_flag("--double", double_precision, "Double instead of float");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  options.cloud.threads = options.threads;

  bench::Table table = cloud_table();
  return report.write(table, [&] {
    std::vector<std::function<Measured()>> all;
    if (!folder.empty()) {
      std::vector<std::filesystem::path> files;
      for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".xyz") files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      for (const auto& file : files) all.push_back([file] { return read_cloud(file); });
    }
    for (const std::string& kind : kinds)
      for (const std::size_t size : sizes)
        all.push_back([kind, size] { return generate(kind, size); });
    for (const auto& make : all) {
      const Measured cloud = make();
      std::cerr << cloud.name << std::endl;
      nlohmann::ordered_json row = {{"cloud", cloud.name}};
      row.update(bench::isolated(limit, [&] {
        return double_precision ? measure<double>(cloud, options) : measure<float>(cloud, options);
      }));
      table.add(std::move(row));
    }
  });
}
