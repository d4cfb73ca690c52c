#include <catch2/catch.hpp>
#include <cstddef>
#include <map>
#include <random>
#include <vector>

#include <plexway/solve.hpp>

#include "data/shapes.hpp"
#include "windows/waiting_table.hpp"

namespace plexway::windows_waiting_test {

namespace {

struct Block {
  Index place, link;
};

}  // namespace

TEST_CASE("blocks that wait are found by their halfedge, the latest first", "[windows]") {
  windows::WaitingTable waiting;
  std::vector<Block> blocks;
  std::map<Index, std::vector<Index>> truth;  // the latest last
  std::vector<Index> free;
  std::mt19937 random(3);
  for (int round = 0; round < 40000; ++round) {
    // Many on few halfedges, those side by side, and a stride that rows of a grid have.
    const auto kind = random() % 3;
    const auto k = static_cast<Index>(random() % 1500);
    const Index h = kind == 0 ? k % 40 : kind == 1 ? 4 * k + k % 3 : k << 12;
    auto& own = truth[h];
    const Index found = windows::WaitingTable::find(waiting.list(h), h, blocks);
    REQUIRE(found == (own.empty() ? none : own.back()));
    if (own.empty() || random() % 5 < 3) {
      Index b = static_cast<Index>(blocks.size());
      if (free.empty()) {
        waiting.make_room(blocks.size() + 1, blocks);
        blocks.emplace_back();
      } else {
        b = free.back();
        free.pop_back();
      }
      Index& list = waiting.list(h);
      blocks[b] = {h, list};
      list = b;
      own.push_back(b);
    } else {
      const auto which = own.begin() + static_cast<std::ptrdiff_t>(random() % own.size());
      const Index b = *which;
      waiting.remove(b, blocks);
      own.erase(which);
      free.push_back(b);
    }
  }
  waiting.clear();
  for (const auto& [h, own] : truth)
    REQUIRE(windows::WaitingTable::find(waiting.list(h), h, blocks) == none);
}

TEMPLATE_TEST_CASE("merged windows hold few bytes a vertex", "[windows]", float, double) {
  const auto shape = samples::bumpy(50);
  const TriangleMesh<TestType> mesh(shape.points, shape.faces);
  Workspace<TestType> workspace;
  DistanceField<TestType> field;
  PropagateOptions options;
  options.accuracy = Accuracy::accurate();
  std::size_t first = 0;
  for (const Index source : {Index{0}, Index{7}, Index{20000}}) {
    solve(Serial{}, mesh, PointSource::at(source), options, workspace, field);
    if (first == 0) first = workspace.bytes();
  }
  const double bytes =
      static_cast<double>(workspace.bytes()) / static_cast<double>(mesh.vertex_count());
  CAPTURE(bytes);
  CHECK(bytes < (sizeof(TestType) == 4 ? 36 : 48));
  CHECK(2 * workspace.bytes() < 3 * first);
}

}  // namespace plexway::windows_waiting_test
