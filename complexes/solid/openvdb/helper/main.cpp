// The program that reads files with OpenVDB: of a file with a flipped bit it may read beyond its
// buffers, loop or ask for all memory there is. Bricks go to the caller, which checks them.

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

#include "answer.hpp"
#include "complexes/common/helper_main.hpp"
#include "complexes/common/plain_bytes.hpp"
#include "grid_copy.hpp"

namespace {

using namespace plexway::openvdb;
namespace isolated = plexway::detail::isolated;

class Writer {
 public:
  Writer() { buffer_.reserve(1 << 16); }
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
    isolated::send_answer(buffer_.data(), buffer_.size());
    buffer_.clear();
  }

 private:
  std::string buffer_;
};

// Not above what the caller is held to; whether the limit is ours then.
template <class Resource>
bool set_limit(Resource resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return false;
  const bool ours = limit.rlim_max >= hard && limit.rlim_cur >= soft;
  limit.rlim_max = std::min(limit.rlim_max, hard);
  limit.rlim_cur = std::min({limit.rlim_cur, limit.rlim_max, soft});
  return ::setrlimit(resource, &limit) == 0 && ours;
}

// Whether want of memory means that the file asks for more than it can need.
bool limit_resources(std::uintmax_t file_bytes) {
  const rlim_t seconds = seconds_needed(file_bytes);
  set_limit(RLIMIT_CPU, seconds, seconds + 1);
#if defined(RLIMIT_DATA) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  // (Sanitizers map terabytes of their own.)
  const rlim_t bytes = bytes_needed(file_bytes);
  const bool ours = set_limit(RLIMIT_DATA, bytes, bytes);
  rlimit space{};
  const bool tight = ::getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur < bytes;
  return ours && !tight;
#else
  return false;
#endif
}

void answer(const std::string& file, const std::string& grid) {
  // What the answer takes is there before memory may run out.
  constexpr std::size_t longest = 1000;
  Writer out;
  std::string complaint;
  complaint.reserve(longest);
  bool no_memory = false;
  out.put(Word::ready);
  out.flush();
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  const bool blames_file = limit_resources(unknown ? 0 : size);
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
    if (blames_file)
      complaint = "asks for more memory than a file of its size can need: it is damaged";
    else
      no_memory = true;
  } catch (const std::exception& error) {
    complaint = std::string_view(error.what()).substr(0, longest);
    if (complaint.empty()) complaint = "OpenVDB cannot read it";
  } catch (...) {
    complaint = "OpenVDB cannot read it";
  }
  out.put(no_memory ? Word::no_memory : complaint.empty() ? Word::end : Word::complaint);
  if (!complaint.empty()) out.put(complaint);
  out.flush();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string told = isolated::begin_as_helper(argc, argv);
    isolated::BytesIn in(told);
    std::string file, grid;
    if (in.get_row(file) && in.get_row(grid)) answer(file, grid);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);  // nothing is freed that a damaged file may have bent
}
