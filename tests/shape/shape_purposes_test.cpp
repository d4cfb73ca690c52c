// What is done with a shape, and what is written of one: the cells of the table (support.hpp,
// Purpose) that purposes_test.cpp leaves.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/shape/isolines.hpp>
#include <plexway/shape/pairs.hpp>
#include <plexway/shape/support.hpp>

#include "folder.hpp"
#include "shape/files/files.hpp"
#include "shape/info/error_classes.hpp"
#include "shape/kinds.hpp"

namespace shape_purposes_test {

using namespace any_testing;
using Catch::Matchers::Contains;

namespace {

double from_origin(const Position& p) { return std::hypot(p[0], p[1], p[2]); }

double to_edge(const Position& p, std::size_t axes) {
  double least = inf;
  for (std::size_t k = 0; k < axes; ++k) least = std::min({least, p[k], 1 - p[k]});
  return least;
}

// Two simplices of a kind with regions 4 and 7, as a .vtk.
std::string two_regions(DomainKind kind) {
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
  const std::string cells = kind == DomainKind::surface ? "CELLS 2 8\n3 0 1 2\n3 1 4 2\n"
                            : kind == DomainKind::solid ? "CELLS 2 10\n4 0 1 2 3\n4 1 2 3 4\n"
                            : kind == DomainKind::mixed ? "CELLS 2 7\n2 0 1\n3 1 4 2\n"
                                                        : "CELLS 2 6\n2 0 1\n2 1 4\n";
  const std::string types = kind == DomainKind::surface ? "5\n5\n"
                            : kind == DomainKind::solid ? "10\n10\n"
                            : kind == DomainKind::mixed ? "3\n5\n"
                                                        : "3\n3\n";
  return head + cells + "CELL_TYPES 2\n" + types + "CELL_DATA 2\nFIELD f 1\nregion 1 2 int\n4 7\n";
}

}  // namespace

TEST_CASE("level sets, margins and errors of any domain") {
  for (const Kind& kind : all_kinds()) {
    const AnyDomain domain = exactly(kind);
    const PointSource source = PointSource::at(0);
    const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
    const std::vector<double> distance = field.field().doubles();
    const double value = 0.45;
    check(kind, Purpose::arcs, [&] {
      const auto lines = isolines(kind.shape, field, std::span(&value, 1), 1e-5);
      REQUIRE_FALSE(lines.empty());
      for (const Path& line : lines)
        for (const Position& p : line.positions)
          CHECK(from_origin(p) == Approx(value).margin(2e-5));
      const FineField fine = fine_field(kind.shape, field, 1e-3);
      CHECK(fine.faces.size() > kind.shape.simplices());
      for (std::size_t v = 0; v < fine.distance.size(); ++v)
        CHECK(fine.distance[v] == Approx(from_origin(fine.positions[v])).margin(1e-9));
    });
    check(kind, Purpose::arcs, [&] { (void)fine_field(kind.shape, field, 1e-3); });
    check(kind, Purpose::isosurfaces, [&] {
      // Linear between values of the closed form: off by a half of edge squared over the radius.
      const Isosurfaces found = isosurfaces(kind.shape, distance, std::span(&value, 1));
      REQUIRE_FALSE(found.triangles.empty());
      for (const Position& p : found.positions) CHECK(from_origin(p) == Approx(value).margin(0.07));
    });
    check(kind, Purpose::error_classes, [&] {
      ErrorClasses classes(kind.shape);
      std::vector<double> longer = distance;
      for (double& d : longer) d *= 1.25;
      classes.add(longer, distance, kind.places[0]);
      double most = 0;
      for (const auto& row : classes.json()) {
        if (row["vertices"] > 0) CHECK(row["above"].get<double>() == Approx(0.25));
        most = std::max(most, row["vertices"].get<double>());
      }
      CHECK(most > 0);
    });
    for (const bool near : {false, true}) {
      PairsRequest one;
      one.rows.emplace(source);
      const auto rows = [&](const AnyExecutor& executor) {
        std::vector<double> row(kind.places.size(), inf);
        if (near)
          (void)near_pairs(executor, domain, one, {},
                           {.row = [&](std::size_t, SparseRow<double> found) {
                             for (const auto& entry : found) row[entry.column] = entry.distance;
                           }});
        else
          (void)all_pairs(executor, domain, one, {.row = [&](std::size_t, DenseRow<double> d) {
                            row.assign(d.begin(), d.end());
                          }});
        return row;
      };
      const std::vector<double> row = rows(Serial{});
      for (std::size_t v = 0; v < row.size(); ++v)
        CHECK(row[v] == Approx(kind.from_first(v)).epsilon(near ? 1e-3 : 1e-6).margin(1e-9));
      CHECK(static_cast<bool>(support(Purpose::rows, kind.shape.kind())));
      const Support by_gl = support(Purpose::rows, kind.shape.kind(), ExecutorKind::gl);
      REQUIRE_FALSE(static_cast<bool>(by_gl));
      CHECK_THROWS_WITH(rows(GL{}), by_gl.sentence());
    }
    check(kind, Purpose::margins, [&] {
      const auto far = static_cast<Index>(kind.places.size() - 1);
      const double length = field.trace(PointSource::at(far), {.margin = 0.01}).length;
      CHECK(length == Approx(kind.from_first(far)).epsilon(1e-6));
      CHECK_THROWS_AS(field.trace(PointSource::at(far), {.margin = 1.5}), UsageError);
    });
  }
}

TEST_CASE("margins are refused where paths are refracted") {
  const Surface square = grid(6, 6);
  const AnyShape shape = AnyShape::surface(square.positions, square.faces);
  metric::SimplexSpeeds speeds{std::vector<double>(square.faces.size(), 1),
                               {.sides = metric::Sides::own}};
  speeds.speed[7] = 2;
  const AnyDomain domain(
      shape, {.lengths = std::make_shared<const MeasuredLengths>(shape.measure(speeds))});
  REQUIRE(domain.refracting_edges() > 0);
  const PointSource source = PointSource::at(0);
  const AnyPathField field = domain.path_field(Serial{}, std::span(&source, 1));
  CHECK(field.trace(PointSource::at(35)).length > 0.5);
  CHECK_THROWS_WITH(field.trace(PointSource::at(35), {.margin = 0.01}),
                    Support(Refusal::margins_refraction).sentence());
}

TEST_CASE("lines, boundaries, regions and tensors of any shape") {
  const ::testing::Folder folder;
  for (const Kind& kind : all_kinds()) {
    const DomainKind is = kind.shape.kind();
    const AnyDomain domain = exactly(kind, {.triangulation = Triangulation::automatic});
    check(kind, Purpose::lines, [&] {
      const auto far = static_cast<Index>(kind.places.size() - 1);
      const std::vector<PointSource> ends = {PointSource::at(0), PointSource::at(far)};
      const CurveSource line = kind.shape.joined(ends);
      double length = 0;
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
        const Position p = kind.place(line.points[i]), q = kind.place(line.points[i + 1]);
        length += std::hypot(q[0] - p[0], q[1] - p[1], q[2] - p[2]);
      }
      CHECK(length == Approx(kind.from_first(far)).epsilon(1e-6));
    });
    check(kind, Purpose::boundaries, [&] {
      if (is == DomainKind::wireframe) {  // the bars make cells, which have no single ends
        CHECK_THROWS_WITH(kind.shape.boundary(), Contains("has none"));
        const AnyShape line = AnyShape::wireframe(
            {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}}, std::vector<std::array<Index, 2>>{{0, 1}, {1, 2}});
        const auto d = AnyDomain(line).solve(Serial{}, line.boundary(0.5)).doubles();
        CHECK(d == std::vector<double>{0.5, 1.5, 0.5});
        return;
      }
      const auto d = domain.solve(Serial{}, kind.shape.boundary()).doubles();
      for (std::size_t v = 0; v < d.size(); ++v)
        CHECK(d[v] ==
              Approx(to_edge(kind.places[v], is == DomainKind::solid ? 3 : 2)).margin(1e-6));
    });
    check(kind, Purpose::tensors, [&] {
      const metric::VertexTensors fast{
          std::vector<metric::Tensor>(kind.shape.vertices(), metric::Tensor::of_speed(4))};
      const auto lengths = std::make_shared<const MeasuredLengths>(kind.shape.measure(fast));
      check_field(kind, exactly(kind, {.lengths = lengths}).solve(Serial{}, PointSource::at(0)),
                  0.25);
    });
    check(kind, Purpose::regions, [&] {
      if (!support(Purpose::regions, is)) return (void)kind.shape.regions();
      CHECK_THROWS_WITH(kind.shape.regions(), Contains("come from a file"));
      const auto file = folder.write("two.vtk", two_regions(is));
      const AnyShape shape = AnyShape::read(file, {.as = is});
      CHECK(shape.regions() == std::vector<std::int64_t>{4, 7});
    });
  }
}

