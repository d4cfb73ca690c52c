// OpenVDB in a child process: of a file with a flipped bit it may read beyond its buffers, loop or
// ask for all memory there is. The child hands bricks over through a pipe, and they are checked.

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <system_error>

#include <plexway/error.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "grid_copy.hpp"

namespace plexway::openvdb {
namespace {

enum class Word : std::uint32_t { head = 1, brick, inside, end, complaint };

class Writer {
 public:
  explicit Writer(int to) : to_(to) { buffer_.reserve(1 << 16); }
  template <class Plain>
  void put(const Plain& value) {
    put(&value, sizeof value);
  }
  void put(const std::string& text) {
    put(static_cast<std::uint64_t>(text.size()));
    put(text.data(), text.size());
  }
  void put(const void* bytes, std::size_t size) {
    buffer_.append(static_cast<const char*>(bytes), size);
    if (buffer_.size() > (1 << 15)) flush();
  }
  void flush() {
    for (std::size_t sent = 0; sent < buffer_.size();) {
      const ssize_t now = ::write(to_, buffer_.data() + sent, buffer_.size() - sent);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) ::_exit(1);
      sent += static_cast<std::size_t>(now);
    }
    buffer_.clear();
  }

 private:
  int to_;
  std::string buffer_;
};

/// False once the child has gone silent.
class Reader {
 public:
  explicit Reader(int from) : from_(from), buffer_(1 << 16, '\0') {}
  template <class Plain>
  bool get(Plain& value) {
    return get(&value, sizeof value);
  }
  bool get(std::string& text) {
    std::uint64_t size = 0;
    if (!get(size) || size > (1 << 20)) return false;
    text.resize(size);
    return get(text.data(), size);
  }
  bool get(void* bytes, std::size_t size) {
    auto* to = static_cast<char*>(bytes);
    while (size > 0) {
      if (at_ == end_ && !refill()) return false;
      const std::size_t some = std::min(size, end_ - at_);
      std::memcpy(to, buffer_.data() + at_, some);
      to += some;
      at_ += some;
      size -= some;
    }
    return true;
  }

 private:
  bool refill() {
    ssize_t got = 0;
    do got = ::read(from_, buffer_.data(), buffer_.size());
    while (got < 0 && errno == EINTR);
    at_ = 0;
    end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
    return got > 0;
  }

  int from_;
  std::string buffer_;
  std::size_t at_ = 0, end_ = 0;
};

// What a whole file of that size can need, by far; a damaged one may ask for anything.
void limit_resources(std::uintmax_t file_bytes) {
  const rlimit no_core = {0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  const rlim_t seconds = 20 + file_bytes / (1 << 20);
  const rlimit time = {seconds, seconds + 1};
  ::setrlimit(RLIMIT_CPU, &time);
#if defined(RLIMIT_DATA) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // (Sanitizers map terabytes of their own.)
  const rlim_t bytes = (rlim_t{2} << 30) + 400 * file_bytes;
  const rlimit memory = {bytes, bytes};
  ::setrlimit(RLIMIT_DATA, &memory);
#endif
}

[[noreturn]] void child(const std::string& file, const std::string& grid, int answer) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGPIPE})
    std::signal(signal, SIG_DFL);
#ifdef __linux__
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  std::error_code ignored;
  limit_resources(std::filesystem::file_size(file, ignored));
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  Writer out(answer);
  std::string complaint;
  try {
    copy_grid(
        file, grid,
        [&](const GridHead& head) {
          out.put(Word::head);
          out.put(head.frame);
          out.put(head.background);
          out.put(static_cast<std::uint64_t>(head.active));
          out.put(head.name);
        },
        [&](const Cell& corner, const float* values) {
          out.put(values == nullptr ? Word::inside : Word::brick);
          out.put(corner);
          if (values != nullptr) out.put(values, 512 * sizeof(float));
        });
  } catch (const std::bad_alloc&) {
    complaint = "OpenVDB runs out of memory on it, so it is damaged, or too large";
  } catch (const std::exception& error) {
    complaint = error.what();
  } catch (...) {
    complaint = "OpenVDB cannot read it";
  }
  out.put(complaint.empty() ? Word::end : Word::complaint);
  if (!complaint.empty()) out.put(complaint.substr(0, 1000));
  out.flush();
  ::_exit(0);
}

std::shared_ptr<Bricks> listen_to(int answer, std::string& complaint) {
  complaint = "OpenVDB crashes on it: the file is damaged";
  Reader in(answer);
  auto bricks = std::make_shared<Bricks>();
  std::vector<float> values(512);
  for (Word word{}; in.get(word);) {
    if (word == Word::end) {
      complaint.clear();
      return bricks;
    }
    if (word == Word::complaint) {
      std::string said;
      if (in.get(said)) complaint = said;
      return nullptr;
    }
    Cell corner{};
    std::uint64_t active = 0;
    bool good = false;
    if (word == Word::head) {
      good = in.get(bricks->frame) && in.get(bricks->background) && in.get(active) &&
             in.get(bricks->name);
      bricks->active = active;
    } else if (word == Word::inside || word == Word::brick) {
      good = in.get(corner) && (word == Word::inside || in.get(values.data(), 512 * sizeof(float)));
      if (good && word == Word::brick) bricks->add(corner, values.data());
      if (good && word == Word::inside) bricks->add_inside(corner);
    }
    if (!good) return nullptr;
  }
  return nullptr;
}

struct Descriptor {
  int number = -1;
  ~Descriptor() { close(); }
  void close() {
    if (number >= 0) ::close(number);
    number = -1;
  }
};

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status))
    throw InputError(file.string() + ": is a directory, not a file");
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (in.number < 0)
    throw InputError(file.string() + ": cannot be read: " + std::generic_category().message(errno));
  std::array<unsigned char, 8> magic{};
  const ssize_t got = ::read(in.number, magic.data(), magic.size());
  constexpr std::array<unsigned char, 8> wanted = {0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};
  if (got != 8 || magic != wanted)
    throw InputError(file.string() + ": is no OpenVDB file: it does not begin as one");
}

}  // namespace

LevelSet read_level_set(const std::filesystem::path& file, std::string_view grid) {
  require_file(file);
  std::array<int, 2> ends = {-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error("cannot run OpenVDB: " + std::generic_category().message(errno));
  Descriptor answer{ends[0]}, speech{ends[1]};
  const pid_t pid = ::fork();
  if (pid < 0) throw Error("cannot run OpenVDB: " + std::generic_category().message(errno));
  if (pid == 0) child(file.string(), std::string(grid), speech.number);
  speech.close();

  std::string complaint;
  std::shared_ptr<Bricks> bricks;
  std::exception_ptr failure;
  try {
    bricks = listen_to(answer.number, complaint);
  } catch (...) {
    failure = std::current_exception();
  }
  ::kill(pid, SIGKILL);
  while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (failure) std::rethrow_exception(failure);
  if (!bricks) {
    std::replace(complaint.begin(), complaint.end(), '\n', ' ');
    throw InputError(file.string() + ": " + complaint);
  }
  LevelSet level_set(bricks);
  if (level_set.inside_voxels() == 0)
    throw InputError(file.string() + ": grid '" + bricks->name +
                     "' is negative nowhere: nothing lies inside");
  return level_set;
}

}  // namespace plexway::openvdb
