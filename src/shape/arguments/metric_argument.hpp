#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <plexway/metric/edge_lengths.hpp>

#include <plexway/shape/shape.hpp>

namespace plexway {

/// As typed: KIND:FILE, or nothing.
struct MetricArgument {
  std::string text;
};

/// May an edge have two lengths?
enum class Jumps { refract, smooth };

/// The FILE of KIND:FILE, or nothing. Throws UsageError for what is not KIND:FILE.
std::string metric_file(const MetricArgument& argument);

/// Reads the metric's file and measures the domain; null where none is asked for. Throws InputError
/// "FILE: cause", UsageError for a cloud, and for a domain that this kind of metric cannot measure.
std::shared_ptr<const MeasuredLengths> measure(const MetricArgument& argument,
                                               const AnyShape& domain, Jumps jumps);

}  // namespace plexway
