// The program that reads files with OpenVDB: of a file with a flipped bit it may read beyond its
// buffers, loop or ask for all memory there is. Bricks go to the caller, which checks them.

#include <openvdb/openvdb.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "answer.hpp"
#include "bricks.hpp"
#include "complexes/common/helper_main.hpp"
#include "complexes/common/plain_bytes.hpp"
#include "grid_bricks.hpp"

namespace {

using namespace plexway::openvdb;
using ::openvdb::GridBase;
using plexway::InputError;
namespace isolated = plexway::detail::isolated;

// What comes ahead of a grid's bricks.
struct GridHead {
  Frame frame;
  float background = 0;
  std::string name;
  std::size_t active = 0;
};

std::string in_quotes(const std::string& name) { return "'" + name + "'"; }

std::string what_it_is(const GridBase& grid) {
  if (grid.getGridClass() == ::openvdb::GRID_FOG_VOLUME) return "a fog volume";
  return "a grid of " + grid.valueType();
}

bool has_fit_values(const GridBase& grid) {
  return grid.isType<::openvdb::FloatGrid>() || grid.isType<::openvdb::DoubleGrid>();
}

// Some programs lose the class. Outside is positive in a level set, and 0 in a fog.
bool may_be_level_set(const GridBase& grid) {
  if (!has_fit_values(grid)) return false;
  if (grid.getGridClass() == ::openvdb::GRID_LEVEL_SET) return true;
  if (grid.getGridClass() != ::openvdb::GRID_UNKNOWN) return false;
  if (const auto* f = dynamic_cast<const ::openvdb::FloatGrid*>(&grid)) return f->background() > 0;
  return dynamic_cast<const ::openvdb::DoubleGrid&>(grid).background() > 0;
}

std::string choose(const std::vector<GridBase::Ptr>& grids, const std::string& wanted) {
  if (grids.empty()) throw InputError("has no grids");
  std::string all, fit;
  std::size_t fits = 0;
  std::string chosen;
  for (const GridBase::Ptr& grid : grids) {
    all += (all.empty() ? "" : ", ") + in_quotes(grid->getName());
    if (!wanted.empty() && grid->getName() == wanted) return wanted;
    // What a fog and a level set share is their type: say what is wrong with it afterwards.
    const bool level_set = grid->getGridClass() == ::openvdb::GRID_LEVEL_SET;
    if (!level_set && grids.size() > 1) continue;
    chosen = grid->getName();
    fit += (fit.empty() ? "" : ", ") + in_quotes(chosen);
    ++fits;
  }
  if (!wanted.empty()) throw InputError("has no grid " + in_quotes(wanted) + "; it has " + all);
  if (fits == 0)
    throw InputError("has several grids, none marked as a level set; choose one of " + all);
  if (fits > 1) throw InputError("has several level sets; choose one of " + fit);
  return chosen;
}

template <class Grid>
void copy(const Grid& grid, const std::function<void(const GridHead&)>& head,
          const BrickTaker& brick) {
  GridHead it;
  it.frame = frame_of(grid.constTransform());
  it.background = static_cast<float>(grid.background());
  if (!(it.background > 0) || !std::isfinite(it.background))
    throw InputError("its background is " + text_of(it.background) +
                     ", which must be above 0 in a level set");
  it.name = grid.getName();
  it.active = grid.activeVoxelCount();
  head(it);
  hand_out(grid.constTree(), brick);
}

// Reads a file with OpenVDB, in this process: `head` is told first, then each brick. Throws
// InputError without the file's name, whatever OpenVDB throws, or crashes.
void copy_grid(const std::string& file, const std::string& wanted,
               const std::function<void(const GridHead&)>& head, const BrickTaker& brick) {
  // Never freed: the process ends here, and a damaged file may have bent what there is to free.
  auto& input = *new ::openvdb::io::File(file);
  auto& grid = *new GridBase::Ptr;
  std::string name;
  try {
    ::openvdb::initialize();
    input.setCopyMaxBytes(0);
    input.open(false);
    const auto metadata = input.readAllGridMetadata();
    name = choose(*metadata, wanted);
    for (const GridBase::Ptr& one : *metadata)
      if (one->getName() == name && !has_fit_values(*one))
        throw InputError("grid " + in_quotes(name) + " is " + what_it_is(*one) +
                         ", not a level set of numbers");
    grid = input.readGrid(name);
  } catch (const ::openvdb::Exception& error) {
    throw InputError(std::string("OpenVDB cannot read it: ") + error.what());
  }
  if (!grid) throw InputError("OpenVDB gave no grid");
  if (!may_be_level_set(*grid))
    throw InputError(
        "grid " + in_quotes(name) + " is " + what_it_is(*grid) +
        ", not a level set; give one, negative inside (Houdini's Convert VDB makes it)");
  try {
    if (const auto* single = dynamic_cast<const ::openvdb::FloatGrid*>(grid.get()))
      copy(*single, head, brick);
    else
      copy(dynamic_cast<const ::openvdb::DoubleGrid&>(*grid), head, brick);
  } catch (const InputError& error) {
    throw InputError("grid " + in_quotes(name) + ": " + error.what());
  }
}

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
