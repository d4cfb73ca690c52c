#include <fcntl.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <sys/resource.h>
#include <unistd.h>
#include <csignal>
#include <limits>

#include <plexway/openvdb/field.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "volumes.hpp"

namespace files_test {

// .vdb files made with OpenVDB itself, whole and damaged.

using namespace volume_testing;
using Catch::Contains;
using plexway::openvdb::read_level_set;

namespace {

using ::openvdb::FloatGrid;
using Grids = ::openvdb::GridCPtrVec;

FloatGrid::Ptr sphere_grid(const std::string& name, float radius, float voxel) {
  ::openvdb::initialize();
  auto grid = ::openvdb::tools::createLevelSetSphere<FloatGrid>(radius, {0.3f, 0, 0}, voxel);
  grid->setName(name);
  return grid;
}

std::filesystem::path save(const Folder& folder, const std::string& name, const Grids& grids) {
  ::openvdb::initialize();
  const auto file = folder.path() / name;
  ::openvdb::io::File(file.string()).write(grids);
  return file;
}

std::string complaint_of(const std::filesystem::path& file, const std::string& grid = "") {
  return message_of<plexway::InputError>([&] { (void)read_level_set(file, grid); });
}

}  // namespace

TEST_CASE("a level set that OpenVDB wrote: values, voxels and volume") {
  const Folder folder;
  const auto grid = sphere_grid("drop", 1, 0.05f);
  const auto level_set = read_level_set(save(folder, "a.vdb", {grid}));
  CHECK(level_set.name() == "drop");
  CHECK(level_set.voxel() == Approx(0.05));
  CHECK(level_set.active_voxels() == grid->activeVoxelCount());
  CHECK(level_set({0.3 + 0.98, 0, 0}) == Approx(-0.02).margin(1e-3));
  CHECK(level_set({0.3, 0, 0}) == Approx(-0.15));
  CHECK(level_set({5, 0, 0}) == Approx(0.15));
  const auto solid = plexway::openvdb::fill(level_set);
  CHECK(volume(solid) == Approx(4 * pi / 3).epsilon(5e-3));
}

TEST_CASE("any affine transform, and doubles") {
  const Folder folder;
  auto grid = sphere_grid("drop", 1, 0.05f);
  ::openvdb::Mat4d matrix = ::openvdb::Mat4d::identity();
  matrix.setToRotation(::openvdb::Vec3d(1, 2, 3), 0.7);
  matrix.preScale(::openvdb::Vec3d(0.05, 0.1, 0.2));  // first scaled, then turned
  matrix.postTranslate(::openvdb::Vec3d(10, -20, 30));
  grid->setTransform(::openvdb::math::Transform::createLinearTransform(matrix));
  const auto level_set = read_level_set(save(folder, "turned.vdb", {grid}));
  CHECK(level_set.voxel() == Approx(std::cbrt(0.001)));
  const auto solid = plexway::openvdb::fill(level_set);
  CHECK(volume(solid) == Approx(8 * 4 * pi / 3).epsilon(5e-3));
  const auto in_world = grid->transform().indexToWorld(::openvdb::Vec3d(6, 19, 3));
  const float stored = grid->tree().getValue({6, 19, 3});
  CHECK(level_set({in_world.x(), in_world.y(), in_world.z()}) == Approx(stored).margin(1e-6));

  const auto twice = ::openvdb::DoubleGrid::create(0.3);
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y)
      for (int z = -9; z <= 9; ++z)
        twice->tree().setValue({x, y, z}, 0.1 * (std::sqrt(x * x + y * y + z * z) - 6.5));
  twice->setGridClass(::openvdb::GRID_LEVEL_SET);
  twice->setTransform(::openvdb::math::Transform::createLinearTransform(0.1));
  const auto ball_again = plexway::openvdb::fill(read_level_set(save(folder, "d.vdb", {twice})));
  CHECK(volume(ball_again) == Approx(4 * pi / 3 * 0.65 * 0.65 * 0.65).epsilon(0.02));
}

