#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/executors/joined_rows.hpp>
#include <plexway/solve.hpp>

#include "complexes/jittered.hpp"
#include "executors/parts_testing.hpp"
#include "executors/piece_testing.hpp"
#include "executors/thread_ranks.hpp"
#include "message_of.hpp"
#include "with_accuracy.hpp"

namespace plexway::testing::joined_rows_test {

// Surfaces of several files (executors/joined_rows.hpp).

namespace {

// Ranges of triangles, each with points of its own in an order of its own; vertices of no triangle
// are in the first.
std::vector<SurfaceFilePart> parts_of(const Surface& s, std::size_t count, bool ids) {
  std::vector<SurfaceFilePart> parts(count);
  std::mt19937 random(static_cast<unsigned>(count));
  std::vector<bool> used(s.positions.size(), false);
  for (const Face& f : s.faces)
    for (const Index v : f) used[v] = true;
  for (std::size_t p = 0; p < count; ++p) {
    SurfaceFilePart& part = parts[p];
    part.number = p;
    part.name = "part " + std::to_string(p);
    std::vector<Index> vertices;
    const std::size_t begin = s.faces.size() * p / count, end = s.faces.size() * (p + 1) / count;
    for (std::size_t f = begin; f < end; ++f)
      vertices.insert(vertices.end(), s.faces[f].begin(), s.faces[f].end());
    for (Index v = 0; p == 0 && v < used.size(); ++v)
      if (!used[v]) vertices.push_back(v);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    std::shuffle(vertices.begin(), vertices.end(), random);
    std::vector<Index> name(s.positions.size(), none);
    for (Index i = 0; i < vertices.size(); ++i) {
      name[vertices[i]] = i;
      part.positions.push_back(s.positions[vertices[i]]);
      if (ids) part.ids.push_back(vertices[i]);
    }
    for (std::size_t f = begin; f < end; ++f)
      part.triangles.push_back({name[s.faces[f][0]], name[s.faces[f][1]], name[s.faces[f][2]]});
  }
  return parts;
}

// All rows, as processes that have read the parts in turn have them.
Surface joined(const std::vector<SurfaceFilePart>& parts, std::size_t ranks,
               JoinedCounts* counts = nullptr) {
  Surface all;
  std::mutex mutex;
  const auto work = [&](PieceRanks* own) {
    const std::size_t n = own == nullptr ? 1 : own->count(), r = own == nullptr ? 0 : own->rank();
    std::vector<SurfaceFilePart> mine;
    for (std::size_t p = r; p < parts.size(); p += n) mine.push_back(parts[p]);
    const JoinedRows rows(own, mine);
    const auto range = [&](std::size_t count) {
      return std::pair(count * r / n, count * (r + 1) / n - count * r / n);
    };
    const auto [vertex, vertices] = range(rows.vertex_count());
    const auto [face, faces] = range(rows.face_count());
    const std::scoped_lock lock(mutex);
    if (counts != nullptr) *counts = rows.joined();
    all.positions.resize(rows.vertex_count());
    all.faces.resize(rows.face_count());
    rows.read_vertices(vertex, std::span(all.positions).subspan(vertex, vertices));
    rows.read_faces(face, std::span(all.faces).subspan(face, faces));
  };
  if (ranks == 1)
    work(nullptr);
  else
    ThreadRanks(ranks).run([&](PieceRanks& own) { work(&own); });
  return all;
}

std::string refused(const std::vector<SurfaceFilePart>& parts) {
  CHECK_FALSE(message_of([&] { (void)joined(parts, 1); }).empty());
  return message_of([&] { (void)joined(parts, 2); });
}

}  // namespace

TEST_CASE("joined rows: by their ids parts are what they were cut from") {
  std::vector<Surface> all = surfaces();
  all.push_back(jittered(9, 1));
  all.back().add(7, 7);  // of no triangle
  for (const Surface& s : all)
    for (const std::size_t parts : {1u, 2u, 5u})
      for (const std::size_t ranks : {1u, 2u, 3u, 4u}) {
        const Surface found = joined(parts_of(s, parts, true), ranks);
        CHECK(found.positions == s.positions);
        CHECK(found.faces == s.faces);
      }
}

TEST_CASE("joined rows: ids may start anywhere and leave some out") {
  const Surface s = jittered(9, 1);
  auto parts = parts_of(s, 4, true);
  for (SurfaceFilePart& part : parts)
    for (std::uint64_t& id : part.ids) id = (std::uint64_t{1} << 40) + 3 * id;
  for (const std::size_t ranks : {1u, 3u}) {
    const Surface found = joined(parts, ranks);
    CHECK(found.positions == s.positions);
    CHECK(found.faces == s.faces);
  }
}

TEST_CASE("joined rows: without ids parts hold together where they lie in the same place") {
  const Surface s = jittered(12, 3);
  std::vector<Surface> found;
  for (const std::size_t ranks : {1u, 2u, 3u, 4u}) {
    found.push_back(joined(parts_of(s, 5, false), ranks));
    CHECK(found.back().positions == found[0].positions);
    CHECK(found.back().faces == found[0].faces);
  }
  REQUIRE(found[0].positions.size() == s.positions.size());
  REQUIRE(found[0].faces.size() == s.faces.size());
  for (std::size_t f = 0; f < s.faces.size(); ++f)
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(found[0].positions[found[0].faces[f][c]] == s.positions[s.faces[f][c]]);
  // And so its distances.
  const PointSource source = PointSource::at(17);
  std::map<Position, double> known;
  const auto whole = solve(Serial{}, s.mesh<double>(), source, at(Accuracy::exact()));
  for (std::size_t v = 0; v < s.positions.size(); ++v) known[s.positions[v]] = whole.distance[v];
  const auto there = static_cast<Index>(
      std::find(found[0].positions.begin(), found[0].positions.end(), s.positions[17]) -
      found[0].positions.begin());
  const auto field =
      solve_in_parts<double>(found[0], {3, 1, 40}, {PointSource::at(there)}, at(Accuracy::exact()));
  double worst = 0;
  for (std::size_t v = 0; v < field.distance.size(); ++v)
    worst = std::max(worst, std::abs(field.distance[v] - known.at(found[0].positions[v])));
  CHECK(worst < 1e-12);
}

namespace {

struct Told {
  bool by_ids;
  std::uint64_t parts, alone, shared, apart;
};

void check_told(const std::vector<SurfaceFilePart>& parts, const Told& known) {
  for (const std::size_t ranks : {1u, 2u, 3u}) {
    CAPTURE(ranks);
    JoinedCounts found;
    (void)joined(parts, ranks, &found);
    CHECK(found.by_ids == known.by_ids);
    CHECK(found.parts == known.parts);
    CHECK(found.alone == known.alone);
    CHECK(found.shared == known.shared);
    CHECK(found.apart == known.apart);
  }
}

// Four points each, two of them where the other has them, too.
std::vector<SurfaceFilePart> two_squares() {
  std::vector<SurfaceFilePart> parts(2);
  parts[0] = {"a", 0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {0, 1, 2, 3}, {{0, 1, 2}}, "n"};
  parts[1] = {"b", 1, {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 1, 0}}, {1, 4, 3, 5}, {{0, 1, 2}}, "n"};
  return parts;
}

}  // namespace

