#include "shape/pairs/pair_files.hpp"

#include <algorithm>
#include <limits>

#include <plexway/error.hpp>
#include <plexway/io/labels.hpp>

#include "io/matrix/npy.hpp"
#include "io/names.hpp"
#include "io/output_file.hpp"

namespace plexway::detail {

ParcelLabels read_parcels(const std::string& file, std::size_t vertices) {
  const std::vector<std::int64_t> label = io::read_vertex_labels(file, vertices);
  ParcelLabels found;
  for (const std::int64_t l : label)
    if (l >= 0) found.labels.push_back(l);
  std::sort(found.labels.begin(), found.labels.end());
  found.labels.erase(std::unique(found.labels.begin(), found.labels.end()), found.labels.end());
  if (found.labels.empty()) throw InputError(file + ": no label is 0 or more");
  found.parcels.count = found.labels.size();
  for (const std::int64_t l : label)
    found.parcels.of.push_back(
        l < 0 ? none
              : static_cast<Index>(std::lower_bound(found.labels.begin(), found.labels.end(), l) -
                                   found.labels.begin()));
  return found;
}

void ParcelLabels::take(std::vector<PointSource>& rows, const std::vector<Index>& columns,
                        const std::string& file) {
  const std::vector<Index> of_vertex = std::move(parcels.of);
  std::vector<PointSource> labelled;
  for (const PointSource& row : rows) {
    if (row.vertex == none)
      throw InputError(file + ": labels are of vertices, and one of --sources is none");
    if (of_vertex[row.vertex] == none) continue;
    labelled.push_back(row);
    of_row.push_back(of_vertex[row.vertex]);
  }
  if (labelled.empty()) throw InputError(file + ": none of --sources has a label");
  rows = std::move(labelled);
  parcels.of.clear();
  for (const Index v : columns) parcels.of.push_back(of_vertex[v]);
}

void write_parcels(const std::string& out, const io::MatrixFile& rows,
                   const ParcelLabels& parcels) {
  const std::size_t count = parcels.labels.size();
  std::vector<double> mean(count * count, 0), row(count);
  std::vector<std::size_t> size(count, 0);
  for (std::size_t r = 0; r < rows.rows(); ++r) {
    rows.read(r, 0, row);
    const std::size_t p = parcels.of_row[r];
    ++size[p];
    for (std::size_t q = 0; q < count; ++q) mean[p * count + q] += row[q];
  }
  for (std::size_t p = 0; p < count; ++p)
    for (std::size_t q = 0; q < count; ++q)
      mean[p * count + q] = size[p] > 0 ? mean[p * count + q] / static_cast<double>(size[p])
                                        : std::numeric_limits<double>::infinity();
  io::OutputFile file(out);
  const bool csv = io::lower_extension(out) == ".csv";
  if (csv) {
    file.write("label,");
    file.write_row(parcels.labels, ",");
    file.write("\n");
  } else {
    file.write(io::npy_header("'<f8'", std::to_string(count) + ", " + std::to_string(count)));
  }
  for (std::size_t p = 0; p < count; ++p) {
    const std::span<const double> means = std::span(mean).subspan(p * count, count);
    if (!csv) {
      for (const double m : means) file.write_binary(m);
      continue;
    }
    file.write(parcels.labels[p], ",");
    file.write_row(means, ",");
    file.write("\n");
  }
  file.commit();
}

StatisticsSummary write_statistics(const std::string& stats, const std::string& histogram,
                                   double width, const io::MatrixFile& rows,
                                   std::span<const PointSource> sources,
                                   std::span<const Index> columns) {
  StatisticsSummary summary;
  summary.radius = std::numeric_limits<double>::infinity();
  std::vector<double> row(rows.columns()), counts(rows.columns() - 4, 0);
  double sum = 0;
  std::size_t pairs = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t r = 0; r < rows.rows(); ++r) {
      rows.read(r, 0, row);
      visit(r);
    }
  };
  const auto vertex_of = [&](double column) {
    return column < 0 ? std::int64_t{-1} : std::int64_t{columns[static_cast<std::size_t>(column)]};
  };
  each([&](std::size_t r) {
    for (std::size_t b = 0; b < counts.size(); ++b) counts[b] += row[4 + b];
    pairs += static_cast<std::size_t>(row[0]);
    sum += row[0] * row[1];
    if (row[0] == 0) return;
    summary.radius = std::min(summary.radius, row[2]);
    if (!(row[2] > summary.diameter)) return;
    summary.diameter = row[2];
    summary.from = r;
    summary.to = static_cast<std::size_t>(vertex_of(row[3]));
  });
  summary.pairs = pairs;
  summary.mean = pairs > 0 ? sum / static_cast<double>(pairs) : 0;
  if (!stats.empty()) {
    io::OutputFile file(stats);
    file.write("row,vertex,reached,mean,largest,farthest\n");
    each([&](std::size_t r) {
      const Index vertex = sources[r].vertex;
      file.write(r, ",", vertex == none ? std::int64_t{-1} : std::int64_t{vertex}, ",",
                 static_cast<std::size_t>(row[0]), ",", row[1], ",", row[2], ",", vertex_of(row[3]),
                 "\n");
    });
    file.commit();
  }
  if (!histogram.empty()) {
    io::OutputFile file(histogram);
    file.write("from,to,count\n");
    for (std::size_t b = 0; b < counts.size(); ++b)
      file.write(static_cast<double>(b) * width, ",",
                 b + 1 < counts.size() ? static_cast<double>(b + 1) * width
                                       : std::numeric_limits<double>::infinity(),
                 ",", static_cast<std::uint64_t>(counts[b]), "\n");
    file.commit();
  }
  return summary;
}

}  // namespace plexway::detail
