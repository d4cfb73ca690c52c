#include "shape/arguments/arguments.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include <plexway/error.hpp>

#include "io/number_rows.hpp"
#include "shape/words.hpp"

namespace plexway::detail {
namespace {

enum class MetricSyntax { tensor, vertex_tensor, speed, regions, lengths };
constexpr std::array<std::string_view, 5> metric_names = {"tensor", "vertex-tensor", "speed",
                                                          "regions", "lengths"};

struct ParsedMetric {
  MetricSyntax kind;
  std::string file;
};

ParsedMetric parse_metric(const MetricArgument& argument) {
  const std::size_t colon = argument.text.find(':');
  const std::string kind = argument.text.substr(0, colon);
  const std::string file = colon == argument.text.npos ? "" : argument.text.substr(colon + 1);
  const auto name = std::find(metric_names.begin(), metric_names.end(), kind);
  if (!file.empty() && name != metric_names.end())
    return {static_cast<MetricSyntax>(name - metric_names.begin()), file};
  throw UsageError(
      "--metric '" + argument.text +
      "': write tensor:FILE, vertex-tensor:FILE, speed:FILE, regions:FILE or lengths:FILE");
}

template <class Row>
std::vector<Row> one_each(const std::string& file, std::vector<Row> rows, std::size_t needed,
                          std::string_view what) {
  if (rows.size() != needed && rows.size() != 1)
    throw InputError(file + ": " + std::to_string(rows.size()) + " rows for " +
                     counted(needed, what) +
                     ": write one each, in the order of the input, or one for all");
  rows.resize(needed, rows[0]);
  return rows;
}

std::vector<metric::Tensor> read_tensors(const std::string& file, std::size_t needed,
                                         std::string_view what) {
  const std::string row_text =
      "xx xy xz yy yz zz a line, or xx xy yy in the plane, or a single number, the speed";
  const auto rows = io::read_number_rows(file, 1, 6, row_text);
  std::vector<metric::Tensor> tensors;
  tensors.reserve(rows.size());
  for (const io::NumberRow& row : rows) {
    const auto& n = row.numbers;
    if (n.size() == 6)
      tensors.push_back({n[0], n[1], n[2], n[3], n[4], n[5]});
    else if (n.size() == 3)
      tensors.push_back(metric::Tensor::planar(n[0], n[1], n[2]));
    else if (n.size() == 1 && n[0] > 0)
      tensors.push_back(metric::Tensor::of_speed(n[0]));
    else
      fail_at(file, row, n.size() == 1 ? "a speed must be above 0" : "write " + row_text);
  }
  return one_each(file, std::move(tensors), needed, what);
}

std::vector<double> read_speeds(const std::string& file, std::size_t needed,
                                std::string_view what) {
  const auto rows = io::read_number_rows(file, 1, 1, "one speed a line, above 0");
  std::vector<double> speeds;
  speeds.reserve(rows.size());
  for (const io::NumberRow& row : rows) {
    if (!(row.numbers[0] > 0)) fail_at(file, row, "a speed must be above 0");
    speeds.push_back(row.numbers[0]);
  }
  return one_each(file, std::move(speeds), needed, what);
}

// Of each simplex as its region in the domain's own file has it.
std::vector<double> read_region_speeds(const std::string& file, const AnyShape& domain) {
  std::map<std::int64_t, double> speed_of;
  const auto rows = io::read_number_rows(file, 2, 2, "a region and its speed a line");
  for (const io::NumberRow& row : rows) {
    const double region = row.numbers[0];
    if (region != std::floor(region) || !(std::abs(region) < 9e15))
      fail_at(file, row, "a region is a whole number");
    if (!(row.numbers[1] > 0)) fail_at(file, row, "a speed must be above 0");
    if (!speed_of.try_emplace(static_cast<std::int64_t>(region), row.numbers[1]).second)
      fail_at(file, row, "region " + short_number(region) + " has a speed already");
  }
  std::vector<double> speeds;
  for (const std::int64_t region : domain.regions()) {
    const auto found = speed_of.find(region);
    if (found == speed_of.end())
      throw InputError(file + ": no speed for region " + std::to_string(region) + " of " +
                       domain.file().string());
    speeds.push_back(found->second);
  }
  return speeds;
}

metric::GivenLengths read_lengths(const std::string& file, std::size_t vertices) {
  metric::GivenLengths given;
  std::map<std::pair<Index, Index>, const io::NumberRow*> first;
  const auto rows = io::read_number_rows(file, 3, 3, "vertex vertex length a line");
  for (const io::NumberRow& row : rows) {
    const Index a = vertex_in(file, row, 0, vertices), b = vertex_in(file, row, 1, vertices);
    const double length = row.numbers[2];
    if (length < 0) fail_at(file, row, "a length below 0");
    given.edges.push_back({a, b, length});
    const auto [known, is_new] = first.try_emplace(std::minmax(a, b), &row);
    if (!is_new && known->second->numbers[2] != length)
      fail_at(file, row,
              "the edge has another length than in line " + std::to_string(known->second->line));
  }
  return given;
}

metric::Metric read_metric(const ParsedMetric& asked, const AnyShape& domain,
                           const metric::Agreement& by) {
  switch (asked.kind) {
    case MetricSyntax::tensor:
      return metric::SimplexTensors{
          read_tensors(asked.file, domain.simplices(), domain.simplex_name()), by};
    case MetricSyntax::vertex_tensor:
      return metric::VertexTensors{read_tensors(asked.file, domain.vertices(), "vertices")};
    case MetricSyntax::speed:
      return metric::SimplexSpeeds{
          read_speeds(asked.file, domain.simplices(), domain.simplex_name()), by};
    case MetricSyntax::regions:
      return metric::SimplexSpeeds{read_region_speeds(asked.file, domain), by};
    case MetricSyntax::lengths:
      break;
  }
  return read_lengths(asked.file, domain.vertices());
}

}  // namespace

std::string metric_file(const MetricArgument& argument) {
  return argument.text.empty() ? "" : parse_metric(argument).file;
}

std::shared_ptr<const MeasuredLengths> measure(const MetricArgument& argument,
                                               const AnyShape& domain, Jumps jumps) {
  if (argument.text.empty()) return nullptr;
  const ParsedMetric asked = parse_metric(argument);
  require("--metric", support(Purpose::metrics, domain.kind()));
  const bool refracts =
      (domain.kind() == DomainKind::surface || domain.kind() == DomainKind::solid) &&
      jumps == Jumps::refract && asked.kind != MetricSyntax::vertex_tensor &&
      asked.kind != MetricSyntax::lengths;
  const metric::Metric metric =
      read_metric(asked, domain, {refracts ? metric::Sides::own : metric::Sides::mean});
  try {
    return std::make_shared<const MeasuredLengths>(domain.measure(metric));
  } catch (const InputError& error) {
    throw InputError(asked.file + ": " + error.what());
  } catch (const UsageError& error) {
    throw UsageError(std::string("--metric: ") + error.what());
  }
}

}  // namespace plexway::detail
