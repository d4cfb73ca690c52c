// Flat domains with corners on finer and finer grids, against the exact distances of a visibility
// graph: does what a rule forgets of a corner fall with refinement? Here it is all there is, as
// there is no curvature.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <vector>

#include "../data/corner_domains.hpp"
#include "harness.hpp"
#include "peer.hpp"
#include "table.hpp"

namespace {

template <class Real>
nlohmann::ordered_json measure(const samples::CornerDomain& domain, bench::Index n,
                               std::uint64_t seeds, const plexway::PropagateOptions& options) {
  bench::Errors errors;
  std::vector<double> ns;
  double expansions = 0, faces = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const samples::Shape grid = domain.grid(n, 0.25, seed);
    const bench::Surface surface = {domain.name, grid.points, grid.faces};
    bench::PlexwayPeer<Real> peer(surface, options);
    peer.solve(0);
    for (int repeat = 0; repeat < 3; ++repeat)
      ns.push_back(1e9 * bench::seconds([&] { peer.solve(0); }) /
                   static_cast<double>(grid.points.size()));
    errors.add({0, domain.distances(grid.points)}, peer.distance());
    expansions += static_cast<double>(peer.statistics().expansions);
    faces += static_cast<double>(grid.faces.size());
  }
  const auto found = errors.summary();
  return {{"domain", domain.name},
          {"cells", n},
          {"mean", found->mean},
          {"p99", found->p99},
          {"max", found->max},
          {"below", found->most_below},
          {"wrong", found->wrong},
          {"ns", bench::median(ns)},
          {"expansions", expansions / faces}};
}

}  // namespace

int main(int argc, char** argv) {
  bench::Index most = 400;
  std::uint64_t seeds = 3;
  bool double_precision = false;
  bool scalar = false;
  bench::Report report;
  CLI::App app("Flat domains with corners, on grids of 50 cells a side and more");
  app.add_option("--most", most, "Cells a side at most")->capture_default_str();
  app.add_option("--seeds", seeds, "Grids of each size")->capture_default_str();
  app.add_flag("--double", double_precision, "Double instead of float");
  app.add_flag("--scalar", scalar, "The full rule for every hinge");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"domain", "domain"},
                      {"cells", "cells a side"},
                      {"mean", "error mean", "%.1e"},
                      {"p99", "p99", "%.1e"},
                      {"max", "max", "%.1e"},
                      {"below", "most below", "%.1e"},
                      {"wrong", "wrong"},
                      {"ns", "ns/V", "%.0f"},
                      {"expansions", "expansions/face", "%.3f"}});
  plexway::PropagateOptions options = bench::one_label();
  options.vectorised = !scalar;
  return report.write(table, [&] {
    for (const samples::CornerDomain& domain : samples::corner_domains())
      for (const bench::Index n : {50u, 100u, 200u, 400u})
        if (n <= most)
          table.add(double_precision ? measure<double>(domain, n, seeds, options)
                                     : measure<float>(domain, n, seeds, options));
  });
}
