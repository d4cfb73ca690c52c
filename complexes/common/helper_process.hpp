#pragma once

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/version.hpp>

#include "plain_bytes.hpp"

/// For providers whose library may crash, loop or talk: it is linked into a program of its own, a
/// helper, which runs as a child process (POSIX). `helper_main.hpp` is the helper's side. A child
/// by fork alone would not do: it inherits the locks that the caller's other threads hold.
namespace plexway::detail::isolated {

[[noreturn]] inline void throw_cannot_run(const std::string& helper, int reason) {
  throw Error("cannot run " + helper + ": " + std::generic_category().message(reason));
}

/// A file descriptor that is closed with its owner. No other program inherits it.
struct Descriptor {
  int number = -1;

  explicit Descriptor(int open) : number(open) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  void close() {
    if (number >= 0) ::close(number);
    number = -1;
  }
  /// Away from those that a helper finds its own at: a caller may have closed the standard ones.
  bool move_up() {
    constexpr int first_free = 10;
    if (number >= first_free) return true;
    const int up = ::fcntl(number, F_DUPFD_CLOEXEC, first_free);
    if (up < 0) return false;
    close();
    number = up;
    return true;
  }
};

/// Where a helper is: in the folder that PLEXWAY_HELPERS names; or else beside the code at `code`,
/// beside the program, in the folder for helpers of the tree that either is in, or where they were
/// to be installed. Throws NotBuiltError where it is in none.
inline std::filesystem::path find_helper(const std::string& name, const char* library,
                                         const void* code) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (const char* const chosen = std::getenv("PLEXWAY_HELPERS"); chosen != nullptr && *chosen) {
    const fs::path file = fs::path(chosen) / name;
    if (fs::exists(file, none)) return file;
    throw NotBuiltError(file.string() + ", which runs " + library +
                        ", is not there: PLEXWAY_HELPERS names the wrong folder");
  }
  std::vector<fs::path> beside;
  Dl_info object{};
  if (::dladdr(code, &object) != 0 && object.dli_fname != nullptr &&
      std::string_view(object.dli_fname).find('/') != std::string_view::npos)
    beside.emplace_back(fs::path(object.dli_fname).parent_path());
  if (const fs::path program = fs::read_symlink("/proc/self/exe", none); !none)
    beside.push_back(program.parent_path());
  std::vector<fs::path> folders;
  for (const fs::path& folder : beside) {
    folders.push_back(folder);
    folders.push_back(folder / "plexway");
    folders.push_back(folder / ".." / PLEXWAY_HELPER_SUBFOLDER);
  }
  folders.emplace_back(PLEXWAY_HELPER_FOLDER);
  for (const fs::path& folder : folders)
    if (fs::exists(folder / name, none)) return folder / name;
  throw NotBuiltError("the program " + name + ", which runs " + library +
                      ", is not installed: it belongs into " PLEXWAY_HELPER_FOLDER
                      ", or the folder that PLEXWAY_HELPERS names");
}

/// How a helper ended.
struct HelperEnd {
  int signal = 0;  ///< that ended it, or 0
  int code = -1;   ///< what it returned, or -1

  /// By a fault of its own, such as the input may cause; not by somebody else, or want of memory.
  [[nodiscard]] bool crashed() const {
    return signal == SIGSEGV || signal == SIGABRT || signal == SIGBUS || signal == SIGFPE ||
           signal == SIGILL || signal == SIGTRAP;
  }
  /// The reason why it gave no answer, in a few words.
  [[nodiscard]] std::string text() const {
    if (signal == SIGKILL)
      return "was killed (signal 9): memory may have run out, or somebody ended it";
    if (signal != 0) return "was ended by signal " + std::to_string(signal);
    if (code >= 0) return "ended early, with code " + std::to_string(code);
    return "ended early";
  }
};

