// Matrices as HDF5 files, read back by HDF5's own functions.

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <io/hdf5/include/plexway/hdf5/matrix.hpp>
#include <plexway/error.hpp>

#include "io/io_testing.hpp"
#include "io/numbers.hpp"

namespace matrix_test {

using io_testing::bytes_of;
using io_testing::Folder;
using plexway::hdf5::Matrix;
using plexway::hdf5::write_matrix;
namespace fs = std::filesystem;

namespace {

// The bytes of a matrix, row by row.
struct Numbers {
  std::size_t rows, columns, size;
  std::string bytes;

  [[nodiscard]] Matrix matrix() const {
    return {.rows = rows,
            .columns = columns,
            .number_bytes = size,
            .read = [this](std::size_t row, std::size_t column, std::span<char> to) {
              REQUIRE((row * columns + column) * size + to.size() <= bytes.size());
              REQUIRE(column * size + to.size() <= columns * size);
              std::memcpy(to.data(), bytes.data() + (row * columns + column) * size, to.size());
            }};
  }
};

double value_of(std::size_t i) {
  return i % 97 == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(i % 1009) / 8;
}

// All of which every size of number has.
Numbers numbers(std::size_t rows, std::size_t columns, std::size_t size) {
  Numbers made{rows, columns, size, {}};
  const auto put = [&](const auto& number) {
    made.bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  };
  for (std::size_t i = 0; i < rows * columns; ++i) {
    if (size == 2) put(plexway::io::to_half(value_of(i)));
    if (size == 4) put(static_cast<float>(value_of(i)));
    if (size == 8) put(value_of(i));
  }
  return made;
}

template <class Number>
std::vector<Number> read_set(const fs::path& file, const char* name, hid_t type) {
  const hid_t in = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  REQUIRE(in >= 0);
  const hid_t set = H5Dopen2(in, name, H5P_DEFAULT);
  REQUIRE(set >= 0);
  const hid_t space = H5Dget_space(set);
  std::vector<Number> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  CHECK(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0);
  H5Sclose(space);
  H5Dclose(set);
  H5Fclose(in);
  return values;
}

}  // namespace

TEST_CASE("matrices in HDF5 read back as they were, of any shape and number") {
  const Folder folder;
  const fs::path file = folder.at("d.h5");
  for (const std::size_t size : {2, 4, 8})
    for (const auto& [rows, columns] : std::vector<std::pair<std::size_t, std::size_t>>{
             {1, 1}, {1, 5}, {7, 3}, {33, 2049}, {100, 2048}, {64, 4100}, {2, 70'000}}) {
      INFO(rows << " x " << columns << " of " << size);
      const Numbers made = numbers(rows, columns, size);
      write_matrix(file, made.matrix());
      const auto back = read_set<double>(file, "/distance", H5T_NATIVE_DOUBLE);
      REQUIRE(back.size() == rows * columns);
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < back.size(); ++i) wrong += back[i] != value_of(i);
      CHECK(wrong == 0);
    }
  CHECK(folder.files() == 1);
}

TEST_CASE("matrices in HDF5 keep every bit of random numbers, and the names of rows and columns") {
  const Folder folder;
  const fs::path file = folder.at("d.h5");
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(0, 1e6F);
  std::vector<float> values(150 * 3000);
  for (float& value : values) value = any(random);
  Numbers made{150, 3000, 4, {}};
  made.bytes.assign(reinterpret_cast<const char*>(values.data()), 4 * values.size());
  Matrix matrix = made.matrix();
  std::vector<std::int64_t> rows(150), columns(3000);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = std::int64_t{1} << (i % 60);
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = 7 - static_cast<std::int64_t>(i);
  matrix.row_names = rows;
  matrix.column_names = columns;
  write_matrix(file, matrix);
  CHECK(read_set<float>(file, "/distance", H5T_NATIVE_FLOAT) == values);
  CHECK(read_set<std::int64_t>(file, "/rows", H5T_NATIVE_INT64) == rows);
  CHECK(read_set<std::int64_t>(file, "/columns", H5T_NATIVE_INT64) == columns);

  // The same file again, with any number of threads and at another time.
  const std::string bytes = bytes_of(file);
  if (plexway::openmp_built())
    for (const int threads : {1, 3, 8}) {
      write_matrix(file, matrix, {.threads = threads});
      CHECK(bytes_of(file) == bytes);
    }
}

TEST_CASE("what compresses gets smaller, and is kept as chunks with HDF5's filters") {
  const Folder folder;
  const fs::path file = folder.at("d.h5");
  Numbers made{500, 2000, 4, std::string(500 * 2000 * 4, '\0')};
  for (std::size_t i = 0; i < 500 * 2000; ++i) {
    const float value = static_cast<float>(i % 2000) / 64;
    std::memcpy(made.bytes.data() + 4 * i, &value, 4);
  }
  write_matrix(file, made.matrix());
  CHECK(fs::file_size(file) < made.bytes.size() / 10);
  const hid_t in = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t set = H5Dopen2(in, "/distance", H5P_DEFAULT);
  const hid_t properties = H5Dget_create_plist(set);
  CHECK(H5Pget_layout(properties) == H5D_CHUNKED);
  CHECK(H5Pget_nfilters(properties) == 2);
  hsize_t chunk[2] = {};
  CHECK(H5Pget_chunk(properties, 2, chunk) == 2);
  CHECK(chunk[0] == 32);
  CHECK(chunk[1] == 2000);
  H5Pclose(properties);
  H5Dclose(set);
  H5Fclose(in);
}

TEST_CASE("a matrix in HDF5 that cannot be written leaves what was there, and says why") {
  const Folder folder;
  const fs::path file = folder.write("d.h5", "old");
  const Numbers made = numbers(40, 30, 4);
  Matrix failing = made.matrix();
  failing.read = [](std::size_t row, std::size_t, std::span<char>) {
    if (row > 20) throw plexway::Error("no such row");
  };
  CHECK_THROWS_WITH(write_matrix(file, failing), "no such row");
  CHECK(bytes_of(file) == "old");
  CHECK_THROWS_AS(write_matrix(file, {.rows = 0, .columns = 3, .read = {}}), plexway::UsageError);
  CHECK_THROWS_AS(write_matrix(file, {.rows = 2, .columns = 3, .number_bytes = 3, .read = {}}),
                  plexway::UsageError);
  CHECK_THROWS_WITH(write_matrix(folder.at("no/d.h5"), made.matrix()),
                    Catch::Contains("cannot write") && Catch::Contains("No such file"));
  CHECK(bytes_of(file) == "old");
  CHECK(folder.files() == 1);
}

TEST_CASE("a disk that gets full under HDF5 is told, whatever was being written") {
  std::mt19937 random(6);
  Numbers made{300, 1000, 8, {}};
  for (std::size_t i = 0; i < 300'000; ++i) {
    const double value = std::generate_canonical<double, 53>(random);
    made.bytes.append(reinterpret_cast<const char*>(&value), 8);
  }
  const Folder folder;
  const fs::path whole = folder.at("whole.h5");
  write_matrix(whole, made.matrix());
  const auto size = fs::file_size(whole);
  // In a process of its own, as the limit stays. At the end it is metadata that has no room.
  for (const auto limit :
       {std::uintmax_t{100}, std::uintmax_t{3000}, size / 2, size - 3000, size - 300, size - 1}) {
    INFO(limit << " of " << size);
    const fs::path file = folder.at("d.h5"), told = folder.at("told.txt");
    fs::remove(file);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      std::signal(SIGXFSZ, SIG_IGN);
      std::string text = "written";
      const rlimit most = {limit, limit};
      ::setrlimit(RLIMIT_FSIZE, &most);
      try {
        write_matrix(file, made.matrix(), {.threads = 1});
      } catch (const std::exception& error) {
        text = error.what();
      }
      const rlimit enough = {1'000'000, 1'000'000};
      ::setrlimit(RLIMIT_FSIZE, &enough);
      std::FILE* const out = std::fopen(told.c_str(), "w");
      std::fputs(text.substr(0, 99).c_str(), out);
      std::fclose(out);
      std::exit(0);  // with what HDF5 does at the end
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(bytes_of(told) == "cannot write " + file.string() + ": File too large");
    CHECK_FALSE(fs::exists(file));
  }
}

}  // namespace matrix_test
