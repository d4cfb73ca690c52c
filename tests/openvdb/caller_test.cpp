// Reading in whatever state the caller is in: much memory, closed descriptors, low limits.

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <plexway/openvdb/level_set.hpp>

#include "volumes.hpp"

using namespace volume_testing;
using plexway::openvdb::read_level_set;
using plexway::openvdb::write_level_set;

namespace {

std::string complaint_of(const std::filesystem::path& file) {
  return message_of<plexway::Error>([&] { (void)read_level_set(file); });
}

/// The status of a process that does this, which returns its exit code.
template <class Act>
int status_of_child(Act act) {
  const pid_t pid = ::fork();
  if (pid == 0) {
    int code = 99;
    try {
      code = act();
    } catch (...) {
      code = 98;
    }
    ::_exit(code);
  }
  int status = -1;
  REQUIRE(::waitpid(pid, &status, 0) == pid);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

#if !defined(PLEXWAY_SANITIZED)
TEST_CASE("a caller with gibibytes of data reads level sets as any other") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb";
  const LevelSet it = ball(1, 0.1);
  write_level_set(file, it);
  struct Free {
    void operator()(void* block) const { std::free(block); }
  };
  // Not touched, so it takes no memory, but counts as data.
  const std::unique_ptr<void, Free> block(std::calloc(3, std::size_t{1} << 30));
  if (block == nullptr) return;
  CHECK(complaint_of(file) == "no complaint");
  CHECK(read_level_set(file).inside_voxels() == it.inside_voxels());
}

TEST_CASE("a child without memory ends, and never goes on in the caller's code") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb";
  write_level_set(file, ball(1, 0.1));
  const auto marks = folder.path() / "marks";
  // The limit is the caller's own and below what it has, so not one page more can be had.
  const int code = status_of_child([&] {
    const pid_t self = ::getpid();
    const rlimit tight = {1 << 20, 1 << 20};
    std::vector<void*> all(100000);  // never freed
    ::setrlimit(RLIMIT_DATA, &tight);
    for (std::size_t i = 0; i < all.size(); ++i)
      if ((all[i] = std::malloc(std::size_t{1} << 15)) == nullptr) break;
    int seen = 0;
    try {
      (void)read_level_set(file);
    } catch (const plexway::Error&) {
      seen = 1;
    } catch (const std::bad_alloc&) {
      seen = 2;
    }
    if (::getpid() != self) {
      (void)::mkdir(marks.c_str(), 0700);
      ::_exit(97);
    }
    return seen;
  });
  CHECK(code >= 0);
  CHECK(code <= 2);
  CHECK_FALSE(std::filesystem::exists(marks));
}
#endif

TEST_CASE("closed standard descriptors do not make a good file a damaged one") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb", count = folder.path() / "count.txt";
  // In a process of its own: OpenVDB's threads may hold locks at the moment of a fork.
  REQUIRE(status_of_child([&] {
            const LevelSet it = ball(1, 0.1);
            write_level_set(file, it);
            std::ofstream(count) << it.inside_voxels();
            return 0;
          }) == 0);
  std::size_t inside = 0;
  std::ifstream(count) >> inside;
  REQUIRE(inside > 0);
  for (int closed = 1; closed < 8; ++closed) {
    INFO("closed, as bits: " << closed);
    CHECK(status_of_child([&] {
            for (int number = 0; number < 3; ++number)
              if ((closed >> number & 1) != 0) ::close(number);
            return read_level_set(file).inside_voxels() == inside ? 0 : 1;
          }) == 0);
  }
}
