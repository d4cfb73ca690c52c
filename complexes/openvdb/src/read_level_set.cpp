// OpenVDB in a child process: of a file with a flipped bit it may read beyond its buffers, loop or
// ask for all memory there is. The child hands bricks over through a pipe, and they are checked.

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <system_error>

#include <plexway/error.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "../../child_process.hpp"
#include "grid_copy.hpp"

namespace plexway::openvdb {
namespace {

using isolated::Descriptor;

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
    isolated::send(to_, buffer_.data(), buffer_.size());
    buffer_.clear();
  }

 private:
  int to_;
  std::string buffer_;
};

// Whether a process sleeps or is gone, and how long it has worked. False where nobody tells.
bool sleeps(pid_t process, unsigned long long& worked) {
  const std::string name = "/proc/" + std::to_string(process) + "/stat";
  const int from = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (from < 0) return false;
  std::array<char, 1024> text{};
  const ssize_t got = ::read(from, text.data(), text.size() - 1);
  ::close(from);
  const char* at = got > 0 ? std::strrchr(text.data(), ')') : nullptr;
  char state = 0;
  unsigned long long user = 0, system = 0;
  if (at == nullptr || std::sscanf(at, ") %c %*d %*d %*d %*d %*d %*u %*u %*u %*u %*u %llu %llu",
                                   &state, &user, &system) != 3)
    return false;
  worked = user + system;
  return state == 'S' || state == 'Z' || state == 'X';
}

/// False once the child has gone silent.
class Reader {
 public:
  Reader(int from, pid_t writer) : from_(from), writer_(writer), buffer_(1 << 16, '\0') {}
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

  /// Whether reading ended because the writer sleeps for good.
  [[nodiscard]] bool stuck() const { return stuck_; }

 private:
  // A child of a process with threads may inherit a lock that none of its own will open.
  bool may_come() {
    int idle = 0;
    unsigned long long before = 0;
    for (pollfd waiting{from_, POLLIN, 0}; ::poll(&waiting, 1, 500) == 0;) {
      unsigned long long now = 0;
      if (!sleeps(writer_, now)) {
        idle = 0;
      } else {
        idle = now == before ? idle + 1 : 0;
      }
      before = now;
      if (idle >= 4) {
        stuck_ = true;
        return false;
      }
    }
    return true;
  }

  bool refill() {
    if (!may_come()) return false;
    ssize_t got = 0;
    do got = ::read(from_, buffer_.data(), buffer_.size());
    while (got < 0 && errno == EINTR);
    at_ = 0;
    end_ = got > 0 ? static_cast<std::size_t>(got) : 0;
    return got > 0;
  }

  int from_;
  pid_t writer_;
  bool stuck_ = false;
  std::string buffer_;
  std::size_t at_ = 0, end_ = 0;
};

// What a whole file of that size can need, by far; a damaged one may ask for anything.
std::uint64_t bytes_needed(std::uintmax_t file_bytes) {
  return (std::uint64_t{2} << 30) + 400 * static_cast<std::uint64_t>(file_bytes);
}