TEST_CASE("what is no level set, or not the only one, is named") {
  const Folder folder;
  const auto one = sphere_grid("one", 1, 0.1f);
  const auto two = sphere_grid("two", 1, 0.1f);
  const auto fog = sphere_grid("density", 1, 0.1f);
  fog->setGridClass(::openvdb::GRID_FOG_VOLUME);
  const auto velocity = ::openvdb::Vec3SGrid::create();
  velocity->setName("v");
  velocity->tree().setValue({0, 0, 0}, {1, 0, 0});

  const auto several = save(folder, "several.vdb", {one, two});
  CHECK_THAT(complaint_of(several), Contains("several level sets") && Contains("'one', 'two'"));
  CHECK(read_level_set(several, "two").name() == "two");
  CHECK_THAT(complaint_of(several, "three"), Contains("no grid 'three'") && Contains("'one'"));
  CHECK(read_level_set(save(folder, "mixed.vdb", {velocity, fog, one})).name() == "one");

  const auto fogs = save(folder, "fog.vdb", {fog});
  CHECK_THAT(complaint_of(fogs), Contains("fog.vdb: ") && Contains("fog volume, not a level set"));
  CHECK_THAT(complaint_of(save(folder, "v.vdb", {velocity})), Contains("grid of vec3s"));
  CHECK_THAT(complaint_of(save(folder, "none.vdb", {fog, velocity})), Contains("none marked as"));
  CHECK_THAT(complaint_of(save(folder, "empty.vdb", {})), Contains("no grids"));

  const auto hollow = FloatGrid::create(0.3f);
  hollow->setGridClass(::openvdb::GRID_LEVEL_SET);
  hollow->tree().setValue({1, 2, 3}, 0.1f);
  CHECK_THAT(complaint_of(save(folder, "hollow.vdb", {hollow})), Contains("nothing lies inside"));
  const auto nan = sphere_grid("nan", 1, 0.1f);
  nan->tree().setValue({10, 2, 3}, std::nanf(""));
  CHECK_THAT(complaint_of(save(folder, "nan.vdb", {nan})), Contains("not a number"));
  const auto far = sphere_grid("far", 1, 0.1f);
  far->tree().setValue({1 << 28, 2, 3}, 0.1f);
  CHECK_THAT(complaint_of(save(folder, "far.vdb", {far})), Contains("too far"));
  const auto huge = sphere_grid("huge", 1, 0.1f);
  huge->tree().addTile(3, {1 << 20, 0, 0}, -0.3f, false);
  CHECK_THAT(complaint_of(save(folder, "huge.vdb", {huge})), Contains("voxels lie inside"));

  auto frustum = sphere_grid("view", 1, 0.1f);
  frustum->setTransform(::openvdb::math::Transform::createFrustumTransform(
      ::openvdb::BBoxd({-50, -50, -50}, {50, 50, 50}), 0.5, 1));
  CHECK_THAT(complaint_of(save(folder, "view.vdb", {frustum})), Contains("frustum"));

  CHECK_THAT(complaint_of(folder.path() / "missing.vdb"), Contains("No such file"));
  CHECK_THAT(complaint_of(folder.path()), Contains("is a directory"));
  CHECK_THAT(complaint_of(folder.write("text.vdb", "no volume at all")),
             Contains("no OpenVDB file"));
  CHECK_THAT(complaint_of(folder.write("nothing.vdb", "")), Contains("no OpenVDB file"));
}

TEST_CASE("infinite values count as the background, and so does the shape") {
  const Folder folder;
  constexpr float far = std::numeric_limits<float>::infinity();
  // Of a ball of radius 6.4 voxels: distances within two voxels of it, and beyond none.
  const auto grid = FloatGrid::create(2);
  const auto whole = FloatGrid::create(2);
  for (int x = -9; x <= 9; ++x)
    for (int y = -9; y <= 9; ++y)
      for (int z = -9; z <= 9; ++z) {
        const double d = std::sqrt(x * x + y * y + z * z) - 6.4;
        const float cut = static_cast<float>(std::clamp(d, -2.0, 2.0));
        whole->tree().setValue({x, y, z}, cut);
        grid->tree().setValue({x, y, z}, d > 2 ? far : d < -2 ? -far : cut);
      }
  grid->setGridClass(::openvdb::GRID_LEVEL_SET);
  whole->setGridClass(::openvdb::GRID_LEVEL_SET);
  const auto with = read_level_set(save(folder, "infinite.vdb", {grid}));
  const auto without = read_level_set(save(folder, "finite.vdb", {whole}));
  CHECK(with({0, 0, 0}) == -2);
  CHECK(with({9, 9, 9}) == 2);
  CHECK(with({8.6, 0.2, 0}) == without({8.6, 0.2, 0}));
  CHECK(std::isfinite(with({8.3, 0.4, 0})));
  const auto solid = plexway::openvdb::fill(with);
  CHECK(volume(solid) == Approx(4 * pi / 3 * 6.4 * 6.4 * 6.4).epsilon(0.02));
  CHECK(solid.positions == plexway::openvdb::fill(without).positions);

  // Next to the surface too.
  grid->tree().setValue({7, 0, 0}, far);
  const auto near = plexway::openvdb::fill(read_level_set(save(folder, "near.vdb", {grid})));
  for (const Point& p : near.positions) CHECK(std::isfinite(p[0] + p[1] + p[2]));

  // A whole tile that is not a number.
  const auto tile = sphere_grid("tile", 1, 0.1f);
  tile->tree().addTile(1, {80, 0, 0}, std::nanf(""), false);
  CHECK_THAT(complaint_of(save(folder, "tile.vdb", {tile})), Contains("not a number"));
}

