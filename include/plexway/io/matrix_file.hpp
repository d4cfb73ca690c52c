#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace plexway::io {

/// A file that is made in pieces, in any order, perhaps by several runs: OUT.part, which gets its
/// own name when it is whole. Any thread may write and read.
///
/// All members throw Error "cannot write FILE: reason"; what was written before stays.
class PartFile {
 public:
  /// Goes on with the part of an earlier run, or begins one. `end` is how far that is worth
  /// keeping.
  PartFile(const std::filesystem::path& out, bool resume, std::uint64_t end = UINT64_MAX);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  /// Bytes from a place on.
  void write(std::uint64_t offset, std::string_view bytes);
  /// All of them, or Error.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  /// To the disk.
  void sync();
  /// To the disk, and in its place.
  void commit();
  /// The part is not needed any more.
  void remove();

  /// The name of a part of a file.
  [[nodiscard]] static std::filesystem::path path_of(const std::filesystem::path& out);

 private:
  [[noreturn]] void refused(int code) const;

  std::filesystem::path out_, path_;
  int file_ = -1;
};

/// Throws Error unless the disk of `out` has room for `bytes`, beyond what OUT.part has there.
void check_room(const std::filesystem::path& out, double bytes);

/// For people: "1.2 GB".
[[nodiscard]] std::string short_bytes(double bytes);

/// The number type of a matrix.
enum class MatrixNumber { float16, float32, float64 };
/// Throws UsageError for a name that does not exist.
[[nodiscard]] MatrixNumber matrix_number_of(std::string_view name);
/// "float16", "float32" or "float64".
[[nodiscard]] std::string_view name_of(MatrixNumber number);
/// Bytes of one: 2, 4 or 8.
[[nodiscard]] std::size_t size_of(MatrixNumber number);

/// A dense matrix on disk, written row by row in any order into its place: NumPy's .npy. Memory: a
/// row. Any thread may write, each row by one.
class MatrixFile {
 public:
  /// Throws as PartFile.
  MatrixFile(const std::filesystem::path& out, std::size_t rows, std::size_t columns,
             MatrixNumber number, bool resume);

  /// As it was made with.
  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// As it was made with.
  [[nodiscard]] std::size_t columns() const { return columns_; }
  /// Throws as PartFile, and UsageError for a finite number that gets infinite.
  template <class Real>
  void write_row(std::size_t row, std::span<const Real> values) {
    write(row, 0, values);
  }
  /// Values of a row from a column on.
  template <class Real>
  void write(std::size_t row, std::size_t column, std::span<const Real> values);
  /// Values of a row from a column on, as they were rounded.
  void read(std::size_t row, std::size_t column, std::span<double> values) const;
  /// The same as bytes, little endian: size_of(number) each.
  void read_bytes(std::size_t row, std::size_t column, std::span<char> bytes) const {
    file_.read(place(row, column), bytes);
  }
  /// To the disk.
  void sync() { file_.sync(); }
  /// To the disk, and in its place.
  void commit() { file_.commit(); }
  /// The part is not needed any more.
  void remove() { file_.remove(); }

  /// Of the whole file.
  [[nodiscard]] static double bytes(std::size_t rows, std::size_t columns, MatrixNumber number);

 private:
  [[nodiscard]] std::uint64_t place(std::size_t row, std::size_t column) const {
    return start_ + (static_cast<std::uint64_t>(row) * columns_ + column) * size_of(number_);
  }

  std::size_t rows_, columns_;
  MatrixNumber number_;
  std::uint64_t start_ = 0;
  PartFile file_;
};

/// How far a square matrix is from its own transpose.
struct Asymmetry {
  double largest = 0;       ///< difference of there and back, relative to the shorter
  double mean = 0;          ///< over all pairs that are reached both ways, and not one
  std::size_t pairs = 0;    ///< so many
  std::size_t one_way = 0;  ///< reached one way only
};

/// Looks at all pairs. Cost: reads the matrix once, in tiles.
[[nodiscard]] Asymmetry asymmetry_of(const MatrixFile& matrix);

/// Of there and back the shorter counts for both. Can be done again if it was ended half way.
void make_symmetric(MatrixFile& matrix);

}  // namespace plexway::io