TEST_CASE("the boundary of what a mask leaves open is its own") {
  const Surface square = grid(10, 10);
  const Solid cube = solid_cube(5, 0);
  for (const Kind& kind :
       {Kind{AnyShape::surface(square.positions, square.faces), square.positions},
        Kind{AnyShape::solid(cube.positions, cube.tets), cube.positions}}) {
    const DomainKind is = kind.shape.kind();
    auto mask = std::make_shared<Mask>(kind.shape.vertices(), kind.shape.simplices());
    double edge = 0;  // of what is left: simplices with a closed corner are closed
    for (std::size_t v = 0; v < kind.places.size(); ++v)
      if (kind.places[v][0] > 0.65)
        mask->close_vertex(static_cast<Index>(v));
      else
        edge = std::max(edge, kind.places[v][0]);
    const AnyShape open = kind.shape.open_part(*mask);
    const auto d = exactly(kind, {.triangulation = Triangulation::input, .mask = mask})
                       .solve(Serial{}, open.boundary())
                       .doubles();
    for (std::size_t v = 0; v < d.size(); ++v) {
      const Position& p = kind.places[v];
      const double truth = std::min(to_edge(p, is == DomainKind::solid ? 3 : 2), edge - p[0]);
      CHECK(d[v] == (p[0] > 0.65 ? Approx(inf) : Approx(truth).margin(1e-6)));
    }
    CHECK_THROWS_WITH(kind.shape.open_part(Mask(3, 3)), Contains("a mask of 3 vertices"));
  }
}

