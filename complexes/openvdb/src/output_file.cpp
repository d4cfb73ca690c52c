#include "output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::openvdb {

namespace fs = std::filesystem;

namespace {

// Where a chain of links ends, be there a file or not.
fs::path end_of_links(fs::path file, std::error_code& error) {
  for (int links = 0; links < 40; ++links) {
    std::error_code none_here;
    if (!fs::is_symlink(fs::symlink_status(file, none_here))) return file;
    const fs::path to = fs::read_symlink(file, error);
    if (error) return file;
    file = file.parent_path() / to;
  }
  error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return file;
}

}  // namespace

OutputFile::OutputFile(const fs::path& file) : named_(file), buffer_(std::size_t{1} << 16) {
  std::error_code error;
  target_ = end_of_links(file, error);
  failure_ = error.value();
  if (failure_ == 0 && fs::is_directory(target_, error)) failure_ = EISDIR;
  if (failure_ == 0) open();
  if (failure_ != 0) refused("");
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::open() {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    written_ = target_;
    file_ = ::open(written_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    // A name that is taken is refused, so two writers never share a temporary file.
    for (int attempt = 0; file_ < 0 && attempt < 1000; ++attempt) {
      written_ = target_;
      written_ += ".part" + std::to_string(attempt);
      file_ = ::open(written_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) break;
    }
  }
  if (file_ < 0) failure_ = errno;
}

bool OutputFile::flush() {
  for (const char* from = pbase(); failure_ == 0 && from < pptr();) {
    const ssize_t sent = ::write(file_, from, static_cast<std::size_t>(pptr() - from));
    if (sent >= 0)
      from += sent;
    else if (errno != EINTR)
      failure_ = errno;
  }
  setp(buffer_.data(), buffer_.data() + buffer_.size());
  return failure_ == 0;
}

OutputFile::int_type OutputFile::overflow(int_type c) {
  if (!flush()) return traits_type::eof();
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  *pptr() = traits_type::to_char_type(c);
  pbump(1);
  return c;
}

OutputFile::pos_type OutputFile::seekoff(off_type by, std::ios_base::seekdir from,
                                         std::ios_base::openmode) {
  if (!seekable() || !flush()) return pos_type(off_type(-1));
  const int whence = from == std::ios_base::beg   ? SEEK_SET
                     : from == std::ios_base::cur ? SEEK_CUR
                                                  : SEEK_END;
  const off_t at = ::lseek(file_, by, whence);
  if (at < 0) failure_ = errno;
  return pos_type(off_type(at));
}

void OutputFile::commit() {
  flush();
  // What cannot be synchronised, such as a pipe, says EINVAL.
  if (failure_ == 0 && ::fsync(file_) != 0 && errno != EINVAL && errno != EROFS) failure_ = errno;
  if (failure_ != 0) refused("");
  const int closing = file_;
  file_ = -1;
  if (::close(closing) != 0 && errno != EINTR) failure_ = errno;
  if (failure_ == 0 && seekable() && std::rename(written_.c_str(), target_.c_str()) != 0)
    failure_ = errno;
  if (failure_ == 0) return;
  if (seekable()) ::unlink(written_.c_str());
  refused("");
}

void OutputFile::discard() {
  if (file_ < 0) return;
  ::close(file_);
  file_ = -1;
  if (seekable()) ::unlink(written_.c_str());
}

void OutputFile::refused(const std::string& otherwise) {
  discard();
  throw Error("cannot write " + named_.string() + ": " +
              (failure_ != 0 ? std::generic_category().message(failure_) : otherwise));
}

}  // namespace plexway::openvdb
