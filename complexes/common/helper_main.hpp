#pragma once

#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include <plexway/version.hpp>

#include "plain_bytes.hpp"

/// The helper's side of `helper_process.hpp`.
namespace plexway::detail::isolated {

/// All of it, or the helper ends.
inline void send_answer(const void* bytes, std::size_t size) {
  const char* at = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t sent = ::write(to_caller, at, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) ::_exit(1);
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

/// What the caller told, to its end. A crash is silent and leaves no file, and nothing goes on that
/// nobody would hear the end of. Does not return where it is not a caller of the same version that
/// runs this.
inline std::string begin_as_helper(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "%s: is run by plexway, and does nothing by itself\n",
                 argc > 0 ? argv[0] : "helper");
    ::_exit(2);
  }
  if (std::string_view(argv[1]) != version_string) ::_exit(helper_is_foreign);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (std::to_string(::getppid()) != argv[2]) ::_exit(1);  // it went before that
#endif
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  std::string told;
  std::array<char, 1 << 16> buffer;
  for (;;) {
    const ssize_t got = ::read(STDIN_FILENO, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) ::_exit(1);
    if (got == 0) return told;
    told.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace plexway::detail::isolated