/// A running helper; it does not outlive this object. It reads what `tell` sends, and what it
/// answers is read from `answer`. What its library prints goes to `speech`, or where that is not
/// wanted, nowhere.
class Helper {
 public:
  /// `code`: any function of the caller's library. Throws Error, NotBuiltError where there is none.
  Helper(const std::string& name, const char* library, const void* code, bool listens)
      : name_(name) {
    const std::string program = find_helper(name, library, code).string();
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) refuse(errno);
    request_.number = ends[0];
    Descriptor request(ends[1]), answer(-1), speech(-1);
    make_pipe(answer_, answer);
    if (listens) make_pipe(speech_, speech);
    if (!request_.move_up() || !request.move_up()) refuse(errno);

    Spawning how;
    how.put(request.number, STDIN_FILENO);
    how.put(answer.number, 3);
    for (const int said : {STDOUT_FILENO, STDERR_FILENO}) {
      if (listens)
        how.put(speech.number, said);
      else
        ::posix_spawn_file_actions_addopen(&how.files, said, "/dev/null", O_WRONLY, 0);
    }
    std::string version = version_string, parent = std::to_string(::getpid());
    std::string own = program;
    const std::array<char*, 4> words = {own.data(), version.data(), parent.data(), nullptr};
    const int failure =
        ::posix_spawn(&pid_, program.c_str(), &how.files, &how.attributes, words.data(), environ);
    if (failure != 0) {
      pid_ = -1;
      refuse(failure);
    }
  }
  ~Helper() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;

  /// Sends all of it, and that it is all. A helper that has gone is no error: `end` tells.
  void tell(std::string_view bytes) {
    while (!bytes.empty()) {
#ifdef MSG_NOSIGNAL
      constexpr int quietly = MSG_NOSIGNAL;
#else
      constexpr int quietly = 0;
#endif
      const ssize_t sent = ::send(request_.number, bytes.data(), bytes.size(), quietly);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) break;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    ::shutdown(request_.number, SHUT_WR);
  }

  [[nodiscard]] Descriptor& answer() { return answer_; }
  [[nodiscard]] Descriptor& speech() { return speech_; }

  /// Waits for its end, for which it has a few seconds. Throws Error where it is of another
  /// version.
  HelperEnd end() {
    HelperEnd ended;
    constexpr timespec a_little = {0, 1'000'000};
    for (int waited = 0; pid_ >= 0; ++waited) {
      int status = 0;
      const pid_t gone = ::waitpid(pid_, &status, WNOHANG);
      if (gone == pid_) {
        if (WIFSIGNALED(status)) ended.signal = WTERMSIG(status);
        if (WIFEXITED(status)) ended.code = WEXITSTATUS(status);
        pid_ = -1;
      } else if (gone < 0 && errno != EINTR) {
        pid_ = -1;  // the caller has its children reaped by somebody else
      } else if (waited >= 3000) {
        return ended;
      } else {
        ::nanosleep(&a_little, nullptr);
      }
    }
    if (ended.code == helper_is_foreign)
      throw Error("cannot run " + name_ + ": it is of another version than this, " +
                  version_string);
    return ended;
  }

 private:
  // A caller may block signals, or ignore them: the helper shall hear them all.
  struct Spawning {
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;

    Spawning() {
      ::posix_spawn_file_actions_init(&files);
      ::posix_spawnattr_init(&attributes);
      sigset_t none, all;
      ::sigemptyset(&none);
      ::sigfillset(&all);
      ::posix_spawnattr_setsigmask(&attributes, &none);
      ::posix_spawnattr_setsigdefault(&attributes, &all);
      ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    }
    ~Spawning() {
      ::posix_spawn_file_actions_destroy(&files);
      ::posix_spawnattr_destroy(&attributes);
    }
    Spawning(const Spawning&) = delete;
    Spawning& operator=(const Spawning&) = delete;
    void put(int from, int to) { ::posix_spawn_file_actions_adddup2(&files, from, to); }
  };

  [[noreturn]] void refuse(int reason) const { throw_cannot_run(name_, reason); }

  void make_pipe(Descriptor& read, Descriptor& write) const {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) refuse(errno);
    read.number = ends[0];
    write.number = ends[1];
    if (!read.move_up() || !write.move_up()) refuse(errno);
  }

  std::string name_;
  Descriptor request_{-1}, answer_{-1}, speech_{-1};
  pid_t pid_ = -1;
};

}  // namespace plexway::detail::isolated
