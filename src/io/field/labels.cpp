#include <bit>
#include <cmath>
#include <string>
#include <unordered_map>

#include <plexway/error.hpp>
#include <plexway/io/labels.hpp>
#include <plexway/io/triangles.hpp>

#include "io/field/value_source.hpp"
#include "io/file_bytes.hpp"
#include "io/names.hpp"
#include "io/number_rows.hpp"
#include "io/numbers.hpp"
#include "io/readers.hpp"

namespace plexway::io {
namespace {

std::vector<std::int64_t> read_list(const std::string& file) {
  std::vector<std::int64_t> labels;
  for (const NumberRow& row : read_number_rows(file, 1, 1, "a whole number a line, one a vertex")) {
    const double value = row.numbers[0];
    if (value != std::floor(value) || std::abs(value) > 9e15)
      fail_at(file, row, "a label is a whole number");
    labels.push_back(static_cast<std::int64_t>(value));
  }
  return labels;
}

// The number of vertices in a line, then a line each: its number, position and a value.
std::vector<std::int64_t> read_freesurfer_label(const std::string& file, std::size_t vertices) {
  const auto rows =
      read_number_rows(file, 1, 5, "the number of vertices, then a vertex, x, y, z and value each");
  if (rows.empty() || rows[0].numbers.size() != 1)
    throw InputError(file + ": is no label of FreeSurfer: the first line is not a single number");
  if (rows[0].numbers[0] != static_cast<double>(rows.size() - 1))
    throw InputError(file + ": has " + std::to_string(rows.size() - 1) +
                     " vertices, not as many as its first line says");
  std::vector<std::int64_t> labels(vertices, 0);
  for (std::size_t i = 1; i < rows.size(); ++i) labels[vertex_in(file, rows[i], 0, vertices)] = 1;
  return labels;
}

}  // namespace

std::vector<std::int64_t> read_vertex_labels(const std::filesystem::path& path,
                                             std::size_t vertices) {
  const std::string file = path.string(), extension = InputName(path).extension;
  if (extension == ".label") return read_freesurfer_label(file, vertices);
  std::vector<std::int64_t> labels;
  if (extension == ".gii") {
    for (const std::int32_t label : read_gifti_labels(path)) labels.push_back(label);
  } else if (extension == ".annot") {
    labels = read_freesurfer_annotation(path);
  } else {
    labels = read_list(file);
  }
  if (labels.size() != vertices)
    throw InputError(file + ": " + std::to_string(labels.size()) + " labels, but there are " +
                     std::to_string(vertices) + " vertices");
  return labels;
}

namespace {

class AnnotationReader : public ByteValues {
 public:
  AnnotationReader(std::string_view bytes, std::string_view name)
      : ByteValues(bytes, name, std::endian::big) {}

  std::vector<std::int64_t> read() {
    const std::size_t vertices = count(8, "vertices");
    std::vector<std::int64_t> colour(vertices, -1);
    for (std::size_t i = 0; i < vertices; ++i) {
      const std::int64_t vertex = number("a vertex");
      if (vertex < 0 || vertex >= static_cast<std::int64_t>(vertices))
        fail("has a vertex " + std::to_string(vertex) + " of " + std::to_string(vertices));
      colour[static_cast<std::size_t>(vertex)] = number("a label");
    }
    if (bytes_left() == 0 || number("a tag") == 0)
      fail("has no table of colours, so its labels have no numbers");
    read_table();
    for (std::int64_t& c : colour) {
      const auto found = number_of_.find(c);
      c = found == number_of_.end() ? -1 : found->second;
    }
    return colour;
  }

 private:
  std::int64_t number(const char* what) { return whole(NumberType::i32, what); }
  // As many as could be here, of so many bytes each at least.
  std::size_t count(std::size_t bytes, const char* what) {
    const std::int64_t n = number(what);
    if (n < 0 || static_cast<std::uint64_t>(n) * bytes > bytes_left())
      fail("should have " + std::to_string(n) + " " + what + ", but ends before");
    return static_cast<std::size_t>(n);
  }
  void skip_text() { skip(NumberType::u8, count(1, "letters"), "a name"); }

  void read_table() {
    std::int64_t entries = number("the entries of the table");
    const bool numbered = entries < 0;  // version 2 says which number each has
    if (numbered && entries != -2)
      fail("has a table of version " + std::to_string(-entries) + ", which is not read");
    if (numbered) number("the largest number");
    skip_text();  // a file
    entries = numbered ? number("the entries of the table") : entries;
    if (entries < 0 || static_cast<std::uint64_t>(entries) * 20 > bytes_left())
      fail("should have " + std::to_string(entries) + " colours, but ends before");
    for (std::int64_t i = 0; i < entries; ++i) {
      const std::int64_t of = numbered ? number("a number of the table") : i;
      skip_text();
      std::int64_t colour = 0;
      for (int shift = 0; shift < 24; shift += 8) {
        const std::int64_t part = number("a colour");
        if (part < 0 || part > 255) fail("has a colour beyond 255");
        colour += part << shift;
      }
      number("a colour");  // how transparent
      number_of_.try_emplace(colour, of);
    }
  }

  std::unordered_map<std::int64_t, std::int64_t> number_of_;
};

}  // namespace

std::vector<std::int64_t> parse_freesurfer_annotation(std::string_view bytes,
                                                      std::string_view name) {
  return AnnotationReader(bytes, name).read();
}

std::vector<std::int64_t> read_freesurfer_annotation(const std::filesystem::path& file) {
  const FileBytes bytes(file);
  return parse_freesurfer_annotation(bytes.view(), file.string());
}

}  // namespace plexway::io