TEST_CASE("truncated and damaged files end in one line, never in a crash") {
  const Folder folder;
  const std::string whole = bytes_of(save(folder, "whole.vdb", {sphere_grid("s", 1, 0.1f)}));
  std::size_t refused = 0, tried = 0;
  const auto attempt = [&](const std::string& bytes) {
    const auto file = folder.write("damaged.vdb", bytes);
    ++tried;
    const std::string said = message_of([&] { (void)read_level_set(file); });
    if (said.empty()) return;
    ++refused;
    CHECK_THAT(said, Contains("damaged.vdb: "));
    CHECK(said.find('\n') == said.npos);
  };
  for (std::size_t part = 0; part < 24; ++part) attempt(whole.substr(0, whole.size() * part / 24));
  CHECK(refused == tried);
  std::mt19937 random(3);
  for (int i = 0; i < 60; ++i) {
    std::string bytes = whole;
    // Mostly where the structure is: at the front.
    const std::size_t range = i % 3 == 0 ? bytes.size() : 1500;
    for (int flips = 0; flips < 1 + i % 4; ++flips)
      bytes[random() % range] ^= static_cast<char>(1u << random() % 8);
    attempt(bytes);
  }
  CHECK(refused > 30);
}

TEST_CASE("a level set we write is one to OpenVDB, and reads back with the same values") {
  const Folder folder;
  const LevelSet it = ball(1, 0.07);
  const auto file = folder.path() / "ours.vdb";
  plexway::openvdb::write_level_set(file, it);
  CHECK(folder.files() == 1);
  ::openvdb::initialize();
  ::openvdb::io::File in(file.string());
  in.open();
  const auto grid = ::openvdb::gridPtrCast<FloatGrid>(in.readGrid("surface"));
  CHECK(grid->getGridClass() == ::openvdb::GRID_LEVEL_SET);
  CHECK(grid->transform().voxelSize().x() == Approx(0.07));
  CHECK(grid->background() == Approx(0.21));
  CHECK(grid->activeVoxelCount() == it.active_voxels());
  for (int x = -16; x <= 16; x += 2)
    for (int y = -16; y <= 16; y += 3)
      CHECK(grid->tree().getValue({x, y, 3}) ==
            Approx(it({0.07 * x, 0.07 * y, 0.21})).margin(1e-6));
  const auto back = read_level_set(file);
  CHECK(back.inside_voxels() == it.inside_voxels());
  CHECK_THROWS_AS(plexway::openvdb::write_level_set(folder.path(), it), plexway::Error);
  CHECK_THROWS_AS(plexway::openvdb::write_level_set(folder.path() / "no" / "x.vdb", it),
                  plexway::Error);
}

// What becomes of the file where writing fails.

using plexway::openvdb::write_level_set;

