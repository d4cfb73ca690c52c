#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>
#include <plexway/shape/pairs.hpp>

#include "complexes/test_meshes.hpp"
#include "folder.hpp"
#include "shape/pairs/pair_files.hpp"

namespace plexway::pairs_test {
using namespace detail;

// Matrices behind the facade: rows as AnyDomain::solve has them, into files and out of order.

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

// Matrices in files, as the tool makes them: by the library alone.

namespace {

AnyShape square(Index n) {
  const meshes::Surface grid = meshes::grid(n, n);
  return AnyShape::surface(grid.positions, grid.faces);
}

// Behind the header of a .npy of float64.
std::vector<double> numbers_in(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::uint16_t header = 0;
  REQUIRE(bytes.size() > 10);
  std::memcpy(&header, bytes.data() + 8, 2);
  std::vector<double> numbers((bytes.size() - 10 - header) / 8);
  std::memcpy(numbers.data(), bytes.data() + 10 + header, 8 * numbers.size());
  return numbers;
}

PairFiles all_of(const AnyShape& domain) {
  PairFiles files;
  for (Index v = 0; v < domain.vertices(); ++v) {
    files.rows.push_back(PointSource::at(v));
    files.columns.push_back(v);
  }
  files.building = {.precision = Precision::float64, .triangulation = Triangulation::input};
  files.number = io::MatrixNumber::float64;
  return files;
}

}  // namespace

TEST_CASE("files of a matrix have the rows of solve, and what those come to") {
  const ::testing::Folder folder;
  const AnyShape domain = square(7);
  const std::size_t n = domain.vertices();
  PairFiles files = all_of(domain);
  files.matrix = folder.at("d.npy");
  files.statistics = folder.at("s.csv");
  files.histogram = folder.at("h.csv");
  files.bin_width = 0.25;
  files.bins = 4;
  std::vector<std::string> stages;
  std::size_t told = 0;
  const PairFilesProgress progress = {
      .stage = [&](std::string_view what) { stages.emplace_back(what); },
      .rows = [&](const PairsProgress& at) { told = at.rows_done; }};
  const PairFilesReport report = write_pair_files(Serial{}, domain, files, progress);
  CHECK(report.solved.rows == n);
  CHECK(told == n);
  CHECK(std::count(stages.begin(), stages.end(), "comparing there and back") == 1);

  const AnyDomain built(domain, files.building);
  const std::vector<double> matrix = numbers_in(files.matrix);
  REQUIRE(matrix.size() == n * n);
  double sum = 0, most = 0, apart = 0;
  std::size_t beyond = 0;
  for (Index v = 0; v < n; ++v) {
    const std::vector<double> row = built.solve(Serial{}, PointSource::at(v)).doubles();
    CHECK(std::equal(row.begin(), row.end(), matrix.begin() + std::ptrdiff_t(v * n)));
    for (Index w = 0; w < n; ++w) {
      const auto& p = domain.positions()[v];
      const auto& q = domain.positions()[w];
      CHECK(row[w] == Approx(std::hypot(p[0] - q[0], p[1] - q[1])).epsilon(1e-3).margin(1e-12));
      sum += row[w];
      most = std::max(most, row[w]);
      beyond += row[w] >= 0.75;
      const double back = matrix[w * n + v], less = std::min(row[w], back);
      if (less > 0) apart = std::max(apart, std::abs(row[w] - back) / less);
    }
  }
  REQUIRE(report.statistics);
  CHECK(report.statistics->diameter == most);
  CHECK(report.statistics->mean == Approx(sum / double(n * n)).epsilon(1e-12));
  CHECK(report.statistics->pairs == n * n);
  REQUIRE(report.asymmetry);
  CHECK(report.asymmetry->largest == Approx(apart).epsilon(1e-3).margin(1e-300));
  CHECK(report.asymmetry->one_way == 0);
  std::ifstream histogram(files.histogram);
  const std::string lines{std::istreambuf_iterator<char>(histogram), {}};
  CHECK(lines.find("0.75,inf," + std::to_string(beyond) + "\n") != std::string::npos);
  CHECK(folder.files() == 3);  // neither parts nor a journal
}

TEST_CASE("of the two ways the shorter counts where that is asked for") {
  const ::testing::Folder folder;
  const AnyShape domain = square(6);
  const std::size_t n = domain.vertices();
  PairFiles files = all_of(domain);
  files.solve.accuracy = Accuracy::fast();
  files.matrix = folder.at("one.npy");
  write_pair_files(Serial{}, domain, files, {});
  const std::vector<double> one = numbers_in(files.matrix);
  files.matrix = folder.at("both.npy");
  files.symmetric = true;
  write_pair_files(Serial{}, domain, files, {});
  const std::vector<double> both = numbers_in(files.matrix);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < n; ++k)
      CHECK(both[i * n + k] == std::min(one[i * n + k], one[k * n + i]));
}

TEST_CASE("files of what is near have those entries, and an estimate writes nothing") {
  const ::testing::Folder folder;
  const AnyShape domain = square(6);
  PairFiles files = all_of(domain);
  files.radius = 0.34;
  files.matrix = folder.at("near.mtx");
  const PairFilesReport guess = estimate_pair_files(Serial{}, domain, files, {});
  CHECK(guess.expected_seconds > 0);
  CHECK(folder.files() == 0);

  std::size_t entries = 0;
  for (const auto& p : domain.positions())
    for (const auto& q : domain.positions())
      entries += std::hypot(p[0] - q[0], p[1] - q[1]) <= 0.34;
  const PairFilesReport report = write_pair_files(OpenMP{.threads = 2}, domain, files, {});
  CHECK(report.entries == entries);
  CHECK(folder.files() == 1);
  CHECK_THROWS_WITH(write_pair_files(GL{}, domain, files, {}), Catch::Contains("G"));
}

TEST_CASE("what files were begun with is told from what is asked for now") {
  const ::testing::Folder folder;
  const AnyShape domain = square(12);
  PairFiles files = all_of(domain);
  files.matrix = folder.at("d.npy");
  files.block = 4;
  struct Enough {};
  const auto stop = [](const PairsProgress& at) {
    if (at.rows_done > 80) throw Enough{};
  };
  CHECK_THROWS_AS(write_pair_files(Serial{}, domain, files, {.rows = stop}), Enough);
  const auto refused = [&](PairFiles other, const std::string& text) {
    CHECK_THROWS_WITH(write_pair_files(Serial{}, domain, other, {}), Catch::Contains(text));
  };
  PairFiles other = files;
  other.building.precision = Precision::float32;
  refused(other, "'precision: double', now it is 'precision: float'");
  other = files;
  other.solve.accuracy = Accuracy(1e-3);
  refused(other, "'accuracy: usual', now it is 'accuracy: 0.001");
  other = files;
  other.building.triangulation = Triangulation::delaunay;
  refused(other, "'triangulation: input', now it is 'triangulation: delaunay'");
  other = files;
  std::swap(other.rows[0], other.rows[1]);
  refused(other, "'rows: ");
  other = files;
  other.symmetric = true;
  refused(other, "'symmetric: yes'");
  std::size_t left = 0;
  const PairFilesReport report = write_pair_files(
      Serial{}, domain, files, {.rows = [&](const PairsProgress& at) { left = at.rows; }});
  CHECK(report.resumed_blocks > 0);
  CHECK(left + 4 * report.resumed_blocks == domain.vertices());
}

}  // namespace plexway::pairs_test
