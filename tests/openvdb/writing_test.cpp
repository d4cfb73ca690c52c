// What becomes of the file where writing fails.

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include <plexway/openvdb/field.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "volumes.hpp"

namespace writing_test {

using namespace volume_testing;
using Catch::Contains;
using plexway::openvdb::read_level_set;
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

}  // namespace writing_test
