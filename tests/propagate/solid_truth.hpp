#pragma once

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "complex/test_solids.hpp"

/// Solids of the truth folder, with exact distances.
namespace plexway::testing {

struct SolidTruth {
  Solid solid;
  std::vector<double> exact;
};

// TetGen's files as they are in the truth folder: 0-based, no attributes.
inline SolidTruth read_solid_truth(const std::string& name, Index source) {
  const std::filesystem::path folder = std::filesystem::path(PLEXWAY_TRUTH_DIR) / "solids";
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
  std::ifstream exact(folder / (name + ".v" + std::to_string(source) + ".txt"));
  truth.exact.resize(truth.solid.positions.size());
  for (double& d : truth.exact) exact >> d;
  REQUIRE(nodes);
  REQUIRE(tets);
  REQUIRE(exact);
  return truth;
}

inline bool solids_available() {
  return std::filesystem::exists(std::filesystem::path(PLEXWAY_TRUTH_DIR) / "solids");
}

}  // namespace plexway::testing
