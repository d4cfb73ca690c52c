// Strips very many edges long, flat, in a straight frame, so that distances are straight lines:
// what do rounding and merging come to over so many edges? By lengths alone, with their places in
// the plane, and wound up on a cylinder, where straight lines through space say nothing.

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <plexway/solve.hpp>

#include "../data/long_strips.hpp"
#include "harness.hpp"
#include "processor_time.hpp"
#include "table.hpp"

namespace {

using namespace plexway;

template <class Real>
TriangleMesh<Real> mesh_of(const samples::LongStrip& strip, const std::string& form) {
  if (form == "lengths") return {strip.vertices(), strip.faces, strip.lengths()};
  return {form == "plane" ? strip.in_plane() : strip.wound(), strip.faces};
}

template <class Real>
nlohmann::ordered_json measure(Index edges, Index rows, const std::string& form,
                               const Accuracy& accuracy, std::uint64_t seeds) {
  PropagateOptions options;
  options.accuracy = accuracy;
  double mean = 0, bias = 0, worst = 0, count = 0, turns = 0, ns = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const samples::LongStrip strip(edges, rows, seed);
    const auto mesh = mesh_of<Real>(strip, form);
    Workspace<Real> workspace;
    DistanceField<Real> field;
    const PointSource source = PointSource::at(0);
    ns += 1e9 * bench::processor_seconds([&] {
            solve(Serial{}, mesh, std::span(&source, 1), options, workspace, field);
          });
    turns += static_cast<double>(field.statistics.expansions);
    for (Index v = 1; v < strip.vertices(); ++v) {
      const double off = static_cast<double>(field.distance[v]) / strip.between(0, v) - 1;
      mean += std::abs(off);
      bias += off;
      worst = std::max(worst, std::abs(off));
      ++count;
    }
  }
  return {{"edges", edges},       {"rows", rows}, {"form", form},           {"mean", mean / count},
          {"bias", bias / count}, {"max", worst}, {"turns", turns / count}, {"ns", ns / count}};
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Index> lengths = {1000, 10000, 100000}, rows = {2};
  std::vector<std::string> forms = {"lengths", "plane", "wound"};
  std::uint64_t seeds = 1;
  bool twice = false;
  std::string named = "usual";
  bench::Report report;
  CLI::App app("Strips very many edges long");
  app.add_option("--edges", lengths, "Edges along the strip")->capture_default_str();
  app.add_option("--rows", rows, "Rows of cells")->capture_default_str();
  app.add_option("--forms", forms, "How the surface is given")
      ->check(CLI::IsMember({"lengths", "plane", "wound"}))
      ->capture_default_str();
  app.add_option("--seeds", seeds, "Strips of each kind")->capture_default_str();
  app.add_option("--accuracy", named, "usual, fast, accurate or exact")
      ->check(CLI::IsMember({"usual", "fast", "accurate", "exact"}))
      ->capture_default_str();
  app.add_flag("--double", twice, "Double instead of float");
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);
  const Accuracy accuracy = named == "fast"       ? Accuracy::fast()
                            : named == "accurate" ? Accuracy::accurate()
                            : named == "exact"    ? Accuracy::exact()
                                                  : Accuracy::usual();

  bench::Table table({{"edges", "edges"},
                      {"rows", "rows"},
                      {"form", "given by"},
                      {"mean", "error mean", "%.1e"},
                      {"bias", "with its sign", "%.1e"},
                      {"max", "max", "%.1e"},
                      {"turns", "turns/V", "%.2f"},
                      {"ns", "ns/V", "%.0f"}});
  return report.write(table, [&] {
    for (const Index n : lengths)
      for (const Index r : rows)
        for (const std::string& form : forms)
          table.add(twice ? measure<double>(n, r, form, accuracy, seeds)
                          : measure<float>(n, r, form, accuracy, seeds));
  });
}
