#include <io/hdf5/include/plexway/hdf5/matrix.hpp>

#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <zlib.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <plexway/error.hpp>
#include <plexway/version.hpp>

#include "executors/threads/share_out.hpp"
#include "file/new_file.hpp"

namespace plexway::hdf5 {

namespace {

/// What HDF5's filters shuffle and deflate make of the bytes of a chunk: all first bytes of its
/// numbers, all second bytes and so on, as a stream of zlib's.
std::string packed_chunk(const std::string& bytes, std::size_t number_bytes, int level) {
  const std::size_t count = bytes.size() / number_bytes;
  std::string shuffled(bytes.size(), '\0');
  for (std::size_t b = 0; b < number_bytes; ++b)
    for (std::size_t i = 0; i < count; ++i) shuffled[b * count + i] = bytes[i * number_bytes + b];
  uLongf size = ::compressBound(static_cast<uLong>(shuffled.size()));
  std::string packed(size, '\0');
  // With room for the worst case only memory can be missing.
  if (::compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(shuffled.data()),
                  static_cast<uLong>(shuffled.size()), level) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

constexpr std::size_t most_rows = 32, most_numbers = std::size_t{1} << 16;
constexpr int level = 1;

/// HDF5 would not; with the system's reason, if it had one. HDF5 1.10 crashes when it closes what
/// it could not write, so from then on this write closes nothing: that is left to the end of the
/// process.
struct Refused {
  explicit Refused(int why = errno) : reason(why) { seen = true; }
  int reason;
  static inline thread_local bool seen = false;
};

void done(herr_t status) {
  if (status < 0) throw Refused();
}

/// Nothing on standard error: we report what goes wrong.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &report_, &reported_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, report_, reported_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t report_ = nullptr;
  void* reported_ = nullptr;
};

/// An identifier of HDF5's, given back by the function that its kind has.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle(hid_t id, Close give_back) : id_(id), close_(give_back) {
    if (id_ < 0) throw Refused();
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  ~Handle() {
    if (id_ >= 0 && !Refused::seen) close_(id_);
  }
  /// Now, where it matters whether that succeeds.
  void close() { done(close_(std::exchange(id_, -1))); }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

Handle number_type(std::size_t bytes) {
  if (bytes == 4) return {H5Tcopy(H5T_IEEE_F32LE), H5Tclose};
  if (bytes == 8) return {H5Tcopy(H5T_IEEE_F64LE), H5Tclose};
  Handle half(H5Tcopy(H5T_IEEE_F32LE), H5Tclose);
  done(H5Tset_fields(half, 15, 10, 5, 0, 10));
  done(H5Tset_size(half, 2));
  done(H5Tset_ebias(half, 15));
  return half;
}

// Without times, so that equal matrices make equal files.
Handle dataset_properties() {
  Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  done(H5Pset_obj_track_times(properties, false));
  return properties;
}

/// Makes sure of room on the disk: HDF5 1.10 crashes when it closes a file that it could not write.
class Room {
 public:
  Room(int descriptor, hid_t file, std::size_t chunks)
      : descriptor_(descriptor), file_(file), for_itself_((std::size_t{1} << 16) + 256 * chunks) {}

  /// For so many bytes more, and what HDF5 notes about them. Where the system cannot tell it does
  /// not.
  void need(std::size_t bytes) const {
#ifdef FALLOC_FL_KEEP_SIZE
    hsize_t size = 0;
    done(H5Fget_filesize(file_, &size));
    const auto end = static_cast<off_t>(size + bytes + for_itself_);
    if (::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, 0, end) != 0 && errno != EOPNOTSUPP)
      throw Refused(errno);
#endif
  }

