// Flat domains with corners on finer and finer grids, against the exact distances of a visibility
// graph: does what a rule forgets of a corner fall with refinement? Here it is all there is, as
// there is no curvature.

#include "data/corner_domains.hpp"
#include "solver.hpp"

namespace bench::corners {

template <class Real>
Row measure(const samples::CornerDomain& domain, Index n, std::uint64_t seeds,
            const plexway::PropagateOptions& options) {
  Errors errors;
  std::vector<double> ns;
  double expansions = 0, faces = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const samples::Shape grid = domain.grid(n, 0.25, seed);
    const plexway::TriangleMesh<Real> mesh(grid.points, grid.faces);
    Solver solver(mesh, options);
    solver(0);
    for (int repeat = 0; repeat < 3; ++repeat)
      ns.push_back(1e9 * seconds([&] { solver(0); }) / static_cast<double>(grid.points.size()));
    errors.add({0, domain.distances(grid.points)}, solver.distance());
    expansions += static_cast<double>(solver.statistics().expansions);
    faces += static_cast<double>(grid.faces.size());
  }
  Row row = {{"domain", domain.name}, {"cells", n}};
  add_errors(row, errors);
  return row.update({{"ns", median(ns)}, {"expansions", expansions / faces}});
}

void run(Arguments& arguments) {
  Index most = 400;
  std::size_t seeds = 3;
  bool twice = false, scalar = false;
  arguments.option("--most", &most, "Cells a side at most");
  arguments.option("--seeds", &seeds, "Grids of each size");
  arguments.option("--double", &twice, "Double instead of float");
  arguments.option("--scalar", &scalar, "The full rule for every hinge");
  Table& table = arguments.table(
      "domain; cells: cells a side; mean: error mean %.1e; p99 %.1e; max %.1e;"
      "below: most below %.1e; wrong; ns: ns/V %.0f; expansions: expansions/face %.3f");
  plexway::PropagateOptions options = one_label();
  options.vectorised = !scalar;
  for (const samples::CornerDomain& domain : samples::corner_domains())
    for (const Index n : {50u, 100u, 200u, 400u})
      if (n <= most)
        table.add(twice ? measure<double>(domain, n, seeds, options)
                        : measure<float>(domain, n, seeds, options));
}
const Command command("corners", "flat domains with corners, against a visibility graph", run);

}  // namespace bench::corners
