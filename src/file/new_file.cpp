#include "file/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::detail::file {
namespace {

// Who takes a name out of its place owns it. Never destroyed: a handler may come at any time.
constinit std::array<std::atomic<char*>, 64> names{};
static_assert(std::atomic<char*>::is_always_lock_free);

}  // namespace

Unfinished::Unfinished(const char* path) : place_(names.size()) {
  char* const name = ::strdup(path);
  if (name == nullptr) return;
  for (place_ = 0; place_ < names.size(); ++place_) {
    char* nobody = nullptr;
    if (names[place_].compare_exchange_strong(nobody, name)) return;
  }
  std::free(name);
}

Unfinished::~Unfinished() {
  if (place_ < names.size()) std::free(names[place_].exchange(nullptr));
}

void remove_unfinished() noexcept {
  for (auto& place : names)
    if (char* const name = place.exchange(nullptr); name != nullptr) ::unlink(name);
}

SignalsHeld::SignalsHeld() {
  static_assert(sizeof(sigset_t) <= sizeof before_);
  sigset_t ending, before;
  ::sigemptyset(&ending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&ending, signal);
  ::pthread_sigmask(SIG_BLOCK, &ending, &before);
  std::memcpy(before_, &before, sizeof before);
}

SignalsHeld::~SignalsHeld() {
  sigset_t before;
  std::memcpy(&before, before_, sizeof before);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

namespace fs = std::filesystem;

namespace {

constexpr int most_attempts = 1000;

// Held on what lies beside its place for as long as its writer lives. Of the open file, and so not
// in the way of flock(), which other people's libraries take.
bool claim([[maybe_unused]] int descriptor) {
#ifdef F_OFD_SETLK
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return ::fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
#else
  return false;
#endif
}

bool is_named(int descriptor, const fs::path& name) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// What a writer left that was killed: of ours by its name, and claimed by nobody.
void remove_left_over(const fs::path& name) {
  const int descriptor = ::open(name.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  struct stat it {};
  if (::fstat(descriptor, &it) == 0 && S_ISREG(it.st_mode) && it.st_uid == ::geteuid() &&
      claim(descriptor) && is_named(descriptor, name))
    ::unlink(name.c_str());
  ::close(descriptor);
}

}  // namespace

fs::path end_of_links(fs::path file) {
  for (int links = 0; links < 40; ++links) {
    std::error_code none_here;
    if (!fs::is_symlink(fs::symlink_status(file, none_here))) return file;
    file = file.parent_path() / fs::read_symlink(file);
  }
  throw std::system_error(std::make_error_code(std::errc::too_many_symbolic_link_levels));
}

NewFile::NewFile(const fs::path& file) : given_(file), target_(file) {
  if (!format_on_standard_output(file.string()).empty()) {
    standard_output_ = true;
    std::fflush(stdout);  // what was said before comes before
    descriptor_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) refuse(errno);
    return;
  }
  try {
    target_ = end_of_links(file);
  } catch (const std::system_error& error) {
    refuse(error.code().value());
  }
  struct stat old {};
  const bool exists = ::stat(target_.c_str(), &old) == 0;
  if (!exists && errno != ENOENT) refuse(errno);
  if (exists && S_ISDIR(old.st_mode)) refuse(EISDIR);
  if (exists && ::access(target_.c_str(), W_OK) != 0) refuse(errno);
  if (exists && !S_ISREG(old.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) refuse(errno);
    return;
  }
  open_nameless();
  if (descriptor_ < 0) open_named();
  if (descriptor_ < 0) refuse(errno);
  if (!exists) return;
  // Who may not give files away keeps what is written.
  if (old.st_uid != ::geteuid() || old.st_gid != ::getegid())
    (void)!::fchown(descriptor_, old.st_uid, old.st_gid);
  (void)!::fchmod(descriptor_, old.st_mode & 07777);
}

NewFile::~NewFile() { discard(); }

void NewFile::open_nameless() {
#ifdef O_TMPFILE
  if (always_named) return;
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
  if (descriptor_ < 0) return;
  way_ = Way::nameless;
  // Its name comes by way of /proc.
  if (::access(place().c_str(), F_OK) == 0) return;
  ::close(descriptor_);
  descriptor_ = -1;
#endif
}

void NewFile::open_named() {
  const SignalsHeld held;
  // A name that is taken is refused, so two writers never share a temporary file.
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    written_ = beside(attempt);
    remove_left_over(written_);
    descriptor_ = ::open(written_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      // Until it is claimed another writer may take it for one that was left.
      (void)claim(descriptor_);
      if (is_named(descriptor_, written_)) {
        way_ = Way::named;
        listed_.emplace(written_.c_str());
        return;
      }
      ::close(descriptor_);
      descriptor_ = -1;
      errno = EEXIST;
    }
    if (errno != EEXIST) return;
  }
}