namespace {

namespace fs = std::filesystem;

/// As on a full disk: no file grows beyond a size.
class SmallFiles {
 public:
  explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small = {bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

std::string complaint_when_full(const fs::path& file, const LevelSet& level_set, rlim_t bytes) {
  const SmallFiles full(bytes);
  return message_of<plexway::Error>([&] { write_level_set(file, level_set); });
}

}  // namespace

TEST_CASE("a level set that does not fit the disk leaves the file there was") {
  const Folder folder;
  const LevelSet small = ball(1, 0.2), large = ball(1, 0.05);
  const auto whole = folder.path() / "whole.vdb";
  write_level_set(whole, large);
  const auto needed = static_cast<rlim_t>(fs::file_size(whole));
  REQUIRE(needed > 200000);
  const auto file = folder.path() / "a.vdb";
  write_level_set(file, small);
  const std::string before = bytes_of(file);
  for (const rlim_t room : {rlim_t{0}, rlim_t{1}, rlim_t{1000}, rlim_t{100000}, needed - 100}) {
    INFO(room << " bytes of " << needed);
    const std::string said = complaint_when_full(file, large, room);
    CHECK_THAT(said, Contains("cannot write") && Contains("a.vdb: File too large"));
    CHECK(bytes_of(file) == before);
    CHECK(folder.files() == 2);
    CHECK_THAT(complaint_when_full(folder.path() / "new.vdb", large, room), Contains("too large"));
    CHECK(folder.files() == 2);
  }
  CHECK(read_level_set(file).inside_voxels() == small.inside_voxels());
  write_level_set(file, large);
  CHECK(read_level_set(file).inside_voxels() == large.inside_voxels());
  CHECK(folder.files() == 2);
}

TEST_CASE("a field that does not fit the disk leaves the file there was") {
  const Folder folder;
  const auto solid = plexway::openvdb::fill(ball(1, 0.1));
  std::vector<double> distance;
  for (const Point& p : solid.positions) distance.push_back(std::sqrt(dot(p, p)));
  const auto file = folder.write("field.vdb", "what there was");
  const std::string said = [&] {
    const SmallFiles full(3000);
    return message_of<plexway::Error>(
        [&] { (void)plexway::openvdb::write_field(file, solid.positions, solid.tets, distance); });
  }();
  CHECK_THAT(said, Contains("field.vdb: File too large"));
  CHECK(bytes_of(file) == "what there was");
  CHECK(folder.files() == 1);
}

TEST_CASE("a level set written to a link lands where the link points") {
  const Folder folder;
  const LevelSet it = ball(1, 0.2);
  fs::create_directory(folder.path() / "far");
  const auto target = folder.write("far/target.vdb", "before");
  const auto link = folder.path() / "link.vdb", twice = folder.path() / "twice.vdb";
  fs::create_symlink("far/target.vdb", link);
  fs::create_symlink(link, twice);
  write_level_set(twice, it);
  CHECK(fs::is_symlink(link));
  CHECK(fs::is_symlink(twice));
  CHECK(fs::is_regular_file(fs::symlink_status(target)));
  CHECK(read_level_set(target).inside_voxels() == it.inside_voxels());
  CHECK(read_level_set(twice).inside_voxels() == it.inside_voxels());

  const auto dangling = folder.path() / "dangling.vdb";
  fs::create_symlink("far/new.vdb", dangling);
  write_level_set(dangling, it);
  CHECK(fs::is_symlink(dangling));
  CHECK(read_level_set(folder.path() / "far" / "new.vdb").inside_voxels() == it.inside_voxels());

  const auto circle = folder.path() / "circle.vdb";
  fs::create_symlink("circle.vdb", circle);
  CHECK_THAT(message_of<plexway::Error>([&] { write_level_set(circle, it); }),
             Contains("cannot write"));
  CHECK(fs::is_symlink(circle));
  CHECK(folder.files() == 5);
}

TEST_CASE("a level set goes straight into a device, and no file of another writer is touched") {
  const Folder folder;
  const LevelSet it = ball(1, 0.2);
  if (fs::is_character_file("/dev/full"))
    CHECK_THAT(message_of<plexway::Error>([&] { write_level_set("/dev/full", it); }),
               Contains("/dev/full: No space left"));
  CHECK_NOTHROW(write_level_set("/dev/null", it));
  CHECK(fs::is_character_file("/dev/null"));

  const auto file = folder.path() / "a.vdb";
  const auto others = folder.write("a.vdb.part0", "of another writer");
  write_level_set(file, it);
  CHECK(bytes_of(others) == "of another writer");
  CHECK(read_level_set(file).inside_voxels() == it.inside_voxels());
  CHECK(folder.files() == 2);
}

}  // namespace files_test
