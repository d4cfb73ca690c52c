#include "shape/info/info_report.hpp"

#include "shape/merge.hpp"

#include <algorithm>

namespace plexway {
namespace {

std::string point_text(const std::array<double, 3>& point) {
  std::string text;
  for (const double x : point) text.append(text.empty() ? "(" : ", ").append(short_number(x));
  return text.append(")");
}

}  // namespace

void add_file_report(const AnyShape& domain, Json& json, Table& table) {
  const io::FileReport& report = domain.report();
  json["split_polygons"] = report.split_polygons;
  json["split_cells"] = report.split_cells;
  json["dropped_simplices"] = domain.collapsed().size();
  json["merged_vertices"] = domain.merged_count();
  json["passed_over"] = Json::object();
  for (const auto& [what, count] : report.passed_over) json["passed_over"][what] = count;
  std::string split;
  if (report.split_polygons > 0)
    split = counted(report.split_polygons, "polygons") + " into triangles";
  if (report.split_cells > 0)
    split +=
        (split.empty() ? "" : ", ") + counted(report.split_cells, "cells") + " into tetrahedra";
  if (!split.empty()) table.add("split", split);
  if (!report.passed_over.empty()) table.add("passed over", report.passed_over_text());
  if (const std::size_t merged = domain.merged_count(); merged > 0)
    table.add("merged", counted(merged, "vertices") + (merged == 1 ? " is" : " are") +
                            " one with an earlier one within " +
                            short_number(domain.merge_tolerance()));
  if (!domain.collapsed().empty()) table.add("dropped", collapsed_sentence(domain));
}

Json to_json(const Bounds& box) { return {{"min", box.low}, {"max", box.high}}; }

Json to_json(const Spread& spread) {
  return {{"min", json_number(spread.min)},
          {"mean", json_number(spread.mean)},
          {"max", json_number(spread.max)}};
}

std::string to_text(const Bounds& box) {
  return point_text(box.low) + " to " + point_text(box.high);
}

std::string to_text(const Spread& spread) {
  return "min " + short_number(spread.min) + ", mean " + short_number(spread.mean) + ", max " +
         short_number(spread.max);
}

Json sizes_json(const std::vector<std::size_t>& sizes) {
  constexpr std::size_t most = 100;
  return Json(std::vector<std::size_t>(
      sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(std::min(most, sizes.size()))));
}

void add_sizes(Table& table, const std::vector<std::size_t>& sizes) {
  if (sizes.size() < 2) return;
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sizes.size()); ++i)
    text.append(i == 0 ? "" : ", ").append(std::to_string(sizes[i]));
  table.add("components", text + (sizes.size() > most ? ", ... vertices" : " vertices"));
}

}  // namespace plexway
