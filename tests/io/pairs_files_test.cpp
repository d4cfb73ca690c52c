#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/io/write_pairs.hpp>

#include "complexes/test_meshes.hpp"
#include "io/io_testing.hpp"
#include "io/matrix/npy.hpp"
#include "io/numbers.hpp"

namespace plexway::pairs_files_test {

namespace {

using namespace plexway::io;
namespace fs = std::filesystem;

constexpr double inf = std::numeric_limits<double>::infinity();

template <class Number>
std::vector<Number> npy_values(const std::string& bytes) {
  REQUIRE(bytes.substr(1, 5) == "NUMPY");
  std::uint16_t length = 0;
  std::memcpy(&length, bytes.data() + 8, 2);
  REQUIRE((10 + length) % 64 == 0);
  const std::string data = bytes.substr(10U + length);
  std::vector<Number> values(data.size() / sizeof(Number));
  std::memcpy(values.data(), data.data(), data.size());
  return values;
}

// Files of a stored zip by its table of contents, each with its checksum looked at.
std::map<std::string, std::string> unzip(const std::string& bytes) {
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, size);
    return value;
  };
  std::map<std::string, std::string> files;
  const std::size_t end = bytes.rfind("PK\x05\x06");
  REQUIRE(end != bytes.npos);
  std::size_t at = number(end + 16, 4);
  for (std::uint64_t k = 0; k < number(end + 10, 2); ++k) {
    REQUIRE(number(at, 4) == 0x02014b50);
    const std::size_t name_length = number(at + 28, 2), extra = at + 46 + name_length;
    const std::string name = bytes.substr(at + 46, name_length);
    const std::uint64_t size = number(extra + 12, 8), offset = number(extra + 20, 8);
    REQUIRE(number(offset, 4) == 0x04034b50);
    const std::string data =
        bytes.substr(offset + 30 + number(offset + 26, 2) + number(offset + 28, 2), size);
    Crc32 crc;
    crc.add(data);
    REQUIRE(crc.value() == number(at + 16, 4));
    files[name] = data;
    at = extra + number(at + 30, 2);
  }
  return files;
}

}  // namespace

TEST_CASE("half precision rounds to the nearest, ties to even") {
  // Every half comes back as it was, and what lies between two goes to the nearer.
  for (std::uint32_t bits = 0; bits < 0x7C00; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    const double value = from_half(half);
    REQUIRE(to_half(value) == half);
    REQUIRE(to_half(-value) == (half | 0x8000U));
    if (bits + 1 == 0x7C00) break;
    const double next = from_half(static_cast<std::uint16_t>(half + 1));
    REQUIRE(next > value);
    const double middle = (value + next) / 2;
    REQUIRE(to_half(middle) == half + (half & 1U));
    REQUIRE(to_half(std::nextafter(middle, 0.)) == half);
    REQUIRE(to_half(std::nextafter(middle, inf)) == half + 1);
  }
  CHECK(from_half(0x3C00) == 1);
  CHECK(from_half(0x7BFF) == largest_half);
  CHECK(to_half(65519.99) == 0x7BFF);
  CHECK(to_half(65520) == 0x7C00);
  CHECK(to_half(inf) == 0x7C00);
  CHECK(std::isinf(from_half(0x7C00)));
}

TEST_CASE("rows of a matrix file may come in any order and read back") {
  const ::testing::Folder folder;
  const std::vector<std::vector<double>> rows = {{0, 1.5, inf}, {0.25, 0, 3}};
  for (const auto number : {MatrixNumber::float16, MatrixNumber::float32, MatrixNumber::float64}) {
    const fs::path out = folder.at("m.npy");
    MatrixFile file(out, 2, 3, number, false);
    file.write_row<double>(1, rows[1]);
    file.write_row<double>(0, rows[0]);
    for (std::size_t r = 0; r < 2; ++r) {
      std::vector<double> back(3);
      file.read(r, 0, back);
      CHECK(back == rows[r]);
    }
    CHECK_FALSE(fs::exists(out));
    file.commit();
    CHECK(static_cast<double>(fs::file_size(out)) == MatrixFile::bytes(2, 3, number));
    const std::string header = io_testing::bytes_of(out).substr(0, 128);
    CHECK(header.find("'shape': (2, 3)") != header.npos);
    CHECK(header.find("'<f" + std::to_string(size_of(number)) + "'") != header.npos);
    CHECK(folder.files() == 1);
    fs::remove(out);
  }
  MatrixFile small(folder.at("m.npy"), 1, 1, MatrixNumber::float16, false);
  CHECK_THROWS_AS(small.write_row<double>(0, std::vector<double>{65520}), UsageError);
  MatrixFile single(folder.at("n.npy"), 1, 1, MatrixNumber::float32, false);
  CHECK_THROWS_AS(single.write_row<double>(0, std::vector<double>{1e39}), UsageError);
  CHECK_THROWS_AS(matrix_number_of("float8"), UsageError);
  CHECK_THROWS_AS(check_room(folder.at("m.npy"), 1e18), Error);
}