 private:
  int descriptor_;
  hid_t file_;
  std::size_t for_itself_;
};

void write_names(hid_t file, const char* name, std::span<const std::int64_t> names) {
  if (names.empty()) return;
  const hsize_t size = names.size();
  const Handle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Handle properties = dataset_properties();
  Handle set(H5Dcreate2(file, name, H5T_STD_I64LE, space, H5P_DEFAULT, properties, H5P_DEFAULT),
             H5Dclose);
  done(H5Dwrite(set, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, names.data()));
  set.close();
}

void write_version(hid_t file) {
  const std::string text = std::string("plexway ") + version_string;
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  done(H5Tset_size(type, text.size()));
  Handle attribute(H5Acreate2(file, "writer", type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  done(H5Awrite(attribute, type, text.data()));
  attribute.close();
}

// Threads compress some chunks, and then one writes them in their order.
void write_chunks(hid_t set, const Matrix& matrix, std::array<std::size_t, 2> chunk,
                  const Room& room, const OpenMP& threads) {
  const std::size_t across = (matrix.columns + chunk[1] - 1) / chunk[1];
  const std::size_t chunks = (matrix.rows + chunk[0] - 1) / chunk[0] * across;
  const std::size_t bytes = matrix.number_bytes;
  std::vector<std::string> packed(openmp_built() ? 2 * team_size(threads) : 1);
  for (std::size_t first = 0; first < chunks; first += packed.size()) {
    const std::size_t count = std::min(packed.size(), chunks - first);
    const auto pack = [&](std::size_t k, std::size_t) {
      // Chunks at the far sides are as large as the others, and 0 where there is no matrix.
      std::string numbers(chunk[0] * chunk[1] * bytes, '\0');
      const std::size_t row = (first + k) / across * chunk[0];
      const std::size_t column = (first + k) % across * chunk[1];
      const std::size_t width = std::min(chunk[1], matrix.columns - column);
      for (std::size_t r = 0; r < std::min(chunk[0], matrix.rows - row); ++r)
        matrix.read(row + r, column, {numbers.data() + r * chunk[1] * bytes, width * bytes});
      packed[k] = packed_chunk(numbers, bytes, level);
    };
    if (openmp_built())
      detail::share_out(threads, count, pack);
    else
      pack(0, 0);
    for (std::size_t k = 0; k < count; ++k) {
      room.need(packed[k].size());
      const std::array<hsize_t, 2> at = {(first + k) / across * chunk[0],
                                         (first + k) % across * chunk[1]};
      done(H5Dwrite_chunk(set, H5P_DEFAULT, 0, at.data(), packed[k].size(), packed[k].data()));
    }
  }
}

// Files are closed on request, with all that is in them.
Handle file_access() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  done(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG));
  done(H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18));
  return access;
}

// A file with nothing in it. HDF5 creates files by name alone, and ours has none yet: so it is made
// in memory.
std::string empty_file() {
  const Handle access = file_access();
  done(H5Pset_fapl_core(access, 4096, false));
  const Handle file(H5Fcreate("empty", H5F_ACC_TRUNC, H5P_DEFAULT, access), H5Fclose);
  done(H5Fflush(file, H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file, nullptr, 0);
  if (size < 0) throw Refused();
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file, bytes.data(), bytes.size()) < 0) throw Refused();
  return bytes;
}

void write(detail::file::NewFile& out, const Matrix& matrix, const OpenMP& threads) {
  const std::string empty = empty_file();
  if (const int failed = out.write(empty.data(), empty.size()); failed != 0) throw Refused(failed);
  const Handle access = file_access();
  done(H5Pset_fapl_stdio(access));  // the usual driver wants to know the name at the end of links
  Handle file(H5Fopen(out.place().c_str(), H5F_ACC_RDWR, access), H5Fclose);
  const std::size_t high = std::min(most_rows, matrix.rows);
  const std::array<std::size_t, 2> chunk = {high, std::min(most_numbers / high, matrix.columns)};
  const Room room(out.descriptor(), file,
                  (matrix.rows / chunk[0] + 1) * (matrix.columns / chunk[1] + 1));
  room.need(sizeof(std::int64_t) * (matrix.row_names.size() + matrix.column_names.size()));
  write_version(file);
  write_names(file, "rows", matrix.row_names);
  write_names(file, "columns", matrix.column_names);

  const std::array<hsize_t, 2> shape = {matrix.rows, matrix.columns}, sides = {chunk[0], chunk[1]};
  const Handle space(H5Screate_simple(2, shape.data(), nullptr), H5Sclose);
  const Handle properties = dataset_properties();
  done(H5Pset_chunk(properties, 2, sides.data()));
  done(H5Pset_shuffle(properties));
  done(H5Pset_deflate(properties, level));
  const Handle type = number_type(matrix.number_bytes);
  Handle set(H5Dcreate2(file, "distance", type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
             H5Dclose);
  write_chunks(set, matrix, chunk, room, threads);
  set.close();
  file.close();
  // What was kept ready and not needed goes back.
  struct stat written {};
  if (::fstat(out.descriptor(), &written) == 0)
    (void)!::ftruncate(out.descriptor(), written.st_size);
}

}  // namespace

void write_matrix(const std::filesystem::path& file, const Matrix& matrix, const OpenMP& threads) {
  if (matrix.rows == 0 || matrix.columns == 0)
    throw UsageError("a matrix in HDF5 needs at least one row and one column");
  if (matrix.number_bytes != 2 && matrix.number_bytes != 4 && matrix.number_bytes != 8)
    throw UsageError("the numbers of a matrix have 2, 4 or 8 bytes, not " +
                     std::to_string(matrix.number_bytes));
  detail::file::NewFile out(file);
  if (!out.seekable()) out.refuse("HDF5 files go to no pipe");
  // Nor does it close what is open when the process ends.
  [[maybe_unused]] static const herr_t no_end = H5dont_atexit();
  try {
    const Silence silence;
    Refused::seen = false;
    errno = 0;
    write(out, matrix, threads);
  } catch (const Refused& refused) {
    if (refused.reason != 0) out.refuse(refused.reason);
    out.refuse("HDF5 refuses");
  }
  if (const int failed = out.synchronise(); failed != 0) out.refuse(failed);
  out.commit();
}

}  // namespace plexway::hdf5
