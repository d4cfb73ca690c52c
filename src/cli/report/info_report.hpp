#pragma once

#include <array>
#include <string>
#include <vector>

#include "domain.hpp"
#include "report.hpp"
#include "survey.hpp"

namespace plexway::cli {

/// What `info` says of a domain: the same for programs and for people.
struct InfoReport {
  Json json;  ///< without "input" and "kind"
  Table table;
};

/// Throw InputError "FILE: cause" where the domain makes no complex. One for each kind.
InfoReport info_of(const Domain& domain, const io::Triangles& surface);
InfoReport info_of(const Domain& domain, const io::Tets& solid);
InfoReport info_of(const Domain& domain, const io::Edges& wireframe);
InfoReport info_of(const Domain& domain, const Cloud& cloud);

/// The executors of this build, and the devices they find on this machine.
InfoReport info_of_devices();

// Pieces that several kinds have.

Json to_json(const Box& box);
Json to_json(const Spread& spread);
std::string to_text(const Box& box);
std::string to_text(const Spread& spread);
/// Null for none; else at most the 100 largest.
Json sizes_json(const std::optional<std::vector<std::size_t>>& sizes);
/// Adds a line with the sizes of the largest components where there are several.
void add_sizes(Table& table, const std::optional<std::vector<std::size_t>>& sizes);

}  // namespace plexway::cli
