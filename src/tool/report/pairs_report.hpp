#pragma once

#include "shape/info/report.hpp"
#include "shape/pairs/pair_tables.hpp"

namespace plexway::cli {

/// What the rows of a matrix come to together.
void add_statistics(const StatisticsSummary& summary, Json& json, Table& table);

}  // namespace plexway::cli