TEST_CASE("a matrix is told how far it is from symmetric, and made so") {
  const ::testing::Folder folder;
  const std::size_t n = 2100;  // more than two tiles
  std::mt19937 random(3);
  std::vector<std::vector<double>> rows(n, std::vector<double>(n));
  for (auto& row : rows)
    for (double& d : row) d = 1 + static_cast<double>(random() % 1024) / 1024;
  for (std::size_t i = 0; i < n; ++i) rows[i][i] = 0;
  rows[7][2000] = 4, rows[2000][7] = 1;  // the largest: 3
  rows[3][4] = inf, rows[4][3] = 2;
  rows[5][6] = rows[6][5] = inf;
  MatrixFile file(folder.at("m.npy"), n, n, MatrixNumber::float32, false);
  for (std::size_t i = 0; i < n; ++i) file.write_row<double>(i, rows[i]);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (std::isfinite(rows[i][j]) && std::isfinite(rows[j][i]))
        sum += std::abs(rows[i][j] - rows[j][i]) / std::min(rows[i][j], rows[j][i]);
  const Asymmetry found = asymmetry_of(file);
  CHECK(found.largest == 3);
  CHECK(found.one_way == 1);
  CHECK(found.pairs == n * (n - 1) / 2 - 2);
  CHECK(found.mean == Approx(sum / static_cast<double>(found.pairs)).epsilon(1e-12));
  for (int twice = 0; twice < 2; ++twice) {
    make_symmetric(file);
    std::vector<double> row(n);
    for (std::size_t i = 0; i < n; ++i) {
      file.read(i, 0, row);
      for (std::size_t j = 0; j < n; ++j) REQUIRE(row[j] == std::min(rows[i][j], rows[j][i]));
    }
  }
  CHECK(asymmetry_of(file).largest == 0);
  MatrixFile oblong(folder.at("o.npy"), 2, 3, MatrixNumber::float32, false);
  CHECK_THROWS_AS(asymmetry_of(oblong), UsageError);
}

TEST_CASE("a journal remembers finished blocks, and nothing that is not whole") {
  const ::testing::Folder folder;
  const fs::path out = folder.at("m.npy"), path = BlockJournal::path_of(out);
  const BlockJournal::Description what = {{"input", "12"}, {"radius", "3"}};
  const auto nothing = [] {};
  std::string whole;
  {
    BlockJournal journal(out, what, 5);
    CHECK_FALSE(journal.resumed());
    journal.finish(3, {10, 20}, nothing);
    journal.finish(0, {30, 5}, nothing);
    journal.flush(nothing);
    journal.note("two\nlines");
    // One run at a time.
    CHECK_THROWS_WITH(BlockJournal(out, what, 5), Catch::Contains("another run"));
    whole = io_testing::bytes_of(path);
  }
  {
    const BlockJournal journal(out, what, 5);
    CHECK(journal.resumed());
    CHECK(journal.finished() == 2);
    CHECK((journal.has(0) && journal.has(3) && !journal.has(1)));
    CHECK((journal.place(3).offset == 10 && journal.place(3).bytes == 20));
    CHECK(journal.end() == 35);
    CHECK(journal.noted() == "two lines");
    CHECK_FALSE(journal.is_complete());
  }
  CHECK_THROWS_WITH(BlockJournal(out, {{"input", "12"}, {"radius", "4"}}, 5),
                    Catch::Contains("'radius: 3', now it is 'radius: 4'"));
  CHECK_THROWS_AS(BlockJournal(out, what, 6), Error);
  CHECK(io_testing::bytes_of(path) == whole);

  // Ended at any byte: what is there counts, or it begins anew; nothing is made up.
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    BlockJournal journal(out, what, 5);
    REQUIRE(journal.finished() <= 2);
    for (const std::size_t b : {1U, 2U, 4U}) REQUIRE_FALSE(journal.has(b));
    journal.finish(4, {}, nothing);
    journal.flush(nothing);
    REQUIRE(journal.has(4));
  }
  {
    BlockJournal journal(out, what, 5);
    CHECK(journal.finished() == 3);
    journal.complete(nothing);
  }
  BlockJournal journal(out, what, 5);
  CHECK(journal.is_complete());
  journal.remove();
  CHECK(folder.files() == 0);
  {
    BlockJournal another(out, what, 5);
    another.finish(4, {}, nothing);
    another.flush(nothing);
    CHECK_THROWS_WITH(BlockJournal::discard(out), Catch::Contains("another run"));
  }
  BlockJournal::discard(out);
  BlockJournal::discard(out);  // nothing there
  CHECK(folder.files() == 0);
  folder.write("n.npy.journal", "a diary");
  CHECK_THROWS_WITH(BlockJournal::discard(folder.at("n.npy")),
                    Catch::Contains("no journal of ours"));
  CHECK_THROWS_WITH(BlockJournal(folder.at("n.npy"), what, 5),
                    Catch::Contains("no journal of ours"));
  CHECK(io_testing::bytes_of(folder.at("n.npy.journal")) == "a diary");
}

