// Strips very many edges long, flat, in a straight frame, so that distances are straight lines:
// what do rounding and merging come to over so many edges? By lengths alone, with their places in
// the plane, and wound up on a cylinder, where straight lines through space say nothing.

#include <cmath>

#include "data/long_strips.hpp"
#include "solver.hpp"

namespace bench::strips {

template <class Real>
plexway::TriangleMesh<Real> mesh_of(const samples::LongStrip& strip, const std::string& form) {
  if (form == "lengths") return {strip.vertices(), strip.faces, strip.lengths()};
  return {form == "plane" ? strip.in_plane() : strip.wound(), strip.faces};
}

template <class Real>
Row measure(Index edges, Index rows, const std::string& form,
            const plexway::PropagateOptions& options, std::size_t seeds) {
  double mean = 0, bias = 0, worst = 0, count = 0, turns = 0, ns = 0;
  for (std::size_t seed = 1; seed <= seeds; ++seed) {
    const samples::LongStrip strip(edges, rows, seed);
    const auto mesh = mesh_of<Real>(strip, form);
    Solver solver(mesh, options);
    ns += 1e9 * processor_seconds([&] { solver(0); });
    turns += static_cast<double>(solver.statistics().expansions);
    for (Index v = 1; v < strip.vertices(); ++v) {
      const double off = static_cast<double>(solver.distance()[v]) / strip.between(0, v) - 1;
      mean += std::abs(off);
      bias += off;
      worst = std::max(worst, std::abs(off));
      ++count;
    }
  }
  return {{"edges", edges},       {"rows", rows}, {"form", form},           {"mean", mean / count},
          {"bias", bias / count}, {"max", worst}, {"turns", turns / count}, {"ns", ns / count}};
}

void run(Arguments& arguments) {
  std::vector<Index> lengths = {1000, 10000, 100000}, rows = {2};
  std::vector<std::string> forms = {"lengths", "plane", "wound"};
  std::size_t seeds = 1;
  bool twice = false;
  std::string accuracy = "usual";
  arguments.option("--edges", &lengths, "Edges along the strip");
  arguments.option("--rows", &rows, "Rows of cells");
  arguments.option("--forms", &forms, "How the surface is given", {"lengths", "plane", "wound"});
  arguments.option("--seeds", &seeds, "Strips of each kind");
  arguments.option("--accuracy", &accuracy, "What is asked for",
                   {"usual", "fast", "accurate", "exact"});
  arguments.option("--double", &twice, "Double instead of float");
  Table& table = arguments.table(
      "edges; rows; form: given by; mean: error mean %.1e; bias: with its sign %.1e; max %.1e;"
      "turns: turns/V %.2f; ns: ns/V %.0f");
  for (const Index n : lengths)
    for (const Index r : rows)
      for (const std::string& form : forms)
        table.add(twice ? measure<double>(n, r, form, by_accuracy(accuracy), seeds)
                        : measure<float>(n, r, form, by_accuracy(accuracy), seeds));
}
const Command command("strips", "flat strips very many edges long, against straight lines", run);

}  // namespace bench::strips
