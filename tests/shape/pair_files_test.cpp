// Matrices in files, as the tool makes them: by the library alone.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <plexway/error.hpp>

#include "complexes/test_meshes.hpp"
#include "folder.hpp"
#include "shape/pairs/pair_files.hpp"

namespace plexway::pair_files_test {

namespace {

namespace meshes = plexway::testing;

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

}  // namespace plexway::pair_files_test
