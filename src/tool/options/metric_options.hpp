#pragma once

#include "shape/arguments/metric_argument.hpp"
#include "shape/info/report.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// Adds --metric to a command.
void add_metric_option(CLI::App& command, MetricArgument& argument);

/// What a summary says: the metric, edges that refract, simplices whose lengths no triangle or
/// tetrahedron has. `lengths` may be null: nothing then.
void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Json& json);
void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Table& table);

}  // namespace plexway::cli
