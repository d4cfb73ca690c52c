#include <plexway/io/sparse_file.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <plexway/error.hpp>

#include "io/matrix/npy.hpp"
#include "io/names.hpp"
#include "io/output_file.hpp"

namespace plexway::io {
namespace {

constexpr std::array<std::string_view, 2> known = {".npz", ".mtx"};

template <class Number>
void append(std::string& text, Number number) {
  const auto bytes = little_endian(number);
  text.append(bytes.data(), bytes.size());
}

}  // namespace

std::span<const std::string_view> SparseFile::extensions() { return known; }

// A row in the part: how many entries, their columns, their values.
SparseFile::SparseFile(const std::filesystem::path& out, std::size_t rows, std::size_t columns,
                       std::size_t block, MatrixNumber number, const BlockJournal& journal)
    : out_(out),
      rows_(rows),
      columns_(columns),
      block_(block),
      number_(number),
      file_(out, journal.resumed(), journal.end()),
      end_(journal.end()) {
  const std::string extension = lower_extension(out);
  if (std::find(known.begin(), known.end(), extension) == known.end())
    throw UsageError(unknown_extension(out, known));
  if (number == MatrixNumber::float16)
    throw UsageError("a sparse matrix is of float32 or float64: scipy has none of float16");
}

void SparseFile::write_row(std::size_t row, std::span<const SparseEntry> entries) {
  std::string bytes;
  bytes.reserve(4 + entries.size() * (4 + size_of(number_)));
  append(bytes, static_cast<std::uint32_t>(entries.size()));
  for (const SparseEntry& entry : entries) append(bytes, entry.column);
  for (const SparseEntry& entry : entries) {
    if (number_ == MatrixNumber::float64) {
      append(bytes, entry.value);
      continue;
    }
    if (!fits_float(entry.value))
      throw UsageError("row " + std::to_string(row) + ": a distance of " +
                       std::to_string(entry.value) +
                       " does not fit into float32: choose a wider type");
    append(bytes, static_cast<float>(entry.value));
  }
  const std::scoped_lock lock(mutex_);
  std::vector<std::string>& rows = open_[row / block_];
  if (rows.empty()) rows.resize(std::min(block_, rows_ - row / block_ * block_));
  rows[row % block_] = std::move(bytes);
}

BlockJournal::Place SparseFile::finish_block(std::size_t block) {
  std::string bytes;
  {
    const std::scoped_lock lock(mutex_);
    for (const std::string& row : open_.at(block)) bytes += row;
    open_.erase(block);
  }
  file_.write(end_, bytes);
  const BlockJournal::Place place{end_, bytes.size()};
  end_ += bytes.size();
  return place;
}

// Calls visit(row, columns, values), all as bytes, in order of the rows.
template <class Visit>
void SparseFile::each_row(const BlockJournal& journal, const Visit& visit) const {
  std::vector<char> bytes;
  const auto torn = [&] {
    throw Error("cannot go on with " + out_.string() + ": " + PartFile::path_of(out_).string() +
                " is not what its journal says; remove both to begin anew");
  };
  for (std::size_t b = 0; b < journal.blocks(); ++b) {
    const BlockJournal::Place place = journal.place(b);
    bytes.resize(place.bytes);
    file_.read(place.offset, bytes);
    std::string_view rest(bytes.data(), bytes.size());
    for (std::size_t row = b * block_; row < std::min((b + 1) * block_, rows_); ++row) {
      if (rest.size() < 4) torn();
      const std::size_t count = load<std::uint32_t>(rest.data(), std::endian::little);
      rest.remove_prefix(4);
      if (rest.size() / (4 + size_of(number_)) < count) torn();
      visit(row, rest.substr(0, 4 * count), rest.substr(4 * count, size_of(number_) * count));
      rest.remove_prefix((4 + size_of(number_)) * count);
    }
    if (!rest.empty()) torn();
  }
}

std::uint64_t SparseFile::commit(const BlockJournal& journal) {
  if (journal.finished() != journal.blocks())
    throw Error("cannot write " + out_.string() + ": blocks are missing");
  std::vector<std::uint64_t> begin(rows_ + 1, 0);
  each_row(journal, [&](std::size_t row, std::string_view columns, std::string_view) {
    begin[row + 1] = columns.size() / 4;
  });
  for (std::size_t row = 0; row < rows_; ++row) begin[row + 1] += begin[row];
  if (lower_extension(out_) == ".npz")
    write_npz(journal, begin);
  else
    write_mtx(journal, begin.back());
  return begin.back();
}

void SparseFile::write_npz(const BlockJournal& journal,
                           const std::vector<std::uint64_t>& begin) const {
  const std::uint64_t entries = begin.back();
  // scipy wants both index arrays of one type.
  const bool wide = std::max<std::uint64_t>(entries, columns_) >
                    static_cast<std::uint64_t>(std::numeric_limits<std::int32_t>::max());
  const std::uint64_t index = wide ? 8 : 4;
  const std::string_view index_type = wide ? "'<i8'" : "'<i4'";
  const auto add_index = [&](std::string& text, std::uint64_t number) {
    if (wide)
      append(text, static_cast<std::int64_t>(number));
    else
      append(text, static_cast<std::int32_t>(number));
  };
  const auto add_indices = [&](std::string& text, std::string_view columns) {
    text.clear();
    for (std::size_t i = 0; i < columns.size(); i += 4)
      add_index(text, load<std::uint32_t>(columns.data() + i, std::endian::little));
  };
  const std::string shape_of_entries = std::to_string(entries) + ",";
  const std::string data_head =
      npy_header(number_ == MatrixNumber::float64 ? "'<f8'" : "'<f4'", shape_of_entries);
  const std::string indices_head = npy_header(index_type, shape_of_entries);
  std::string indptr = npy_header(index_type, std::to_string(begin.size()) + ",");
  for (const std::uint64_t b : begin) add_index(indptr, b);
  std::string shape = npy_header("'<i8'", "2,");
  append(shape, static_cast<std::int64_t>(rows_));
  append(shape, static_cast<std::int64_t>(columns_));
  const std::string format = npy_header("'|S3'", "") + "csr";

  Crc32 data_crc, indices_crc;
  data_crc.add(data_head);
  indices_crc.add(indices_head);
  std::string text;
  each_row(journal, [&](std::size_t, std::string_view columns, std::string_view values) {
    data_crc.add(values);
    add_indices(text, columns);
    indices_crc.add(text);
  });

  check_room(out_, static_cast<double>(journal.end() + entries * (index + size_of(number_)) +
                                       indptr.size()));
  OutputFile out(out_);
  StoredZip zip(out);
  const auto whole = [&](std::string_view name, const std::string& bytes) {
    Crc32 crc;
    crc.add(bytes);
    zip.begin_file(name, bytes.size(), crc.value());
    zip.write(bytes);
  };
  zip.begin_file("indices.npy", indices_head.size() + entries * index, indices_crc.value());
  zip.write(indices_head);
  each_row(journal, [&](std::size_t, std::string_view columns, std::string_view) {
    add_indices(text, columns);
    zip.write(text);
  });
  whole("indptr.npy", indptr);
  whole("format.npy", format);
  whole("shape.npy", shape);
  zip.begin_file("data.npy", data_head.size() + entries * size_of(number_), data_crc.value());
  zip.write(data_head);
  each_row(journal,
           [&](std::size_t, std::string_view, std::string_view values) { zip.write(values); });
  zip.finish();
  out.commit();
}

void SparseFile::write_mtx(const BlockJournal& journal, std::uint64_t entries) const {
  OutputFile out(out_);
  out.write("%%MatrixMarket matrix coordinate real general\n", rows_, " ", columns_, " ", entries,
            "\n");
  each_row(journal, [&](std::size_t row, std::string_view columns, std::string_view values) {
    for (std::size_t i = 0; i < columns.size() / 4; ++i) {
      out.write(row + 1, " ",
                load<std::uint32_t>(columns.data() + 4 * i, std::endian::little) + 1ULL, " ");
      if (number_ == MatrixNumber::float64)
        out.write(load<double>(values.data() + 8 * i, std::endian::little), "\n");
      else
        out.write(load<float>(values.data() + 4 * i, std::endian::little), "\n");
    }
  });
  out.commit();
}

}  // namespace plexway::io
