#include <catch2/catch.hpp>

#include <limits>

#include <plexway/error.hpp>
#include <plexway/simplicial/simplicial_complex.hpp>
#include <plexway/solid/tet_mesh.hpp>

#include "complexes/test_meshes.hpp"

namespace plexway::testing::bad_input_test {

using Catch::Matchers::Contains;

namespace {

const double infinity = std::numeric_limits<double>::infinity();
const double not_a_number = std::numeric_limits<double>::quiet_NaN();
using Lengths = std::vector<std::array<double, 3>>;

template <class Make>
std::string error_of(Make make) {
  try {
    make();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEMPLATE_TEST_CASE("bad coordinates name their vertex", "", float, double) {
  for (const double bad : {infinity, -infinity, not_a_number})
    for (std::size_t d = 0; d < 3; ++d) {
      Surface s = grid(3, 3);
      s.positions[7][d] = bad;
      CHECK_THAT(error_of([&] { return s.mesh<TestType>(); }), Contains("vertex 7"));
    }
}

TEMPLATE_TEST_CASE("bad faces name themselves", "", float, double) {
  Surface s = grid(3, 3);
  s.faces[5][1] = 16;
  const std::string out_of_range = error_of([&] { return s.mesh<TestType>(); });
  CHECK_THAT(out_of_range, Contains("face 5") && Contains("vertex 16"));
  s.faces[5][1] = none;
  CHECK_THAT(error_of([&] { return s.mesh<TestType>(); }), Contains("face 5"));
  s.faces[5] = {3, 4, 3};
  CHECK_THAT(error_of([&] { return s.mesh<TestType>(); }),
             Contains("face 5") && Contains("vertex 3"));
  s.faces.clear();
  CHECK_THAT(error_of([&] { return s.mesh<TestType>(); }), Contains("no faces"));
}

TEST_CASE("nothing at all is refused") {
  CHECK_THROWS_AS(Surface().mesh<float>(), InputError);
  CHECK_THROWS_AS(TriangleMesh<float>(0, std::vector<Face>{}, Lengths{}), InputError);
}

TEMPLATE_TEST_CASE("bad lengths name their face", "", float, double) {
  const Surface s = grid(3, 3);
  for (const double bad : {infinity, not_a_number, -1.0, -1e-300}) {
    Lengths lengths = lengths_of(s);
    lengths[11][2] = bad;
    CHECK_THAT(
        error_of([&] { return TriangleMesh<TestType>(s.positions.size(), s.faces, lengths); }),
        Contains("face 11"));
  }
  Lengths lengths = lengths_of(s);
  lengths.pop_back();
  CHECK_THROWS_AS(TriangleMesh<TestType>(s.positions.size(), s.faces, lengths), InputError);
  Surface t = s;
  t.faces[2] = {0, 1, 99};
  CHECK_THAT(
      error_of([&] { return TriangleMesh<TestType>(s.positions.size(), t.faces, lengths_of(s)); }),
      Contains("face 2") && Contains("vertex 99"));
}

TEST_CASE("an extent beyond the largest number is refused") {
  Surface s;
  s.add(-1.7e308, 0), s.add(1.7e308, 0), s.add(0, 1.7e308);
  s.triangle(0, 1, 2);
  CHECK_THAT(error_of([&] { return s.mesh<double>(); }), Contains("face 0"));
}

TEMPLATE_TEST_CASE("two lengths of one edge are refused by its name", "", float, double) {
  const std::vector<Face> faces = {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}};
  for (const double second : {1.5, 1 + 1e-7}) {
    const Lengths lengths = {{1, 1, 1}, {1, 1, second}, {1, 1, 1}};
    const std::string error = error_of([&] { TriangleMesh<TestType>(5, faces, lengths); });
    if (second < 1.1) {
      CHECK(error.empty());
    } else {
      CHECK_THAT(error, Contains("edge 1 - 2") && Contains("1.5"));
      CHECK_THAT(
          error_of([&] {
            SimplicialComplex<TestType, 2>(5, faces, Lengths{{1, 1, 1}, {1, second, 1}, {1, 1, 1}});
          }),
          Contains("edge 1 - 2"));
    }
    const std::vector<std::array<Index, 4>> tets = {{0, 1, 2, 3}, {4, 3, 2, 1}};
    const std::vector<std::array<double, 6>> six = {{1, 1, 1, 1, 1, 1}, {1, 1, second, 1, 1, 1}};
    CHECK((error_of([&] { TetMesh<TestType>(5, tets, six); }).find("edge 2 - 3") !=
           std::string::npos) == (second > 1.1));
  }
  // Where paths are refracted an edge has two.
  SurfaceHints hints;
  hints.refracts = true;
  CHECK_NOTHROW(
      TriangleMesh<TestType>(5, faces, Lengths{{1, 1, 1}, {1, 1, 1.5}, {1, 1, 1}}, hints));
}

}  // namespace plexway::testing::bad_input_test
