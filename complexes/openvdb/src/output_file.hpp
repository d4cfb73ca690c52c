#pragma once

#include <filesystem>
#include <streambuf>
#include <string>
#include <vector>

namespace plexway::openvdb {

/// A file that appears whole or not at all: written beside its place, renamed by `commit`.
///
/// OpenVDB writes to a stream and does not look at its state, so this is the stream's buffer, and
/// remembers what went wrong. A link stays a link; a target that exists and is no regular file (a
/// pipe, a device) is written directly. The constructor and `commit` throw Error "cannot write
/// FILE: reason"; without `commit` the destructor leaves nothing behind. (`io` has one too, but
/// stands on a higher floor.)
class OutputFile : public std::streambuf {
 public:
  explicit OutputFile(const std::filesystem::path& file);
  ~OutputFile() override;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Whether what was written can be gone back to.
  [[nodiscard]] bool seekable() const { return written_ != target_; }
  /// Writes what is left, waits until the disk has it, and puts the file in its place.
  void commit();
  /// Throws for the reason that the system gave first, or if it gave none, this one.
  [[noreturn]] void refused(const std::string& otherwise);

 protected:
  int_type overflow(int_type c) override;
  int sync() override { return flush() ? 0 : -1; }
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override;
  pos_type seekpos(pos_type at, std::ios_base::openmode mode) override {
    return seekoff(off_type(at), std::ios_base::beg, mode);
  }

 private:
  void open();
  bool flush();
  void discard();

  std::filesystem::path named_;    ///< as the caller names it, for messages
  std::filesystem::path target_;   ///< with symbolic links resolved
  std::filesystem::path written_;  ///< the temporary file, or the target itself
  int file_ = -1;
  int failure_ = 0;  ///< the first one's errno
  std::vector<char> buffer_;
};

}  // namespace plexway::openvdb