fs::path NewFile::beside(int attempt) const {
  fs::path name = target_;
  return name += ".plexway-part" + std::to_string(attempt);
}

std::string NewFile::place() const {
  if (way_ == Way::nameless || standard_output_)
    return "/proc/self/fd/" + std::to_string(descriptor_);
  return way_ == Way::named ? written_.string() : target_.string();
}

int NewFile::write(const char* bytes, std::size_t size) noexcept {
  while (size > 0) {
    const ssize_t sent = ::write(descriptor_, bytes, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return errno;
    bytes += sent;
    size -= static_cast<std::size_t>(sent);
  }
  return 0;
}

int NewFile::synchronise() noexcept {
  // What cannot be synchronised, such as a pipe, says EINVAL.
  const int failed = ::fsync(descriptor_) == 0 ? 0 : errno;
  return failed == EINVAL || failed == EROFS ? 0 : failed;
}

// A link never replaces a file, so where there is one it takes a name beside it first.
int NewFile::link_nameless() {
  const auto link_to = [&](const fs::path& name) {
    return ::linkat(AT_FDCWD, place().c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW);
  };
  if (link_to(target_) == 0) return 0;
  int reason = errno;
  if (reason == EEXIST) (void)claim(descriptor_);
  for (int attempt = 0; reason == EEXIST && attempt < most_attempts; ++attempt) {
    const fs::path name = beside(attempt);
    remove_left_over(name);
    if (link_to(name) != 0) {
      reason = errno;
      continue;
    }
    const Unfinished listed(name.c_str());
    if (::rename(name.c_str(), target_.c_str()) == 0) return 0;
    const int failed = errno;
    ::unlink(name.c_str());
    return failed;
  }
  return reason;
}

void NewFile::commit() {
  int failed = 0;
  {
    const SignalsHeld held;
    if (way_ == Way::nameless) failed = link_nameless();
    const int closing = descriptor_;
    if (failed == 0) {
      descriptor_ = -1;
      if (::close(closing) != 0 && errno != EINTR) failed = errno;
    }
    if (failed == 0 && way_ == Way::named && ::rename(written_.c_str(), target_.c_str()) != 0)
      failed = errno;
    if (failed != 0 && way_ == Way::named) ::unlink(written_.c_str());
    listed_.reset();
  }
  if (failed != 0) refuse(failed);
}

void NewFile::discard() noexcept {
  if (descriptor_ < 0) return;
  ::close(descriptor_);
  descriptor_ = -1;
  if (way_ == Way::named) ::unlink(written_.c_str());
  listed_.reset();
}

void NewFile::refuse(int reason) {
  if (standard_output_ && reason == EPIPE) {
    discard();
    throw OutputClosed{};
  }
  refuse(std::generic_category().message(reason));
}

void NewFile::refuse(const std::string& reason) {
  discard();
  throw Error("cannot write " + given_.string() + ": " + reason);
}

}  // namespace plexway::detail::file