TEST_CASE("a matrix that goes on where it was has the same bytes, dense and sparse") {
  const ::testing::Folder folder;
  const auto mesh = plexway::testing::grid(12, 11).mesh<float>();
  const std::size_t n = mesh.vertex_count();
  PairsRequest request;
  request.block = 8;
  const BlockJournal::Description what = {{"mesh", "grid"}};
  // Ends by an error in row `stop`, which no run has.
  const auto run = [&](const std::string& name, std::size_t stop, int threads) {
    const fs::path out = folder.at(name);
    PairsRequest mine = request;
    mine.progress = [&](const PairsProgress& p) { return p.rows_done < stop; };
    BlockJournal journal(out, what, request.block_count(n));
    if (name.ends_with(".npy")) {
      MatrixFile file(out, n, n, MatrixNumber::float32, journal.resumed());
      write_pairs(OpenMP{.threads = threads}, mesh, mine, file, journal);
      file.commit();
    } else {
      SparseFile file(out, n, n, request.block, MatrixNumber::float64, journal);
      write_near_pairs(OpenMP{.threads = threads}, mesh, mine, {.radius = 0.31}, file, journal);
      CHECK(file.commit(journal) > n);
      file.remove();
    }
    journal.remove();
  };
  for (const std::string kind : {".npy", ".npz", ".mtx"}) {
    run("whole" + kind, n + 1, 2);
    int ended = 0;
    for (bool done = false; !done;) {
      try {
        run("parts" + kind, 12, 1);
        done = true;
      } catch (const Cancelled&) {
        REQUIRE(++ended < 100);
      }
    }
    CHECK(ended > 5);
    CHECK(io_testing::bytes_of(folder.at("parts" + kind)) ==
          io_testing::bytes_of(folder.at("whole" + kind)));
  }
  CHECK(folder.files() == 6);

  // The sparse ones are what is near in the dense one.
  const auto dense = npy_values<float>(io_testing::bytes_of(folder.at("whole.npy")));
  auto files = unzip(io_testing::bytes_of(folder.at("whole.npz")));
  CHECK(files.size() == 5);
  const auto begin = npy_values<std::int32_t>(files["indptr.npy"]);
  const auto column = npy_values<std::int32_t>(files["indices.npy"]);
  const auto value = npy_values<double>(files["data.npy"]);
  CHECK(npy_values<std::int64_t>(files["shape.npy"]) ==
        std::vector<std::int64_t>{static_cast<std::int64_t>(n), static_cast<std::int64_t>(n)});
  CHECK(files["format.npy"].ends_with("csr"));
  CHECK(files["format.npy"].find("'shape': ()") != std::string::npos);
  REQUIRE(begin.size() == n + 1);
  std::string mtx = "%%MatrixMarket matrix coordinate real general\n";
  std::ifstream text(folder.at("whole.mtx"));
  std::string line;
  std::getline(text, line);
  CHECK(line + "\n" == mtx);
  std::size_t rows = 0, columns = 0, entries = 0, i = 0, j = 0;
  double d = 0;
  text >> rows >> columns >> entries;
  CHECK((rows == n && columns == n && entries == column.size()));
  for (std::size_t r = 0; r < n; ++r) {
    std::size_t c = 0;
    for (auto e = static_cast<std::size_t>(begin[r]); e < static_cast<std::size_t>(begin[r + 1]);
         ++e, ++c) {
      for (; c < static_cast<std::size_t>(column[e]); ++c)
        REQUIRE(dense[r * n + c] > 0.31F * 0.999999F);
      REQUIRE(value[e] == Approx(static_cast<double>(dense[r * n + c])).epsilon(1e-6));
      text >> i >> j >> d;
      REQUIRE((i == r + 1 && j == c + 1 && d == value[e]));
    }
    for (; c < n; ++c) REQUIRE(dense[r * n + c] > 0.31F * 0.999999F);
  }
}

TEST_CASE("parts that are gone or cut are told") {
  const ::testing::Folder folder;
  const fs::path out = folder.at("m.npy");
  CHECK_THROWS_WITH(PartFile(out, true), Catch::Contains("is gone"));
  PartFile part(out, false);
  part.write(0, "abc");
  std::vector<char> more(4);
  CHECK_THROWS_WITH(part.read(0, more), Catch::Contains("shorter"));
  CHECK_THROWS_AS(PartFile(folder.at("no/m.npy"), false), Error);
}

}  // namespace plexway::pairs_files_test