TEST_CASE("joined rows: how parts hold together is told") {
  auto parts = two_squares();
  check_told(parts, {true, 2, 0, 2, 0});
  parts[1].ids = {1, 4, 6, 5};  // one of two torn
  check_told(parts, {true, 2, 0, 1, 1});
  parts[1].ids = {10, 14, 16, 15};  // numbered on their own
  check_told(parts, {true, 2, 2, 0, 2});
  for (SurfaceFilePart& part : parts) part.ids.clear();
  check_told(parts, {false, 2, 0, 2, 0});
  for (auto& at : parts[1].positions) at[0] += 1e-12;
  check_told(parts, {false, 2, 2, 0, 0});
  parts[1].triangles.clear();  // a point alone is no part torn off
  check_told(parts, {false, 1, 1, 0, 0});
  parts.pop_back();
  check_told(parts, {false, 1, 1, 0, 0});
  // A slit that goes on from one part to the next tears nothing: each has both sides.
  parts = two_squares();
  for (SurfaceFilePart& part : parts) {
    part.positions.push_back({1, 1, 0});
    part.ids.push_back(7);
  }
  check_told(parts, {true, 2, 0, 3, 0});
}

TEST_CASE("joined rows: a triangle that two parts have is refused") {
  const Surface s = jittered(6, 2);
  for (const bool ids : {true, false}) {
    auto parts = parts_of(s, 4, ids);
    // The last part's first triangle in another order, in the second as well.
    for (const std::size_t c : {1u, 2u, 0u}) {
      const Index v = parts[3].triangles[0][c];
      parts[1].positions.push_back(parts[3].positions[v]);
      if (ids) parts[1].ids.push_back(parts[3].ids[v]);
    }
    const auto last = static_cast<Index>(parts[1].positions.size());
    parts[1].triangles.push_back({last - 3, last - 2, last - 1});
    CHECK(refused(parts) == "a triangle is in parts 1 and 3: mark ghost cells by vtkGhostType");
  }
}

TEST_CASE("joined rows: minus zero is zero") {
  std::vector<SurfaceFilePart> parts(2);
  parts[0] = {"a", 0, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {{0, 1, 2}}, {}};
  parts[1] = {"b", 1, {{-0., 0, 0}, {0, 1, -0.}, {-1, 0, 0}}, {}, {{0, 1, 2}}, {}};
  CHECK(joined(parts, 2).positions.size() == 4);
}

TEST_CASE("joined rows: what is open is refused") {
  const Surface s = jittered(6, 2);
  auto parts = parts_of(s, 3, true);
  parts[1].ids.clear();
  CHECK(refused(parts).find("number their points") != std::string::npos);
  parts = parts_of(s, 3, true);
  parts[2].ids[4] = parts[2].ids[7];
  parts[2].ids_name = "original";
  CHECK(refused(parts).find("have the same number " + std::to_string(parts[2].ids[4]) +
                            " in 'original'") != std::string::npos);
  parts = parts_of(s, 3, false);
  parts[2].positions[4] = parts[2].positions[7];
  CHECK(refused(parts).find("part 2: points 4 and 7 lie in the same place") != std::string::npos);
  // A vertex that two parts have, elsewhere in one.
  parts = parts_of(s, 3, true);
  for (std::size_t i = 0; i < parts[1].ids.size(); ++i)
    if (const auto& other = parts[0].ids;
        std::find(other.begin(), other.end(), parts[1].ids[i]) != other.end()) {
      parts[1].positions[i][0] += 1e-9;
      break;
    }
  CHECK(refused(parts).find("elsewhere") != std::string::npos);
}

}  // namespace plexway::testing::joined_rows_test
