// Reading in whatever state the caller is in: much memory, closed descriptors, low limits.

#include <pthread.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <new>
#include <thread>
#include <vector>

#include <plexway/openvdb/level_set.hpp>

#include "helper_programs.hpp"
#include "volumes.hpp"

namespace caller_test {

using namespace volume_testing;
using Catch::Contains;
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
  CHECK(complaint_of(file).empty());
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
  const auto file = folder.path() / "a.vdb";
  const LevelSet it = ball(1, 0.1);
  write_level_set(file, it);
  // By now there are threads of OpenVDB's, which may hold locks at the moment of a fork.
  for (int closed = 1; closed < 8; ++closed) {
    INFO("closed, as bits: " << closed);
    const std::size_t inside = it.inside_voxels();
    CHECK(status_of_child([&] {
            for (int number = 0; number < 3; ++number)
              if ((closed >> number & 1) != 0) ::close(number);
            return read_level_set(file).inside_voxels() == inside ? 0 : 1;
          }) == 0);
  }
}

namespace {
std::atomic<int> forks = 0;
}

TEST_CASE("no fork: locks of other threads do no harm, whatever they do") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb";
  const LevelSet it = ball(1, 0.1);
  write_level_set(file, it);
  // A fork would call this, and a child of it inherit what the threads below hold.
  ::pthread_atfork([] { ++forks; }, nullptr, nullptr);
  std::atomic<bool> enough = false;
  std::vector<std::thread> threads;
  for (int n = 0; n < 3; ++n)
    threads.emplace_back([&] {
      while (!enough) {
        const auto more = fill(ball(0.5, 0.1));
        try {
          (void)read_level_set(folder.path() / "none.vdb");
        } catch (const plexway::InputError&) {
        }
      }
    });
  for (int n = 0; n < 12; ++n) CHECK(read_level_set(file).inside_voxels() == it.inside_voxels());
  enough = true;
  for (std::thread& thread : threads) thread.join();
  CHECK(forks == 0);
}

TEST_CASE("a caller that blocks signals, or has its children reaped") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb";
  write_level_set(file, ball(1, 0.1));
  CHECK(status_of_child([&] {
          sigset_t all;
          ::sigfillset(&all);
          ::sigprocmask(SIG_BLOCK, &all, nullptr);
          std::signal(SIGCHLD, SIG_IGN);
          (void)read_level_set(file);
          return 0;
        }) == 0);
}

TEST_CASE("the file is blamed for what it does, not for a helper that was killed or is not there") {
  const Folder folder;
  const auto file = folder.path() / "a.vdb";
  write_level_set(file, ball(1, 0.1));
  const auto blames_file = [&](const std::string& with) {
    try {
      (void)read_level_set(file);
    } catch (const plexway::InputError& error) {
      CHECK_THAT(error.what(), Contains(with));
      return true;
    } catch (const plexway::Error& error) {
      CHECK_THAT(error.what(), Contains(with));
    }
    return false;
  };
  const auto as = [&](const std::string& script, const std::string& with) {
    const testing::FakeHelper helper("plexway-openvdb", script);
    INFO(script);
    return blames_file(with);
  };
  const std::string ready = R"(printf '\001\000\000\000' >&3; )";
  CHECK_FALSE(as("kill -9 $$", "was killed (signal 9): memory may have run out"));
  CHECK_FALSE(as(ready + "kill -9 $$", "was killed (signal 9): memory may have run out"));
  CHECK_FALSE(as(ready + "kill -TERM $$", "was ended by signal 15"));
  CHECK_FALSE(as("kill -SEGV $$", "was ended by signal 11"));
  CHECK_FALSE(as("exit 127", "ended early, with code 127"));
  CHECK_FALSE(as("exit 65", "of another version"));
  CHECK(as(ready + "kill -SEGV $$", "the file is damaged"));
  CHECK(as(ready + "kill -XCPU $$", "comes to no end"));
  CHECK(as(ready + "printf 'what is this' >&3", "nonsense"));
  {
    const testing::FakeHelper helper("another", "exit 0");
    CHECK_THROWS_AS(read_level_set(file), plexway::NotBuiltError);
  }
  {
    const testing::FakeHelper helper("plexway-openvdb", ready + R"(printf '\007\000\000\000' >&3)");
    CHECK_THROWS_AS(read_level_set(file), std::bad_alloc);
  }
  CHECK(read_level_set(file).inside_voxels() > 0);
}

TEST_CASE("a pipe is refused at once") {
  const Folder folder;
  const auto pipe = folder.path() / "a.vdb";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THAT(complaint_of(pipe), Contains("no regular file"));
}

}  // namespace caller_test
