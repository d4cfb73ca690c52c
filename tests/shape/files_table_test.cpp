// What is asked for while files are read: every cell of the table (shape/support.hpp). Every yes
// gives the domain that it says, every no throws its sentence.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <plexway/any_domain.hpp>
#include <plexway/error.hpp>
#include <plexway/io/points.hpp>
#include <plexway/io/tets.hpp>
#include <plexway/io/triangles.hpp>
#include <plexway/shape/support.hpp>

#include "folder.hpp"
#include "shape/files/files.hpp"
#include "shape/kinds.hpp"

namespace files_table_test {

using namespace any_testing;
using Catch::Matchers::EndsWith;

namespace {

struct TestFile {
  std::string path;
  DomainKind held;
  FileForm form = FileForm::plain;
  std::optional<DomainKind> as = {};  // what it must be read as to be that
};

// A cube of side 1 in each kind and form.
std::vector<TestFile> all_files(const ::testing::Folder& folder) {
  const Solid cube = solid_cube(3, 0);
  const AnyShape solid = AnyShape::solid(cube.positions, cube.tets);
  const std::vector<std::array<double, 3>>& at = cube.positions;
  std::vector<TestFile> all;
  const auto add = [&](const char* name, DomainKind held, FileForm form = FileForm::plain,
                       std::optional<DomainKind> as = {}) {
    all.push_back({folder.at(name).string(), held, form, as});
    return all.back().path;
  };
  const std::string tets = add("solid.mesh", DomainKind::solid);
  io::write_tets(tets, {at, cube.tets});
  const std::string skin = add("surface.off", DomainKind::surface);
  convert(tets, skin, {});
  const std::string head =
      "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n"
      "0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n";
  folder.write("wires.vtk", head + "CELLS 2 6\n2 0 1\n2 1 4\nCELL_TYPES 2\n3\n3\n");
  add("wires.vtk", DomainKind::wireframe);
  io::write_points(add("cloud.xyz", DomainKind::cloud), {at, {}});
  folder.write("one.simplices",
               "dimension 2\nvertices 4 2\n0 0\n1 0\n0 1\n1 1\nsimplices 2\n0 1 2\n1 3 2\n");
  add("one.simplices", DomainKind::simplices);
  folder.write("mixed.vtk", head + "CELLS 2 7\n2 0 1\n3 1 4 2\nCELL_TYPES 2\n3\n5\n");
  add("mixed.vtk", DomainKind::mixed, FileForm::plain, DomainKind::mixed);
  folder.write("tent.poly",
               "4 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n4 0\n1\n3 1 2 3\n1\n3 1 2 4\n1\n3 2 3 4\n"
               "1\n3 1 3 4\n0\n");
  add("tent.poly", DomainKind::solid, FileForm::boundary);
  AnyDomain(solid).keep(add("kept.plexway", DomainKind::solid, FileForm::prepared));
  try {
    ReadOptions voxels;
    voxels.volume.voxel = 0.1;
    convert(skin, folder.at("cube.vdb").string(), voxels);
    add("cube.vdb", DomainKind::solid, FileForm::level_set);
  } catch (const NotBuiltError&) {
    WARN("no level sets in this build");
  }
  return all;
}

ReadOptions asking(Reading reading, ReadOptions options) {
  switch (reading) {
    case Reading::connecting:
      options.cloud.k = 8;
      break;
    case Reading::filling:
      options.fill.quality = 1.6;
      break;
    case Reading::repair:
      options.volume.repair = true;
      break;
    case Reading::voxel:
      options.volume.voxel = 0.2;
      break;
    case Reading::grid:
      options.volume.grid = "surface";
      break;
    case Reading::merging:
      options.merge = 0;
      break;
    case Reading::kind:
    case Reading::joining:
      break;
  }
  return options;
}

// Is a shape as wide as the cube, up to the voxels that it was cut by?
void check_cube(const AnyShape& shape, DomainKind wanted, double voxel) {
  REQUIRE(shape.kind() == wanted);
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == 2 && wanted == DomainKind::simplices) continue;
    double low = inf, high = -inf;
    for (const Position& p : shape.positions()) {
      low = std::min(low, p[k]);
      high = std::max(high, p[k]);
    }
    CHECK(low == Approx(0).margin(voxel));
    CHECK(high == Approx(1).margin(voxel));
  }
}

}  // namespace

