// Point clouds, as they are and smoothed, beside Dijkstra on the neighbour graph, on files with
// exact answers and on clouds made here, clean and noisy.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <plexway/complex/normals.hpp>
#include <plexway/complex/smoothing.hpp>
#include <plexway/solve.hpp>

#include "../data/sampled_clouds.hpp"
#include "compare.hpp"

#ifdef PLEXWAY_HAS_FLANN
#include <plexway/flann/neighbours.hpp>
#endif
#ifdef PLEXWAY_HAS_BOOST_GRAPH
#include <plexway/boost_graph/dijkstra.hpp>
#endif

namespace {

using bench::Index;
using Positions = std::vector<std::array<double, 3>>;

struct Cloud {
  std::string name;
  Positions points;
  std::vector<double> truth;  // from point 0
};

Cloud read_cloud(const std::filesystem::path& file) {
  Cloud cloud{file.stem().string(), {}, {}};
  std::ifstream in(file);
  for (std::array<double, 3> p; in >> p[0] >> p[1] >> p[2];) cloud.points.push_back(p);
  std::ifstream answers(file.parent_path() / (cloud.name + ".v0.txt"));
  for (std::string value; answers >> value;) cloud.truth.push_back(std::stod(value));
  if (cloud.truth.size() != cloud.points.size()) cloud.truth.clear();
  return cloud;
}

struct Form {
  std::string name;
  bool smooth;
};

/// Mean relative error, also with its sign, and the largest beyond three spacings.
void add_errors(const Cloud& cloud, std::span<const float> found, double spacing,
                nlohmann::ordered_json& row) {
  if (cloud.truth.empty()) return;
  double mean = 0, bias = 0, largest = 0;
  std::size_t unreached = 0, count = 0;
  for (std::size_t i = 1; i < found.size(); ++i) {
    if (!std::isfinite(found[i])) {
      ++unreached;
      continue;
    }
    const double e = static_cast<double>(found[i]) / cloud.truth[i] - 1;
    mean += std::abs(e);
    bias += e;
    ++count;
    if (cloud.truth[i] > 3 * spacing) largest = std::max(largest, std::abs(e));
  }
  row["mean"] = mean / static_cast<double>(count);
  row["bias"] = bias / static_cast<double>(count);
  row["max"] = largest;
  if (unreached > 0) row["note"] = std::to_string(unreached) + " unreached";
}

#if defined(PLEXWAY_HAS_FLANN) && defined(PLEXWAY_HAS_BOOST_GRAPH)
template <class Complex>
void solve_and_compare(const Complex& complex, const Cloud& cloud,
                       const plexway::Neighbours& neighbours, double spacing,
                       const bench::Effort& effort, nlohmann::ordered_json& row) {
  const double n = static_cast<double>(cloud.points.size());
  plexway::Workspace<float> workspace;
  plexway::DistanceField<float> field;
  const auto solve = [&](Index i) {
    const auto source = plexway::PointSource::at(i);
    plexway::solve(plexway::Serial{}, complex, std::span(&source, 1), bench::one_label(), workspace,
                   field);
  };
  std::vector<std::array<Index, 2>> edges;
  for (Index i = 0; i < cloud.points.size(); ++i)
    for (const Index j : neighbours.around(i))
      if (i < j) edges.push_back({i, j});
  const plexway::Wireframe<float> graph(cloud.points, edges);
  plexway::boost_graph::EdgeDijkstra<float> dijkstra{plexway::boost_graph::EdgeGraph(graph)};
  const auto sources = bench::spread_numbers(effort.sources, cloud.points.size());
  const bench::Times times = bench::take_turns(
      sources, effort, [&](Index i) { dijkstra.run(i); }, solve);
  row["ns_per_point"] = 1e9 * times.second / n;
  row["dijkstra_ns_per_point"] = 1e9 * times.first / n;
  row["ratio"] = times.ratio;
  solve(0);
  row["expansions"] = static_cast<double>(field.statistics.expansions) / n;
  row["updates"] = static_cast<double>(field.statistics.updates) / n;
  row["bytes_per_point"] = static_cast<double>(complex.bytes() + workspace.bytes() +
                                               field.distance.capacity() * sizeof(float)) /
                           n;
  add_errors(cloud, field.distance, spacing, row);
}

nlohmann::ordered_json measure(const Cloud& cloud, const Form& form, std::size_t k,
                               const bench::Effort& effort) {
  const double n = static_cast<double>(cloud.points.size());
  nlohmann::ordered_json row;
  plexway::Neighbours neighbours;
  plexway::flann::NeighbourOptions search;
  search.k = k;
  search.threads = 1;
  row["search_us"] = 1e6 / n * bench::seconds([&] {
                       neighbours = plexway::flann::neighbours(cloud.points, search);
                     });
  row["noise"] = plexway::noise_level(cloud.points, neighbours, 1);
  Positions points = cloud.points;
  std::unique_ptr<plexway::PointCloud<float>> umbrellas;
  row["build_us"] =
      1e6 / n * bench::seconds([&] {
        if (form.smooth) {
          plexway::SmoothOptions smoothing;
          smoothing.threads = 1;
          points = plexway::smooth(cloud.points, neighbours, smoothing);
        }
        plexway::CloudOptions one_thread;
        one_thread.threads = 1;
        umbrellas = std::make_unique<plexway::PointCloud<float>>(points, neighbours, one_thread);
      });
  solve_and_compare(*umbrellas, cloud, neighbours, umbrellas->summary().mean_spacing, effort, row);
  return row;
}

nlohmann::ordered_json measure_graph(const Cloud& cloud, std::size_t k) {
  nlohmann::ordered_json row;
  const auto neighbours = plexway::flann::neighbours(cloud.points, {.k = k});
  std::vector<std::array<Index, 2>> edges;
  double length = 0;
  for (Index i = 0; i < cloud.points.size(); ++i)
    for (const Index j : neighbours.around(i))
      if (i < j) edges.push_back({i, j});
  const plexway::Wireframe<float> graph(cloud.points, edges);
  length = graph.summary().mean_edge;
  const auto field = plexway::solve(plexway::Serial{}, graph, plexway::PointSource::at(0));
  add_errors(cloud, field.distance, length / 1.5, row);
  return row;
}
#endif

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> files;
  std::vector<std::size_t> sizes = {20000};
  std::vector<double> noises = {0, .25, .5, 1};
  std::vector<std::string> made;
  std::size_t k = 16;
  bench::Effort effort{8, 2, 20};
  double limit = 600;
  bench::Report report;
  CLI::App app("Point clouds, as they are and smoothed: one table");
  app.add_option("CLOUD", files, "Clouds (.xyz), with NAME.v0.txt beside them");
  app.add_option("--make", made, "Also plane, sphere, cylinder or swiss, sampled at random");
  app.add_option("--size", sizes, "With so many points")->capture_default_str();
  app.add_option("--noise", noises, "And with noise, in spacings")->capture_default_str();
  app.add_option("-k", k, "Neighbours")->capture_default_str();
  bench::add_effort_options(app, effort);
  app.add_option("--limit", limit, "Seconds after which a row is given up")->capture_default_str();
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  std::vector<Cloud> clouds;
  for (const std::string& file : files) clouds.push_back(read_cloud(file));
  const std::map<std::string, samples::SampledCloud (*)(std::size_t, double, std::uint64_t)>
      makers = {{"plane", samples::sampled_plane},
                {"sphere", samples::sampled_sphere},
                {"cylinder", samples::sampled_cylinder},
                {"swiss", samples::sampled_swiss}};
  for (const std::string& kind : made)
    for (const std::size_t size : sizes)
      for (const double noise : noises) {
        const auto maker = makers.find(kind);
        if (maker == makers.end()) continue;
        samples::SampledCloud cloud = maker->second(size, noise, 1);
        char text[64];
        std::snprintf(text, sizeof text, "%s %zu, noise %.2f", kind.c_str(), size, noise);
        std::vector<double> truth = cloud.distances_from(0);
        clouds.push_back({text, std::move(cloud.points), std::move(truth)});
      }

