#pragma once

#include "any/info/report.hpp"
#include "any/pair_tables.hpp"

namespace plexway::cli {

/// What the rows of a matrix come to together.
void add_statistics(const StatisticsSummary& summary, Json& json, Table& table);

}  // namespace plexway::cli