TEST_CASE("what may be asked for as a file is read") {
  const ::testing::Folder folder;
  std::size_t yes = 0, no = 0;
  for (const TestFile& file : all_files(folder))
    for (const DomainKind wanted : {DomainKind::surface, DomainKind::solid, DomainKind::wireframe,
                                    DomainKind::simplices, DomainKind::cloud, DomainKind::mixed})
      for (const Reading reading :
           {Reading::kind, Reading::connecting, Reading::filling, Reading::repair, Reading::voxel,
            Reading::grid, Reading::merging}) {
        // As mixed, a file of cells is read as one, and the others by the reader of their kind.
        const bool natural = wanted == file.held;
        ReadOptions options;
        if (!natural || file.as || (file.form == FileForm::prepared && reading == Reading::kind))
          options.as = wanted;
        const bool cells = file.path.ends_with(".vtk") || file.path.ends_with(".mesh");
        if (cells && !natural && (file.as || wanted == DomainKind::mixed))
          continue;  // it holds what is asked for
        FileUse use{file.held, wanted, file.form};
        use.repaired = reading == Reading::repair;
        options = asking(reading, options);
        INFO(file.path << " as " << kind_name(wanted) << ", " << static_cast<int>(reading));
        Support found = support(Reading::kind, use);
        if (file.form == FileForm::prepared && natural && reading != Reading::kind)
          found = Support();
        if (found) found = support(reading, use);
        if (reading == Reading::grid && !support(reading, use)) found = support(reading, use);
        if (!found) {
          ++no;
          CHECK_THROWS_WITH(AnyShape::read(file.path, options), EndsWith(found.sentence()));
          continue;
        }
        ++yes;
        try {
          check_cube(AnyShape::read(file.path, options), wanted,
                     file.form == FileForm::level_set || use.repaired ? 0.21 : 1e-9);
        } catch (const NotBuiltError&) {
          WARN("not in this build");
        }
      }
  CHECK(yes > 25);
  CHECK(no > 100);
}

TEST_CASE("what may be asked for as several files are read, and which they may be") {
  const ::testing::Folder folder;
  const std::vector<TestFile> files = all_files(folder);
  const std::filesystem::path solid = files[0].path;
  for (const TestFile& file : files) {
    FileUse use{file.held, DomainKind::mixed, file.form};
    use.several = true;
    const Support found = support(Reading::joining, use);
    INFO(file.path);
    const std::array<std::filesystem::path, 2> both = {solid, file.path};
    if (found)
      check_cube(AnyShape::read(both, 1e-9), DomainKind::mixed, 1e-9);
    else
      CHECK_THROWS_WITH(AnyShape::read(both, 1e-9), EndsWith(found.sentence()));
  }
  const std::array<std::filesystem::path, 2> twice = {solid, solid};
  for (const Reading reading : {Reading::connecting, Reading::filling, Reading::repair,
                                Reading::voxel, Reading::grid, Reading::merging})
    CHECK_THROWS_WITH(AnyShape::read(twice, 0, asking(reading, {})),
                      EndsWith(Support(Refusal::several_files).sentence()));
  for (const Spelling spelling : {Spelling::fields, Spelling::flags}) {
    ReadOptions as_solid;
    as_solid.as = DomainKind::solid;
    as_solid.spelling = spelling;
    CHECK_THROWS_WITH(AnyShape::read(twice, 0, as_solid),
                      solid.string() + ", " + solid.string() +
                          (spelling == Spelling::flags ? ": --as: " : ": as: ") +
                          Support(Refusal::several_files).sentence());
  }
  CHECK(AnyShape::read(twice, 0, {.as = DomainKind::mixed}).kind() == DomainKind::mixed);
  const auto lengths = folder.write("lengths.edges", "vertices 2\n0 1 0.5\n").string();
  const std::array<std::filesystem::path, 2> alone = {solid, lengths};
  const FileUse use{.held = DomainKind::wireframe,
                    .wanted = DomainKind::mixed,
                    .several = true,
                    .positions = false};
  CHECK_THROWS_WITH(AnyShape::read(alone, 0),
                    lengths + ": " + support(Reading::joining, use).sentence());
}

TEST_CASE("points that are converted are copied") {
  const ::testing::Folder folder;
  const std::string in = folder.write("a.xyz", "0 0 0\n1 0 0\n0 1 0\n").string();
  const std::string out = folder.at("b.xyz").string();
  CHECK(convert(in, out, {}).vertices == 3);
  for (const Reading reading : {Reading::filling, Reading::voxel, Reading::grid, Reading::merging})
    CHECK_THROWS_WITH(convert(in, out, asking(reading, {})),
                      EndsWith(Support(Refusal::copied_points).sentence()));
}

}  // namespace files_table_test
