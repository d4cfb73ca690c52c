#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <string>
#include <system_error>

#include <plexway/error.hpp>

/// For providers whose library may crash, loop or talk: it gets a process of its own (POSIX).
namespace plexway::isolated {

[[noreturn]] inline void throw_cannot_run(const char* library) {
  const int reason = errno;
  throw Error(std::string("cannot run ") + library + ": " +
              std::generic_category().message(reason));
}

/// A file descriptor that is closed with its owner.
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
  /// Away from the standard ones: a caller may have closed those, and a child puts others there.
  void move_up(const char* library) {
    if (number > STDERR_FILENO) return;
    const int up = ::fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    if (up < 0) throw_cannot_run(library);
    close();
    number = up;
  }
};

/// No other program inherits it, but a child that another thread forks meanwhile does: the end of
/// what is sent then shows only when that one ends. Throws Error, which names the library.
struct Pipe {
  Descriptor read{-1}, write{-1};

  explicit Pipe(const char* library) {
    std::array<int, 2> ends = {-1, -1};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_cannot_run(library);
    read.number = ends[0];
    write.number = ends[1];
    read.move_up(library);
    write.move_up(library);
  }
};

/// By a child: all of it, or the child ends.
inline void send(int to, const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t sent = ::write(to, at, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) ::_exit(1);
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

/// By a child: what the library says goes there, or the child ends.
inline void speak_into(int to) {
  if (::dup2(to, STDOUT_FILENO) < 0 || ::dup2(to, STDERR_FILENO) < 0) ::_exit(1);
}

/// A copy of this process that calls work() and ends; it does not outlive this object. Of threads
/// it has one, and may inherit a lock that none of its own will open. Throws Error, which names the
/// library.
class Child {
 public:
  template <class Work>
  Child(const char* library, const Work& work) : pid_(::fork()) {
    if (pid_ < 0) throw_cannot_run(library);
    if (pid_ > 0) return;
    // Nothing may leave it: there would be two processes in the caller's code.
    try {
      prepare();
      work();
    } catch (...) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  ~Child() {
    ::kill(pid_, SIGKILL);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  // A crash is silent and leaves no file; nothing goes on that nobody would hear the end of.
  static void prepare() {
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE})
      std::signal(signal, SIG_DFL);
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    const rlimit no_core = {0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
  }

  pid_t pid_;
};

}  // namespace plexway::isolated