  bench::Table table({{"cloud", "cloud"},
                      {"form", "form"},
                      {"noise", "noise", "%.3f"},
                      {"search_us", "search us/P", "%.1f"},
                      {"build_us", "build us/P", "%.1f"},
                      {"ns_per_point", "solve ns/P", "%.0f"},
                      {"dijkstra_ns_per_point", "Dijkstra ns/P", "%.0f"},
                      {"ratio", "ratio", "%.2f"},
                      {"mean", "error mean", "%.1e"},
                      {"bias", "bias", "%+.1e"},
                      {"max", "max", "%.3f"},
                      {"expansions", "expansions/P", "%.2f"},
                      {"updates", "updates/P", "%.2f"},
                      {"bytes_per_point", "bytes/P", "%.0f"},
                      {"note", "note"}});
#if defined(PLEXWAY_HAS_FLANN) && defined(PLEXWAY_HAS_BOOST_GRAPH)
  const std::vector<Form> forms = {{"as they are", false}, {"smoothed", true}};
  return report.write(table, [&] {
    for (const Cloud& cloud : clouds) {
      std::cerr << cloud.name << std::endl;
      for (const Form& form : forms) {
        nlohmann::ordered_json row = {{"cloud", cloud.name}, {"form", form.name}};
        row.update(bench::isolated(limit, [&] { return measure(cloud, form, k, effort); }));
        table.add(std::move(row));
      }
      nlohmann::ordered_json row = {{"cloud", cloud.name}, {"form", "Dijkstra on the graph"}};
      row.update(bench::isolated(limit, [&] { return measure_graph(cloud, k); }));
      table.add(std::move(row));
    }
  });
#else
  std::cerr << "needs the providers flann and boost_graph\n";
  return 4;
#endif
}
