#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <plexway/io/block_journal.hpp>
#include <plexway/io/matrix_file.hpp>

namespace plexway::io {

/// An entry of a row: its column, and a number.
struct SparseEntry {
  /// Counted from 0.
  std::uint32_t column;
  /// Rounded as the file's numbers are.
  double value;
};

/// A sparse matrix on disk, written row by row in any order: .npz as scipy.sparse.load_npz reads it
/// (CSR, not compressed) or .mtx (Matrix Market). Rows gather in a block, and blocks in OUT.part,
/// as they come; the matrix is made of that at the end. Zeros that are entries stay entries.
/// Memory: the blocks that are open, and 8 bytes a row at the end.
class SparseFile {
 public:
  /// Goes on from the blocks of the journal. Throws as PartFile, UsageError for another extension
  /// or for float16, which no sparse matrix of scipy has.
  SparseFile(const std::filesystem::path& out, std::size_t rows, std::size_t columns,
             std::size_t block, MatrixNumber number, const BlockJournal& journal);

  /// Entries ascending by column. Any thread may write, each row by one.
  void write_row(std::size_t row, std::span<const SparseEntry> entries);
  /// All rows of a block were written. One call at a time. Where it stands is for the journal.
  BlockJournal::Place finish_block(std::size_t block);
  /// Flushes what was written so far to the disk.
  void sync() { file_.sync(); }
  /// Makes the matrix of all blocks, which the journal must have, and puts it in its place. The
  /// part stays. Returns the number of entries.
  std::uint64_t commit(const BlockJournal& journal);
  /// The part is not needed any more.
  void remove() { file_.remove(); }

  /// The extensions it knows, with the dot, in lower case.
  [[nodiscard]] static std::span<const std::string_view> extensions();

 private:
  template <class Visit>
  void each_row(const BlockJournal& journal, const Visit& visit) const;
  void write_npz(const BlockJournal& journal, const std::vector<std::uint64_t>& begin) const;
  void write_mtx(const BlockJournal& journal, std::uint64_t entries) const;

  std::filesystem::path out_;
  std::size_t rows_, columns_, block_;
  MatrixNumber number_;
  PartFile file_;
  std::uint64_t end_;
  std::mutex mutex_;
  std::map<std::size_t, std::vector<std::string>> open_;  // rows by block
};

}  // namespace plexway::io
