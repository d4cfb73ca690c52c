#include "tool/options/metric_options.hpp"

#include <CLI/CLI.hpp>

namespace plexway::cli {

void add_metric_option(CLI::App& command, MetricArgument& argument) {
  command
      .add_option(
          "--metric", argument.text,
          "what a step costs: speed:FILE (a number a simplex), regions:FILE (a region of a\n"
          ".msh, .vtu or .vtk and its speed a line), tensor:FILE (xx xy xz yy yz zz a simplex;\n"
          "xx xy yy in the plane), vertex-tensor:FILE (a vertex) or\n"
          "lengths:FILE (vertex vertex length an edge); default: lengths in space")
      ->type_name("KIND:FILE")
      ->group("How to solve");
}

static std::string name_of_metric(const MetricArgument& argument, const MeasuredLengths& lengths,
                                  std::size_t refracting_edges) {
  if (!lengths.speeds.empty()) return argument.text + "; refracts where speeds change";
  return argument.text +
         (refracting_edges > 0 ? "; refracts at " + counted(refracting_edges, "edges") : "");
}

void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Json& json) {
  if (lengths == nullptr) return;
  json["metric"] = argument.text;
  json["refracting_edges"] = refracting_edges;
  json["violated"] = lengths->violations.count;
}

void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Table& table) {
  if (lengths != nullptr) table.add("metric", name_of_metric(argument, *lengths, refracting_edges));
}

}  // namespace plexway::cli
