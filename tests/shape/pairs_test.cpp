// Matrices behind the facade: rows as AnyDomain::solve has them, into files and out of order.

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/shape/pairs.hpp>

#include "complexes/test_meshes.hpp"
#include "folder.hpp"

namespace plexway::pairs_test {

namespace {

namespace meshes = plexway::testing;

// Two squares that share an edge, each a part of its own.
MixedShape two_squares() {
  const meshes::Surface grid = meshes::slit_square(5);
  MixedShape shape;
  shape.tolerance = 1e-9;
  for (const double shift : {0.0, 1.0}) {
    MixedShape::Part part;
    part.first_vertex = shape.positions.size();
    part.vertices = grid.positions.size();
    for (const auto& p : grid.positions) shape.positions.push_back({p[0] + shift, p[1], p[2]});
    for (auto face : grid.faces) {
      for (Index& v : face) v += static_cast<Index>(part.first_vertex);
      part.triangles.push_back(face);
    }
    shape.parts.push_back(part);
  }
  return shape;
}

std::vector<AnyDomain> domains() {
  const meshes::Surface grid = meshes::slit_square(9);
  std::vector<AnyDomain> made;
  made.emplace_back(AnyShape::surface(grid.positions, grid.faces));
  made.emplace_back(AnyShape::surface(grid.positions, grid.faces),
                    BuildOptions{.precision = Precision::float64});
  made.emplace_back(AnyShape::mixed(two_squares()));
  return made;
}

std::vector<Source> some_sources() {
  return {PointSource::at(3), VertexSource{.vertices = {2, 9}, .offsets = {0.25, 0}},
          PointSource::in(7, {0.2, 0.3, 0.5}), PointSource::at(0)};
}

}  // namespace

TEST_CASE("matrices of any domain have the rows of solve") {
  const std::vector<Source> sources = some_sources();
  const std::vector<Index> columns = {8, 1, 30};
  for (const AnyDomain& domain : domains()) {
    std::vector<std::vector<double>> truth;
    for (const Source& source : sources)
      truth.push_back(domain.solve(Serial{}, SourceList(source)).doubles());
    PairsRequest request{.rows = SourceList(sources), .block = 3};
    for (const AnyExecutor& executor : {AnyExecutor(Serial{}), AnyExecutor(OpenMP{.threads = 3})}) {
      if (std::holds_alternative<OpenMP>(executor) && !openmp_built()) continue;
      std::vector<std::vector<double>> rows(sources.size());
      std::vector<std::size_t> blocks;
      request.columns = {};
      const PairsReport report = all_pairs(
          executor, domain, request,
          {[&](std::size_t row, DenseRow<double> d) { rows[row].assign(d.begin(), d.end()); },
           [&](std::size_t block) { blocks.push_back(block); }});
      CHECK(rows == truth);
      CHECK(report.rows == sources.size());
      CHECK((report.complete && report.statistics.expansions > 0));
      std::sort(blocks.begin(), blocks.end());
      CHECK(blocks == std::vector<std::size_t>{0, 1});

      request.columns = columns;
      std::mutex one;
      all_pairs(executor, domain, request, {[&](std::size_t row, DenseRow<double> d) {
                  const std::scoped_lock lock(one);
                  REQUIRE(d.size() == columns.size());
                  for (std::size_t c = 0; c < columns.size(); ++c)
                    REQUIRE(d[c] == truth[row][columns[c]]);
                }});
    }
    CHECK_THROWS_WITH(all_pairs(GL{}, domain, request, {[](std::size_t, DenseRow<double>) {}}),
                      Catch::Contains("OpenMP"));
    const std::vector<Index> wrong = {static_cast<Index>(domain.vertices())};
    request.columns = wrong;
    CHECK_THROWS_AS(all_pairs(Serial{}, domain, request, {[](std::size_t, DenseRow<double>) {}}),
                    UsageError);
  }
}

TEST_CASE("what is near on any domain is what the rows say, the first of equals") {
  const std::vector<Source> sources = some_sources();
  for (const AnyDomain& domain : domains()) {
    PairsRequest request{.rows = SourceList(sources), .block = 3};
    request.solve.accuracy = Accuracy::fast();
    std::vector<std::vector<double>> truth;
    for (const Source& source : sources)
      truth.push_back(domain.solve(Serial{}, SourceList(source), request.solve).doubles());
    for (const NearLimits limits : {NearLimits{.radius = 0.4}, NearLimits{.nearest = 5},
                                    NearLimits{.radius = 0.4, .nearest = 7}}) {
      near_pairs(
          Serial{}, domain, request, limits, {[&](std::size_t row, SparseRow<double> near) {
            std::vector<double> sorted = truth[row];
            std::sort(sorted.begin(), sorted.end());
            const auto inside = static_cast<std::size_t>(std::count_if(
                sorted.begin(), sorted.end(), [&](double d) { return d <= limits.radius - 1e-5; }));
            REQUIRE(near.size() >= std::min(inside, limits.nearest));
            REQUIRE(near.size() <= limits.nearest);
            std::vector<double> found;
            for (std::size_t i = 0; i < near.size(); ++i) {
              if (i > 0) REQUIRE(near[i - 1].column < near[i].column);
              REQUIRE(near[i].distance == Approx(truth[row][near[i].column]).margin(1e-5));
              REQUIRE(near[i].distance <= limits.radius);
              found.push_back(near[i].distance);
            }
            std::sort(found.begin(), found.end());
            for (std::size_t i = 0; i < found.size(); ++i)
              REQUIRE(found[i] == Approx(sorted[i]).margin(1e-5));
          }});
    }
    CHECK_THROWS_AS(near_pairs(Serial{}, domain, request, {.radius = -1},
                               {[](std::size_t, SparseRow<double>) {}}),
                    UsageError);
  }
}

TEST_CASE("fingerprints tell what differs") {
  const meshes::Surface grid = meshes::slit_square(4);
  meshes::Surface other = grid;
  other.positions[3][1] += 1e-12;
  const AnyShape one = AnyShape::surface(grid.positions, grid.faces);
  CHECK(fingerprint_of(one) == fingerprint_of(AnyShape::surface(grid.positions, grid.faces)));
  CHECK(fingerprint_of(one) != fingerprint_of(AnyShape::surface(other.positions, other.faces)));
  MixedShape moved = two_squares();
  moved.tolerance = 1e-8;
  CHECK(fingerprint_of(AnyShape::mixed(two_squares())) != fingerprint_of(AnyShape::mixed(moved)));

  const std::vector<Source> sources = some_sources();
  std::vector<Source> changed = sources;
  CHECK(fingerprint_of(SourceList(sources)) == fingerprint_of(SourceList(changed)));
  std::get<VertexSource>(changed[1]).offset = 0.5;
  CHECK(fingerprint_of(SourceList(sources)) != fingerprint_of(SourceList(changed)));
  const std::vector<PointSource> points = {PointSource::at(3)};
  std::vector<PointSource> later = points;
  later[0].offset = 1;
  CHECK(fingerprint_of(SourceList(points)) != fingerprint_of(SourceList(later)));
}

TEST_CASE("a file of any domain goes on where it was ended") {
  const ::testing::Folder folder;
  const AnyDomain domain = domains().back();
  const std::filesystem::path out = folder.at("d.npy");
  PairsRequest request;
  request.block = 4;
  const std::size_t n = domain.vertices();
  const io::BlockJournal::Description what = {{"input", fingerprint_of(domain.shape())}};
  std::size_t solved = 0;
  {
    io::BlockJournal journal(out, what, request.block_count(n));
    io::MatrixFile file(out, n, n, io::MatrixNumber::float64, journal.resumed());
    request.progress = [&](const PairsProgress& p) { return (solved = p.rows_done) < n / 2; };
    CHECK_THROWS_AS(io::write_pairs(AnyExecutor(Serial{}), domain, request, file, journal),
                    Cancelled);
  }
  request.progress = {};
  io::BlockJournal journal(out, what, request.block_count(n));
  CHECK(journal.finished() >= solved / 4 - 1);
  io::MatrixFile file(out, n, n, io::MatrixNumber::float64, journal.resumed());
  const PairsReport report = io::write_pairs(AnyExecutor(Serial{}), domain, request, file, journal);
  CHECK((report.rows > 0 && report.rows <= n - solved / 4 * 4 + 4));
  file.commit();
  journal.remove();
  std::ifstream in(out, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  REQUIRE(bytes.size() > n * n * sizeof(double));
  std::vector<double> all(n * n);
  std::copy_n(bytes.end() - static_cast<std::ptrdiff_t>(n * n * sizeof(double)),
              n * n * sizeof(double), reinterpret_cast<char*>(all.data()));
  for (const Index v : {Index{0}, Index{7}, static_cast<Index>(n - 1)}) {
    const std::vector<double> row = domain.solve(Serial{}, PointSource::at(v)).doubles();
    CHECK(std::equal(row.begin(), row.end(), all.begin() + static_cast<std::ptrdiff_t>(v * n)));
  }
}

}  // namespace plexway::pairs_test
