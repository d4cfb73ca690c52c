// What we write is read by others, and what others write is read by us: meshio (Python) is the
// other, where it is installed.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>

#include <plexway/io/field.hpp>

#include "tets_testing.hpp"

namespace meshio_test {

using namespace io_testing;
using plexway::io::Edges;
using plexway::io::Tets;
using plexway::io::Triangles;

namespace {

const std::string& python() {
  static const std::string found = io_testing::python_with("meshio");
  return found;
}

bool run_peer(const std::string& arguments, const Folder& folder) {
  return io_testing::run_peer(python(), "meshio_peer.py", arguments, folder);
}

std::string digits(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

template <class Cells>
std::string truth(const Positions& positions, char kind, const Cells& cells,
                  const std::vector<double>& distance = {},
                  const std::vector<std::int32_t>& label = {}) {
  std::string text;
  for (const auto& [x, y, z] : positions)
    text += "v " + digits(x) + " " + digits(y) + " " + digits(z) + "\n";
  for (const double d : distance) text += "d " + digits(d) + "\n";
  for (const std::int32_t l : label) text += "l " + std::to_string(l) + "\n";
  for (const auto& cell : cells) {
    text += kind;
    for (const std::uint32_t vertex : cell) text.append(" ").append(std::to_string(vertex));
    text += '\n';
  }
  return text;
}

const std::vector<double> distance = {0, 0.1, 2.0 / 3, std::numeric_limits<double>::infinity(),
                                      1e-300};
const std::vector<std::int32_t> label = {0, 7, -1, 2147483647, 3};

bool close(const Positions& a, const Positions& b) {
  const auto same = [](double x, double y) { return std::abs(x - y) <= 1e-11 * std::abs(y); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const auto& p, const auto& q) {
    return std::equal(p.begin(), p.end(), q.begin(), same);
  });
}

/// Writes a field over `domain` in all forms that hold its cells, and lets meshio read them.
template <class Domain, class Cells>
void check_fields(const Domain& domain, char kind, const Cells& cells) {
  for (const bool with_label : {false, true}) {
    const Folder folder;
    const auto labels = with_label ? label : std::vector<std::int32_t>();
    folder.write("truth.txt", truth(domain.positions, kind, cells, distance, labels));
    std::string names;
    for (const char* name : {"d.vtu", "d.vtk", "d.ply"}) {
      // meshio passes over the edges of a .ply.
      if (kind == 'e' && std::string_view(name) == "d.ply") continue;
      plexway::io::write_field(folder.path() / name, domain, distance, labels);
      names.append(" ").append(name);
    }
    CHECK(run_peer("check '" + folder.path().string() + "'" + names, folder));
  }
}

}  // namespace

TEST_CASE("meshio reads the solids we write") {
  if (python().empty()) return;
  const Folder folder;
  const Tets solid = awkward_solid();
  folder.write("truth.txt", truth(solid.positions, 't', solid.tets));
  std::string names;
  for (const char* name : {"a.node", "a.mesh", "a.msh", "a.vtu", "a.vtk"}) {
    write_tets(folder.path() / name, solid);
    names.append(" ").append(name);
  }
  CHECK(run_peer("check '" + folder.path().string() + "'" + names, folder));
}

TEST_CASE("meshio reads the fields we write") {
  if (python().empty()) return;
  const Tets solid = awkward_solid();
  check_fields(solid, 't', solid.tets);
  const Triangles surface{solid.positions, {{0, 1, 2}, {4, 3, 2}}};
  check_fields(surface, 'f', surface.triangles);
  const Edges wires{solid.positions, {{0, 1}, {4, 2}, {2, 3}}, {}, solid.positions.size()};
  check_fields(wires, 'e', wires.edges);
}

TEST_CASE("we read the solids that meshio writes") {
  if (python().empty()) return;
  const Folder folder;
  const Tets solid = awkward_solid();
  folder.write("truth.txt", truth(solid.positions, 't', solid.tets));
  REQUIRE(run_peer("make '" + folder.path().string() + "'", folder));
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    if (entry.path().extension() == ".txt") continue;
    INFO(entry.path().filename());
    ++files;
    try {
      const Tets back = plexway::io::read_tets(entry.path());
      // There meshio writes twelve digits.
      const bool rounded = entry.path().filename() == "xml_ascii.vtu";
      if (!rounded) CHECK(back.positions == solid.positions);
      CHECK(close(back.positions, solid.positions));
      CHECK(back.tets == solid.tets);
    } catch (const plexway::NotBuiltError&) {
    }
  }
  CHECK(files == 14);
}

}  // namespace meshio_test
