#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "complexes/test_solids.hpp"
#include "exact_data.hpp"

/// Solids with exact distances.
namespace plexway::testing {

struct SolidTruth {
  Solid solid;
  std::vector<double> exact;
};

// TetGen's files, 0-based, without attributes; nothing, and a warning, where they are missing.
inline std::optional<SolidTruth> read_solid_truth(const std::string& name, Index source) {
  const std::filesystem::path folder = exact_file("solids", name + ".node").parent_path();
  if (folder.empty()) {
    WARN("not measured: no " << name);
    return {};
  }
  SolidTruth truth;
  std::size_t count = 0, skip = 0;
  std::ifstream nodes(folder / (name + ".node"));
  nodes >> count >> skip >> skip >> skip;
  truth.solid.positions.resize(count);
  for (Position& p : truth.solid.positions) nodes >> skip >> p[0] >> p[1] >> p[2];
  std::ifstream tets(folder / (name + ".ele"));
  tets >> count >> skip >> skip;
  truth.solid.tets.resize(count);
  for (Tet& t : truth.solid.tets) tets >> skip >> t[0] >> t[1] >> t[2] >> t[3];
  truth.exact = exact_values(folder / (name + ".v" + std::to_string(source) + ".txt"));
  REQUIRE(nodes);
  REQUIRE(tets);
  REQUIRE(truth.exact.size() == truth.solid.positions.size());
  return truth;
}

}  // namespace plexway::testing