TEST_CASE("what fields of any kind are written to") {
  const ::testing::Folder folder;
  for (const Kind& kind : all_kinds()) {
    const DomainKind is = kind.shape.kind();
    const std::vector<double> distance(kind.shape.vertices(), 1);
    const std::string name(kind_name(is));
    check(kind, Purpose::parts, [&] {
      const auto file = folder.at(name + ".pvtu");
      write_partitioned(kind.shape, file, distance, {}, {}, {0, 1, [] {}});
      CHECK(std::filesystem::file_size(file) > 100);
      CHECK(std::filesystem::exists(folder.path() / (name + "_0.vtu")));
    });
    check(kind, Purpose::volumes, [&] {
      try {
        kind.shape.write_field(folder.at(name + ".vdb"), distance);
      } catch (const NotBuiltError&) {
        WARN("no level sets in this build");
      } catch (const UsageError& error) {
        if (!support(Purpose::volumes, is)) throw;
        CHECK_THAT(error.what(), Contains("voxel"));  // there is none unless it was read with one
      }
    });
    CHECK(AnyShape::field_extensions(is).size() ==
          AnyShape::field_extensions(DomainKind::wireframe).size() +
              (is == DomainKind::cloud || support(Purpose::volumes, is) ? 1 : 0));
  }
}

TEST_CASE("what is converted, and what one kind is taken as") {
  const ::testing::Folder folder;
  const std::vector<std::pair<DomainKind, std::string>> files = {
      {DomainKind::surface, folder.write("f.vtk", two_regions(DomainKind::surface)).string()},
      {DomainKind::solid, folder.write("s.vtk", two_regions(DomainKind::solid)).string()},
      {DomainKind::wireframe, folder.write("w.vtk", two_regions(DomainKind::wireframe)).string()},
      {DomainKind::cloud, folder.write("c.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n").string()},
      {DomainKind::mixed, folder.write("m.vtk", two_regions(DomainKind::mixed)).string()},
      {DomainKind::simplices,
       folder.write("s.simplices", "dimension 2\nvertices 3 2\n0 0\n1 0\n0 1\nsimplices 1\n0 1 2\n")
           .string()}};
  for (const auto& [kind, file] : files) {
    INFO(kind_name(kind));
    const std::string out = folder
                                .at(kind == DomainKind::wireframe ? "out.edges"
                                    : kind == DomainKind::cloud   ? "out.xyz"
                                                                  : "out.ply")
                                .string();
    ReadOptions options;
    if (kind == DomainKind::mixed) options.as = kind;
    const Support found = support(Purpose::conversions, kind);
    if (found) {
      CHECK(convert(file, out, options).vertices >= 4);
      CHECK(std::filesystem::file_size(out) > 10);
    } else {
      CHECK_THROWS_WITH(convert(file, out, options), Catch::Matchers::EndsWith(found.sentence()));
    }
    for (const auto& [wanted, other] : files) {
      if (kind == DomainKind::mixed || wanted == DomainKind::mixed) continue;  // by the file
      INFO("as " << kind_name(wanted));
      const bool taken = static_cast<bool>(support(Reading::kind, {kind, wanted}));
      try {
        const AnyShape shape = AnyShape::read(file, {.as = wanted});
        CHECK(shape.kind() == wanted);
        CHECK(taken);
      } catch (const NotBuiltError&) {
        CHECK(taken);
      } catch (const InputError& error) {
        if (!taken) CHECK_THAT(error.what(), Contains("cannot be taken as"));
        // Two triangles enclose nothing, and four points are too few for neighbours.
      }
    }
  }
}

}  // namespace shape_purposes_test
