// Programs of users that are wrong. wrong_programs.sh compiles each by its name alone.

#include <array>
#include <string>
#include <vector>

#include <plexway/cloud/point_cloud.hpp>
#include <plexway/paths/path_field.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solve.hpp>

using namespace plexway;

const std::vector<std::array<double, 3>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

#ifdef IS_cloud_alone  // Points whose neighbours nobody looked for.
const PointCloud<float> cloud(points);
#endif
#ifdef IS_corners_of_floats  // Vertices as floats.
const TriangleMesh<float> mesh(points, std::vector<float>{0, 1, 2});
#endif
#ifdef IS_distances_of_int  // Distances in whole numbers.
const TriangleMesh<int> mesh(points, std::vector<std::array<Index, 3>>{{0, 1, 2}});
#endif
#ifdef IS_double_on_gl  // Double precision on an executor that has none.
auto fields(const TriangleMesh<double>& mesh) { return solve_each(GL{}, mesh, {0, 1}); }
#endif
#ifdef IS_executor_first  // Executor and domain the wrong way around.
auto field(const TriangleMesh<float>& mesh) { return solve(mesh, Serial{}, 0); }
#endif
#ifdef IS_executor_missing  // No executor.
auto field(const TriangleMesh<float>& mesh) { return solve(mesh, 0); }
#endif
#ifdef IS_five_dimensions  // More dimensions than there are.
auto count(const SimplicialComplex<double, 5>& complex) { return complex.simplex_count(); }
#endif
#ifdef IS_mixed_on_gl  // An executor that does not take the domain.
auto field(const MixedComplex<float>& mixed) { return solve(GL{}, mixed, 0); }
#endif
#ifdef IS_options_without_braces  // An accuracy where all options stand.
auto field(const TriangleMesh<double>& mesh) { return solve(Serial{}, mesh, 0, Accuracy::exact()); }
#endif
#ifdef IS_order_of_threads  // An order that needs one thread.
auto field(const Wireframe<double>& wires) { return solve(OpenMP{}, wires, 0, NearestFirst{}); }
#endif
#ifdef IS_order_on_gl  // An order that the executor does not know.
auto field(const TriangleMesh<float>& mesh) { return solve(GL{}, mesh, 0, NearestFirst{}); }
#endif
#ifdef IS_own_domain  // A class of one's own that is no domain.
struct Mine {
  int vertex_count() const { return 3; }
};
auto field(const Mine& mine) { return solve(Serial{}, mine, 0); }
#endif
#ifdef IS_paths_of_simplices  // Paths where none are traced.
auto paths(const SimplicialComplex<double, 3>& complex) { return PathField(complex, points); }
#endif
#ifdef IS_position_as_source  // A position in space as a source.
auto field(const TriangleMesh<float>& mesh) {
  return solve(Serial{}, mesh, std::array<double, 3>{.5, .5, 0});
}
#endif
#ifdef IS_quads  // Quads as triangles.
const std::vector<std::array<int, 4>> quads = {{0, 1, 2, 0}};
const TriangleMesh<float> mesh(points, quads);
#endif
#ifdef IS_text_as_accuracy  // An accuracy as Python has it.
auto field(const TriangleMesh<float>& mesh) {
  return solve(Serial{}, mesh, 0, {.accuracy = "exact"});
}
#endif
#ifdef IS_text_as_positions  // Coordinates that were never made numbers.
const std::vector<std::array<std::string, 3>> positions = {{"0", "0", "0"}};
const std::vector<std::array<int, 3>> triangles = {{0, 1, 2}};
const TriangleMesh<float> mesh(positions, triangles);
#endif
#ifdef IS_text_as_source  // A source as the tool's options have it.
auto field(const TriangleMesh<float>& mesh) { return solve(Serial{}, mesh, "vertex:0"); }
#endif
