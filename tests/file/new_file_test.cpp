// Files that appear whole or not at all, with and without files that have no name until then.

#include "file/new_file.hpp"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <string>

#include <plexway/error.hpp>

#include "io/io_testing.hpp"

namespace new_file_test {

using io_testing::bytes_of;
using io_testing::Folder;
using plexway::detail::file::NewFile;
namespace fs = std::filesystem;

namespace {

void write(NewFile& file, const std::string& text) {
  REQUIRE(file.write(text.data(), text.size()) == 0);
}

void write_whole(const fs::path& name, const std::string& text) {
  NewFile file(name);
  write(file, text);
  file.commit();
}

mode_t mode_of(const fs::path& file) {
  struct stat it {};
  REQUIRE(::stat(file.c_str(), &it) == 0);
  return it.st_mode & 07777;
}

// Both ways to write, one after the other.
template <class Test>
void both_ways(Test test) {
  for (const bool named : {false, true}) {
    INFO((named ? "with a name" : "without a name"));
    NewFile::always_named = named;
    const Folder folder;
    test(folder);
  }
  NewFile::always_named = false;
}

}  // namespace

TEST_CASE("a new file is there once it is whole, and leaves nothing else") {
  both_ways([](const Folder& folder) {
    const fs::path name = folder.at("a.txt");
    {
      NewFile file(name);
      write(file, "half");
      CHECK_FALSE(fs::exists(name));
    }
    CHECK(folder.files() == 0);
    write_whole(name, "first");
    CHECK(bytes_of(name) == "first");
    write_whole(name, "second");
    CHECK(bytes_of(name) == "second");
    {
      NewFile file(name);
      write(file, "half");
    }
    CHECK(bytes_of(name) == "second");
    CHECK(folder.files() == 1);
    // Names for temporary files that are taken are somebody's.
    folder.write("a.txt.part0", "mine");
    write_whole(name, "third");
    CHECK(bytes_of(name) == "third");
    CHECK(bytes_of(folder.at("a.txt.part0")) == "mine");
    CHECK(folder.files() == 2);
  });
}

TEST_CASE("what a killed writer leaves goes with the next one, and what a living one has stays") {
  const Folder folder;
  const fs::path name = folder.write("a.txt", "old");
  NewFile::always_named = true;
  for (int killed = 0; killed < 3; ++killed) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      NewFile file(name);
      (void)file.write("half", 4);
      ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    CHECK(folder.files() == 2);  // each takes the place of the one before
  }
  CHECK(bytes_of(name) == "old");
  {
    NewFile one(name), other(name);
    write(one, "one");
    write(other, "other");
    CHECK(folder.files() == 3);
    CHECK(one.place() != other.place());
    other.commit();
    CHECK(bytes_of(name) == "other");
    one.commit();
    CHECK(bytes_of(name) == "one");
  }
  CHECK(folder.files() == 1);
  // Without a name there may be one for a moment, while a file is replaced.
  folder.write("a.txt.plexway-part0", "left at that moment");
  NewFile::always_named = false;
  write_whole(name, "new");
  CHECK(bytes_of(name) == "new");
  CHECK(folder.files() == 1);
  // Folders and links are left alone.
  fs::create_directory(folder.at("a.txt.plexway-part0"));
  fs::create_symlink("a.txt", folder.at("a.txt.plexway-part1"));
  for (const bool named : {false, true}) {
    NewFile::always_named = named;
    write_whole(name, "newer");
    CHECK(bytes_of(name) == "newer");
    CHECK(folder.files() == 3);
  }
  NewFile::always_named = false;
}

TEST_CASE("a link stays a link, be there a file at its end or not") {
  both_ways([](const Folder& folder) {
    fs::create_directory(folder.at("deep"));
    fs::create_symlink("deep/end.txt", folder.at("middle"));
    fs::create_symlink(folder.at("middle"), folder.at("start"));
    for (const std::string text : {"created", "replaced"}) {
      write_whole(folder.at("start"), text);
      CHECK(fs::is_symlink(folder.at("start")));
      CHECK(fs::is_symlink(folder.at("middle")));
      CHECK(bytes_of(folder.at("deep") / "end.txt") == text);
    }
    CHECK(folder.files() == 3);
    fs::create_symlink("nowhere/end.txt", folder.at("dead"));
    CHECK_THROWS_AS(NewFile(folder.at("dead")), plexway::Error);
    fs::create_symlink("round", folder.at("round"));
    CHECK_THROWS_AS(NewFile(folder.at("round")), plexway::Error);
    CHECK_THROWS_AS(NewFile(folder.path()), plexway::Error);
  });
}

TEST_CASE("a replaced file gives its mode and owner to the new one") {
  both_ways([](const Folder& folder) {
    const fs::path name = folder.write("a.txt", "old");
    for (const mode_t mode : {0600u, 0640u, 0755u, 0666u}) {
      REQUIRE(::chmod(name.c_str(), mode) == 0);
      write_whole(name, "new");
      CHECK(mode_of(name) == mode);
    }
    const mode_t mask = ::umask(027);
    write_whole(folder.at("fresh.txt"), "new");
    ::umask(mask);
    CHECK(mode_of(folder.at("fresh.txt")) == 0640);
    if (::geteuid() == 0) {  // only root gives files away
      REQUIRE(::chown(name.c_str(), 65534, 65534) == 0);
      write_whole(name, "newer");
      struct stat it {};
      REQUIRE(::stat(name.c_str(), &it) == 0);
      CHECK(it.st_uid == 65534);
      CHECK(it.st_gid == 65534);
      CHECK(mode_of(name) == 0666);
    } else {  // and only root writes what may not be written
      REQUIRE(::chmod(name.c_str(), 0444) == 0);
      CHECK_THROWS_AS(NewFile(name), plexway::Error);
    }
  });
}

TEST_CASE("a process that a signal ends leaves no file, whatever the signal") {
  for (const bool named : {false, true}) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
      if (named && signal == SIGKILL) continue;  // what nobody hears nobody cleans up after
      INFO(signal << (named ? ", with a name" : ", without a name"));
      const Folder folder;
      folder.write("a.txt", "old");
      const pid_t child = ::fork();
      REQUIRE(child >= 0);
      if (child == 0) {
        NewFile::always_named = named;
        const auto end_by = [](int number) {
          plexway::detail::file::remove_unfinished();
          std::signal(number, SIG_DFL);
          std::raise(number);
        };
        if (signal != SIGKILL) std::signal(signal, end_by);
        NewFile a(folder.at("a.txt")), b(folder.at("b.txt"));
        (void)a.write("half", 4);
        (void)b.write("half", 4);
        ::raise(signal);
        ::_exit(0);
      }
      int status = 0;
      REQUIRE(::waitpid(child, &status, 0) == child);
      CHECK(WIFSIGNALED(status));
      CHECK(WTERMSIG(status) == signal);
      CHECK(folder.files() == 1);
      CHECK(bytes_of(folder.at("a.txt")) == "old");
    }
  }
}

}  // namespace new_file_test
