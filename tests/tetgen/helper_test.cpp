// TetGen's program: what ends it is told, and not blamed on the surface.

#include <catch2/catch.hpp>
#include <csignal>
#include <new>
#include <string>

#include <plexway/error.hpp>

#include "helper_programs.hpp"
#include "tetgen/solids.hpp"

namespace helper_test {

using namespace tetgen_testing;
using Catch::Contains;

namespace {

// Whether the surface is blamed, in words with `with`.
bool blames_surface(const std::string& script, const std::string& with, const Shape& shape) {
  const testing::FakeHelper helper("plexway-tetgen", script);
  INFO(script);
  try {
    fill(shape);
    FAIL("no error");
  } catch (const plexway::InputError& error) {
    CHECK_THAT(error.what(), Contains(with));
    return true;
  } catch (const plexway::Error& error) {
    CHECK_THAT(error.what(), Contains(with));
  }
  return false;
}

}  // namespace

TEST_CASE("the surface is not blamed for a helper that was killed or is not there") {
  // More than a pipe holds, and none of these reads it.
  const Shape large = samples::geodesic_sphere(40);
  const auto before = std::signal(SIGPIPE, SIG_DFL);
  CHECK_FALSE(
      blames_surface("kill -9 $$", "was killed (signal 9): memory may have run out", large));
  CHECK_FALSE(blames_surface("kill -HUP $$", "was ended by signal 1", large));
  CHECK_FALSE(blames_surface("exit 3", "ended early, with code 3", large));
  CHECK_FALSE(blames_surface("exit 65", "of another version", large));
  CHECK_FALSE(blames_surface("cat >/dev/null; kill -9 $$", "was killed (signal 9)", large));
  CHECK(blames_surface("cat >/dev/null; kill -ABRT $$", "TetGen gives up", cube()));
  std::signal(SIGPIPE, before);
  {
    const testing::FakeHelper helper("another", "exit 0");
    CHECK_THROWS_AS(fill(cube()), plexway::NotBuiltError);
  }
  {
    const testing::FakeHelper helper(
        "plexway-tetgen",
        "cat >/dev/null; for i in 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
        "0 0 0 0; do printf \"\\\\00$i\" >&3; done");
    CHECK_THROWS_AS(fill(cube()), std::bad_alloc);
  }
  CHECK_FALSE(fill(cube()).tets.empty());
}

}  // namespace helper_test