// Of data that this process has already: the caller's, in a child. Nothing where nobody tells.
[[maybe_unused]] std::optional<std::uint64_t> bytes_inherited() {
  const int from = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  if (from < 0) return std::nullopt;
  std::array<char, 256> text{};
  const ssize_t got = ::read(from, text.data(), text.size() - 1);
  ::close(from);
  if (got <= 0) return std::nullopt;
  // The sixth number: pages of data and stack.
  char* at = text.data();
  unsigned long long pages = 0;
  for (int field = 0; field < 6; ++field) {
    char* const before = at;
    pages = std::strtoull(before, &at, 10);
    if (at == before) return std::nullopt;
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

// Not above what the caller is held to.
template <class Resource>
void set_limit(Resource resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min(limit.rlim_max, soft);
  ::setrlimit(resource, &limit);
}

void limit_resources(std::uintmax_t file_bytes) {
  const rlim_t seconds = 20 + file_bytes / (1 << 20);
  set_limit(RLIMIT_CPU, seconds, seconds + 1);
#if defined(RLIMIT_DATA) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // (Sanitizers map terabytes of their own.)
  if (const auto inherited = bytes_inherited()) {
    const rlim_t bytes = *inherited + bytes_needed(file_bytes);
    set_limit(RLIMIT_DATA, bytes, bytes);
  }
#endif
}

// Writes the answer; what goes wrong with OpenVDB is part of it.
void tell(const std::string& file, const std::string& grid, int answer) {
  isolated::speak_into(::open("/dev/null", O_WRONLY));
  // What the answer takes is there before memory may run out.
  constexpr std::size_t longest = 1000;
  Writer out(answer);
  std::string complaint;
  complaint.reserve(longest);
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  limit_resources(unknown ? 0 : size);
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
    complaint = std::string_view(error.what()).substr(0, longest);
    if (complaint.empty()) complaint = "OpenVDB cannot read it";
  } catch (...) {
    complaint = "OpenVDB cannot read it";
  }
  out.put(complaint.empty() ? Word::end : Word::complaint);
  if (!complaint.empty()) out.put(complaint);
  out.flush();
}

// What the child says, piece by piece. It may say anything: a damaged file may have it write
// anywhere.
class Listener {
 public:
  Listener(int answer, pid_t child, std::uint64_t bytes)
      : in_(answer, child), most_bricks_(bytes / sizeof(Values)) {}
  [[nodiscard]] bool stuck() const { return in_.stuck(); }

  /// Null with a complaint.
  std::shared_ptr<Bricks> listen(std::string& complaint) {
    complaint = "OpenVDB crashes on it: the file is damaged";
    for (Word word{}; in_.get(word);) {
      if (word == Word::complaint) {
        std::string said;
        if (in_.get(said)) complaint = said;
        return nullptr;
      }
      if (word == Word::end) {
        if (!has_head_) return nullptr;
        complaint.clear();
        return bricks_;
      }
      const bool good = word == Word::head     ? !has_head_ && take_head()
                        : word == Word::brick  ? has_head_ && take_brick()
                        : word == Word::inside ? has_head_ && take_inside()
                                               : false;
      if (!good) return nullptr;
    }
    return nullptr;
  }

 private:
  using Values = std::array<float, 512>;

  bool take_head() {
    std::uint64_t active = 0;
    if (!in_.get(bricks_->frame) || !in_.get(bricks_->background) || !in_.get(active) ||
        !in_.get(bricks_->name))
      return false;
    bricks_->active = active;
    has_head_ = true;
    const double volume = std::abs(bricks_->frame.determinant());
    bool finite = std::isfinite(bricks_->background) && std::isfinite(volume);
    for (const double x : bricks_->frame.origin) finite = finite && std::isfinite(x);
    return finite && bricks_->background > 0 && volume > 0;
  }

  bool take_brick() {
    Cell corner{};
    if (!in_.get(corner) || !in_.get(values_) || !BrickNumbers::in_range(corner)) return false;
    if (++dense_ > most_bricks_) return false;
    for (float& value : values_) {
      if (std::isnan(value)) return false;
      // Some programs write infinity where others write the background.
      if (std::isinf(value)) value = std::copysign(bricks_->background, value);
    }
    bricks_->add(corner, values_.data());
    return true;
  }

  bool take_inside() {
    Cell corner{};
    if (!in_.get(corner) || !BrickNumbers::in_range(corner)) return false;
    if (++inside_ > BrickNumbers::most_inside) return false;
    bricks_->add_inside(corner);
    return true;
  }

  Reader in_;
  std::uint64_t most_bricks_;
  std::uint64_t dense_ = 0, inside_ = 0;
  bool has_head_ = false;
  Values values_{};
  std::shared_ptr<Bricks> bricks_ = std::make_shared<Bricks>();
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

// One try: null with a complaint, or stuck.
std::shared_ptr<Bricks> try_to_read(const std::filesystem::path& file, std::string_view grid,
                                    std::string& complaint, bool& stuck) {
  isolated::Pipe answer("OpenVDB");
  const std::string name = file.string(), wanted(grid);
  const isolated::Child child("OpenVDB", [&] { tell(name, wanted, answer.write.number); });
  answer.write.close();
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  Listener listener(answer.read.number, child.pid(), bytes_needed(unknown ? 0 : size));
  std::shared_ptr<Bricks> bricks = listener.listen(complaint);
  stuck = listener.stuck();
  return bricks;
}

}  // namespace

LevelSet read_level_set(const std::filesystem::path& file, std::string_view grid) {
  require_file(file);
  std::string complaint;
  std::shared_ptr<Bricks> bricks;
  // What a child inherits from threads that were at work is luck: another one has another.
  for (int tries = 0; !bricks && tries < 5; ++tries) {
    bool stuck = false;
    bricks = try_to_read(file, grid, complaint, stuck);
    if (!stuck) break;
    complaint = "OpenVDB stands still over it: try again while no other thread works";
  }
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
