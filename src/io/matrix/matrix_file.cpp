#include <plexway/io/matrix_file.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <plexway/error.hpp>

#include "io/matrix/npy.hpp"
#include "io/numbers.hpp"

namespace plexway::io {
namespace {

constexpr std::array<std::string_view, 3> names = {"float16", "float32", "float64"};

std::string header_of(std::size_t rows, std::size_t columns, MatrixNumber number) {
  constexpr std::array<std::string_view, 3> descr = {"'<f2'", "'<f4'", "'<f8'"};
  return npy_header(descr[static_cast<std::size_t>(number)],
                    std::to_string(rows) + ", " + std::to_string(columns));
}

template <class Number>
char* put(char* to, Number number) {
  const auto bytes = little_endian(number);
  return std::copy(bytes.begin(), bytes.end(), to);
}

[[noreturn]] void too_large(std::size_t row, double value, const char* type, double most) {
  throw UsageError("row " + std::to_string(row) + ": a distance of " + std::to_string(value) +
                   " does not fit into " + type + ", which ends at " + std::to_string(most) +
                   ": choose a wider type");
}

}  // namespace

MatrixNumber matrix_number_of(std::string_view name) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<MatrixNumber>(i);
  throw UsageError("the numbers of a matrix are float16, float32 or float64, not '" +
                   std::string(name) + "'");
}
std::string_view name_of(MatrixNumber number) { return names[static_cast<std::size_t>(number)]; }
std::size_t size_of(MatrixNumber number) {
  return std::size_t{2} << static_cast<std::size_t>(number);
}

double MatrixFile::bytes(std::size_t rows, std::size_t columns, MatrixNumber number) {
  return static_cast<double>(rows) * static_cast<double>(columns) *
             static_cast<double>(size_of(number)) +
         static_cast<double>(header_of(rows, columns, number).size());
}

MatrixFile::MatrixFile(const std::filesystem::path& out, std::size_t rows, std::size_t columns,
                       MatrixNumber number, bool resume)
    : rows_(rows), columns_(columns), number_(number), file_(out, resume) {
  const std::string header = header_of(rows, columns, number);
  start_ = header.size();
  file_.write(0, header);
}

template <class Real>
void MatrixFile::write(std::size_t row, std::size_t column, std::span<const Real> values) {
  std::vector<char> bytes(values.size() * size_of(number_));
  char* to = bytes.data();
  switch (number_) {
    case MatrixNumber::float16:
      for (const Real value : values) {
        const std::uint16_t half = to_half(static_cast<double>(value));
        if (half == 0x7C00U && std::isfinite(value))
          too_large(row, static_cast<double>(value), "float16", largest_half);
        to = put(to, half);
      }
      break;
    case MatrixNumber::float32:
      for (const Real value : values) {
        if (std::isfinite(value) && !fits_float(static_cast<double>(value)))
          too_large(row, static_cast<double>(value), "float32",
                    static_cast<double>(std::numeric_limits<float>::max()));
        to = put(to, static_cast<float>(value));
      }
      break;
    case MatrixNumber::float64:
      for (const Real value : values) to = put(to, static_cast<double>(value));
      break;
  }
  file_.write(place(row, column), {bytes.data(), bytes.size()});
}

void MatrixFile::read(std::size_t row, std::size_t column, std::span<double> values) const {
  std::vector<char> bytes(values.size() * size_of(number_));
  read_bytes(row, column, bytes);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* const from = bytes.data() + i * size_of(number_);
    constexpr auto little = std::endian::little;
    switch (number_) {
      case MatrixNumber::float16:
        values[i] = from_half(load<std::uint16_t>(from, little));
        break;
      case MatrixNumber::float32:
        values[i] = static_cast<double>(load<float>(from, little));
        break;
      case MatrixNumber::float64:
        values[i] = load<double>(from, little);
        break;
    }
  }
}

template void MatrixFile::write(std::size_t, std::size_t, std::span<const float>);
template void MatrixFile::write(std::size_t, std::size_t, std::span<const double>);

namespace {

constexpr std::size_t tile = 1024;

// Calls visit(i, j, tile at i j, tile at j i), row by row in each, for all tiles with i <= j. With
// i = j both are read.
template <class Visit>
void each_pair_of_tiles(const MatrixFile& matrix, const Visit& visit) {
  const std::size_t n = matrix.rows();
  std::vector<double> one, other;
  const auto read = [&](std::size_t row, std::size_t column, std::vector<double>& values) {
    const std::size_t rows = std::min(tile, n - row), columns = std::min(tile, n - column);
    values.resize(rows * columns);
    for (std::size_t r = 0; r < rows; ++r)
      matrix.read(row + r, column, std::span(values).subspan(r * columns, columns));
  };
  for (std::size_t i = 0; i < n; i += tile)
    for (std::size_t j = i; j < n; j += tile) {
      read(i, j, one);
      read(j, i, other);
      visit(i, j, one, other);
    }
}

void require_square(const MatrixFile& matrix) {
  if (matrix.rows() != matrix.columns())
    throw UsageError("a matrix of " + std::to_string(matrix.rows()) + " rows and " +
                     std::to_string(matrix.columns()) + " columns has no symmetry");
}

}  // namespace

Asymmetry asymmetry_of(const MatrixFile& matrix) {
  require_square(matrix);
  const std::size_t n = matrix.rows();
  Asymmetry found;
  double sum = 0;
  each_pair_of_tiles(matrix, [&](std::size_t i, std::size_t j, const std::vector<double>& one,
                                 const std::vector<double>& other) {
    const std::size_t rows = std::min(tile, n - i), columns = std::min(tile, n - j);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = i == j ? r + 1 : 0; c < columns; ++c) {
        const double there = one[r * columns + c], back = other[c * rows + r];
        const bool a = std::isfinite(there), b = std::isfinite(back);
        found.one_way += a != b;
        if (!a || !b) continue;
        ++found.pairs;
        const double least = std::min(there, back);
        const double differ = least > 0 ? std::abs(there - back) / least : 0;
        sum += differ;
        found.largest = std::max(found.largest, differ);
      }
  });
  found.mean = found.pairs > 0 ? sum / static_cast<double>(found.pairs) : 0;
  return found;
}

void make_symmetric(MatrixFile& matrix) {
  require_square(matrix);
  const std::size_t n = matrix.rows();
  each_pair_of_tiles(matrix, [&](std::size_t i, std::size_t j, std::vector<double>& one,
                                 std::vector<double>& other) {
    const std::size_t rows = std::min(tile, n - i), columns = std::min(tile, n - j);
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c) {
        double &there = one[r * columns + c], &back = other[c * rows + r];
        there = back = std::min(there, back);
      }
    for (std::size_t r = 0; r < rows; ++r)
      matrix.write<double>(i + r, j, std::span(one).subspan(r * columns, columns));
    if (i == j) return;
    for (std::size_t r = 0; r < columns; ++r)
      matrix.write<double>(j + r, i, std::span(other).subspan(r * rows, rows));
  });
}

}  // namespace plexway::io
