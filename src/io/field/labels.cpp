#include <plexway/io/labels.hpp>

#include <cmath>
#include <string>

#include <plexway/error.hpp>
#include <plexway/io/triangles.hpp>

#include "io/input_name.hpp"
#include "io/number_rows.hpp"
#include "io/surface/freesurfer_labels.hpp"

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

}  // namespace plexway::io
