#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <plexway/metric/edge_lengths.hpp>

#include "cli/options/input.hpp"
#include "cli/report/report.hpp"

namespace CLI {
class App;
}

namespace plexway::cli {

/// As typed: KIND:FILE, or nothing.
struct MetricArgument {
  std::string text;
};

/// Adds --metric to a command.
void add_metric_option(CLI::App& command, MetricArgument& argument);

/// May an edge have two lengths?
enum class Jumps { refract, smooth };

/// The FILE of KIND:FILE, or nothing. Throws UsageError for what is not KIND:FILE.
std::string metric_file(const MetricArgument& argument);

/// Reads the metric's file and measures the domain; null where none is asked for. Throws InputError
/// "FILE: cause", UsageError for a cloud, and for a domain that this kind of metric cannot measure.
std::shared_ptr<const MeasuredLengths> measure(const MetricArgument& argument, const Domain& domain,
                                               Jumps jumps);

/// What a summary says: the metric, edges that refract, simplices whose lengths no triangle or
/// tetrahedron has. `lengths` may be null: nothing then.
void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Json& json);
void add_metric(const MetricArgument& argument, const MeasuredLengths* lengths,
                std::size_t refracting_edges, Table& table);
/// A note for people where lengths break the triangle inequality.
void say_violations(const Domain& domain, const MeasuredLengths* lengths);

}  // namespace plexway::cli
