#include <plexway/cloud/point_cloud.hpp>
#include <plexway/surface/smoothing.hpp>

#include "shape/info/info_report.hpp"
#include "shape/simplex_edges.hpp"
#include "shape/warnings/sentences.hpp"
#include "shape/words.hpp"

namespace plexway {
namespace {

std::vector<std::string> cloud_warnings(const CloudShape& cloud, const CloudSummary& summary,
                                        double noise) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::size_t count, std::string_view plural, const char* meaning) {
    if (count > 0) warnings.push_back(counted(count, plural) + meaning);
  };
  if (summary.components > 1)
    warnings.push_back(why_disconnected(cloud, summary.components, Reader::tool));
  warn(summary.isolated_points, "points", " connected to no other, so they get inf");
  warn(cloud.not_finite, "points", " not finite, and dropped: vertices count those that are left");
  warn(summary.duplicates - summary.near_duplicates, "points",
       " exactly where an earlier one lies: they count as that one");
  warn(summary.near_duplicates, "points",
       " much nearer to an earlier one than all others are: they count as that one");
  if (!cloud.points.normals.empty() && cloud.normals().empty())
    warnings.push_back(
        "normals that do not all point to one side, or are 0: they are estimated instead");
  if (noise >= SmoothOptions{}.least_noise && cloud.smoothed.empty())
    warnings.push_back("noise of " + short_number(noise) +
                       " spacings may make paths too long: --smooth takes it out, and detail of "
                       "that size with it");
  return warnings;
}

}  // namespace

InfoReport info_of(const AnyShape& domain, const CloudShape& cloud) {
  const AnyDomain built = measured_domain(domain);
  const CloudSummary& summary = *built.cloud();
  const std::vector<double> lengths = lengths_of(edges_of(domain));
  const auto& positions = cloud.points.positions;
  const Spread spread = spread_of(lengths);
  const Bounds box = bounding_box(positions);
  const std::vector<std::size_t>& sizes = summary.component_sizes;
  const auto connecting = connecting_k(cloud);
  const double noise = noise_level(cloud.measured(), cloud.neighbours);
  const auto share =
      static_cast<double>(summary.largest_component) / static_cast<double>(positions.size());
  const auto warnings = cloud_warnings(cloud, summary, noise);

  InfoReport report;
  Json& json = report.json;
  json["vertices"] = positions.size();
  json["simplices"] = summary.triangles;
  json["edges"] = lengths.size();
  json["components"] = summary.components;
  json["component_sizes"] = sizes_json(sizes);
  json["largest_share"] = share;
  json["connecting_k"] = connecting ? Json(*connecting) : Json(nullptr);
  json["points_in_file"] = cloud.points_in_file;
  json["not_finite"] = cloud.not_finite;
  json["outliers"] = cloud.outliers;
  json["coincident_vertices"] = summary.duplicates;
  json["nearly_coincident_vertices"] = summary.near_duplicates;
  json["isolated_vertices"] = summary.isolated_points;
  json["refused_pairs"] = summary.refused_pairs;
  json["bridges"] = summary.bridges;
  json["boundary_vertices"] = summary.boundary_points;
  json["normals"] = !cloud.points.normals.empty();
  json["mean_spacing"] = json_number(summary.mean_spacing);
  json["noise"] = json_number(noise);
  json["bounding_box"] = to_json(box);
  json["edge_length"] = to_json(spread);
  json["warnings"] = warnings;

  Table& table = report.table;
  table.add("cloud", counted(positions.size(), "vertices") + ", " +
                         counted(lengths.size(), "neighbour pairs") + ", " +
                         counted(summary.triangles, domain.simplex_name()) + ", " +
                         counted(summary.components, "components"));
  if (const std::string kept = kept_points(cloud); !kept.empty()) table.add("kept", kept);
  add_sizes(table, sizes);
  table.add("connected", short_number(100 * share) + " % in the largest component; all with " +
                             (connecting ? "--k " + std::to_string(*connecting) + " or more"
                                         : "no --k up to 256"));
  table.add("boundary", counted(summary.boundary_points, "vertices") + "; " +
                            counted(summary.refused_pairs, "neighbour pairs") +
                            " refused, as not on one sheet");
  table.add("spacing", "mean " + short_number(summary.mean_spacing) + ", noise " +
                           short_number(noise) + " of it");
  table.add("bounding box", to_text(box));
  table.add("to neighbours", to_text(spread));
  return report;
}

}  // namespace plexway
