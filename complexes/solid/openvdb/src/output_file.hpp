#pragma once

#include <filesystem>
#include <streambuf>
#include <string>
#include <vector>

#include "file/new_file.hpp"

namespace plexway::openvdb {

/// A file that appears whole or not at all (`file/new_file.hpp`), for OpenVDB, which writes to a
/// stream and does not look at its state: so this is the stream's buffer, and remembers what went
/// wrong. The constructor and `commit` throw Error "cannot write FILE: reason".
class OutputFile : public std::streambuf {
 public:
  explicit OutputFile(const std::filesystem::path& file);

  /// Whether what was written can be gone back to.
  [[nodiscard]] bool seekable() const { return file_.seekable(); }
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
  bool flush();

  detail::file::NewFile file_;
  int failure_ = 0;  ///< the first one's errno
  std::vector<char> buffer_;
};

}  // namespace plexway::openvdb
