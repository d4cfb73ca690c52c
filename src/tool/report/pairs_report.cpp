#include "tool/report/pairs_report.hpp"

#include <string>

namespace plexway::cli {

void add_statistics(const StatisticsSummary& summary, Json& json, Table& table) {
  json["diameter"] = summary.diameter;
  json["farthest_pair"] = {summary.from, summary.to};
  json["radius"] = json_number(summary.radius);
  json["mean"] = summary.mean;
  json["pairs"] = summary.pairs;
  table.add("diameter", short_number(summary.diameter) + ", from row " +
                            std::to_string(summary.from) + " to vertex " +
                            std::to_string(summary.to));
  table.add("mean", short_number(summary.mean) + " over " + std::to_string(summary.pairs) +
                        " pairs; the least of the rows' largest is " +
                        short_number(summary.radius));
}

}  // namespace plexway::cli
