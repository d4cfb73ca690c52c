// OpenVDB in a program of its own, helper/main.cpp: of a file with a flipped bit it may crash, loop
// or ask for all memory there is. The helper hands bricks over through a pipe, and they are
// checked.

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <system_error>

#include <plexway/error.hpp>
#include <plexway/openvdb/level_set.hpp>

#include "answer.hpp"
#include "bricks.hpp"
#include "complexes/common/helper_process.hpp"
#include "complexes/common/plain_bytes.hpp"

namespace plexway::openvdb {
namespace {

// Messages are one printable line; what OpenVDB says may have bytes of the file in it.
std::string printable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = c == '\n' ? ' ' : '?';
  return text;
}

using detail::isolated::Descriptor;

/// False once the helper has gone silent.
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

// How listening ended.
enum class Heard { all, complaint, no_memory, nonsense, silence };

// What the child says, piece by piece. It may say anything: a damaged file may have it write
// anywhere.
class Listener {
 public:
  Listener(int answer, std::uint64_t bytes) : in_(answer), most_bricks_(bytes / sizeof(Values)) {}

  Heard listen() {
    for (Word word{}; in_.get(word);) {
      if (word == Word::complaint) {
        if (!in_.get(complaint_)) return Heard::silence;
        complaint_ = printable(complaint_);
        return Heard::complaint;
      }
      if (word == Word::no_memory) return Heard::no_memory;
      if (word == Word::end) return has_head_ ? Heard::all : Heard::nonsense;
      const bool whole = take(word);
      if (!good_) return Heard::nonsense;
      if (!whole) return Heard::silence;
    }
    return Heard::silence;
  }
  /// Whether the helper said that it runs.
  [[nodiscard]] bool ready() const { return ready_; }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  [[nodiscard]] const std::shared_ptr<Bricks>& bricks() const { return bricks_; }

 private:
  using Values = std::array<float, 512>;

  // False where it ends too soon; what makes no sense is not good_.
  bool take(Word word) {
    good_ = word == Word::ready  ? !ready_ && !has_head_
            : word == Word::head ? ready_ && !has_head_
                                 : has_head_ && (word == Word::brick || word == Word::inside);
    if (!good_) return true;
    if (word == Word::ready) return ready_ = true;
    return word == Word::head ? take_head() : word == Word::brick ? take_brick() : take_inside();
  }

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
    good_ = finite && bricks_->background > 0 && volume > 0;
    return true;
  }

  bool take_brick() {
    Cell corner{};
    if (!in_.get(corner) || !in_.get(values_)) return false;
    good_ = BrickNumbers::in_range(corner) && ++dense_ <= most_bricks_;
    for (float& value : values_) {
      good_ = good_ && !std::isnan(value);
      // Some programs write infinity where others write the background.
      if (std::isinf(value)) value = std::copysign(bricks_->background, value);
    }
    if (good_) bricks_->add(corner, values_.data());
    return true;
  }

  bool take_inside() {
    Cell corner{};
    if (!in_.get(corner)) return false;
    good_ = BrickNumbers::in_range(corner) && ++inside_ <= BrickNumbers::most_inside;
    if (good_) bricks_->add_inside(corner);
    return true;
  }

  Reader in_;
  std::uint64_t most_bricks_;
  std::uint64_t dense_ = 0, inside_ = 0;
  bool ready_ = false, has_head_ = false, good_ = true;
  std::string complaint_;
  Values values_{};
  std::shared_ptr<Bricks> bricks_ = std::make_shared<Bricks>();
};

void require_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status))
    throw InputError(file.string() + ": is a directory, not a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(file.string() + ": is no regular file: OpenVDB goes back and forth in it");
  const Descriptor in{::open(file.c_str(), O_RDONLY | O_CLOEXEC)};
  if (in.number < 0)
    throw InputError(file.string() + ": cannot be read: " + std::generic_category().message(errno));
  std::array<unsigned char, 8> magic{};
  const ssize_t got = ::read(in.number, magic.data(), magic.size());
  constexpr std::array<unsigned char, 8> wanted = {0x20, 0x42, 0x44, 0x56, 0, 0, 0, 0};
  if (got != 8 || magic != wanted)
    throw InputError(file.string() + ": is no OpenVDB file: it does not begin as one");
}

// Why the helper fell silent: the file, or something else.
[[noreturn]] void throw_silence(const std::string& file, bool ready, std::uintmax_t file_bytes,
                                const detail::isolated::HelperEnd& end) {
  if (ready && end.crashed())
    throw InputError(file + ": OpenVDB crashes on it: the file is damaged");
  if (ready && end.signal == SIGXCPU)
    throw InputError(file + ": OpenVDB comes to no end within the " +
                     std::to_string(seconds_needed(file_bytes)) +
                     " s of work that a file of its size can need: it is damaged");
  throw Error(file + ": the program " + helper_name + ", which reads it, " + end.text());
}

}  // namespace

LevelSet read_level_set(const std::filesystem::path& file, std::string_view grid) {
  require_file(file);
  std::error_code unknown;
  std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown) size = 0;
  detail::isolated::Helper helper(helper_name, "OpenVDB",
                                  reinterpret_cast<const void*>(&read_level_set), false);
  detail::isolated::BytesOut request;
  request.put_row(file.string());
  request.put_row(grid);
  helper.tell(request.bytes());
  Listener listener(helper.answer().number, bytes_needed(size));
  const Heard heard = listener.listen();
  if (heard == Heard::no_memory) throw std::bad_alloc();
  if (heard == Heard::nonsense)
    throw InputError(file.string() + ": OpenVDB makes nonsense of it: the file is damaged");
  if (heard == Heard::silence) throw_silence(file.string(), listener.ready(), size, helper.end());
  if (heard == Heard::complaint) throw InputError(file.string() + ": " + listener.complaint());
  const std::shared_ptr<Bricks>& bricks = listener.bricks();
  LevelSet level_set(bricks);
  if (level_set.inside_voxels() == 0)
    throw InputError(file.string() + ": grid '" + printable(bricks->name) +
                     "' is negative nowhere: nothing lies inside");
  return level_set;
}

}  // namespace plexway::openvdb
