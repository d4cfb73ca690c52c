#include "output_file.hpp"

#include <unistd.h>

#include <cerrno>

namespace plexway::openvdb {

OutputFile::OutputFile(const std::filesystem::path& file)
    : file_(file), buffer_(std::size_t{1} << 16) {
  setp(buffer_.data(), buffer_.data() + buffer_.size());
}

bool OutputFile::flush() {
  if (failure_ == 0) failure_ = file_.write(pbase(), static_cast<std::size_t>(pptr() - pbase()));
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
  const off_t at = ::lseek(file_.descriptor(), by, whence);
  if (at < 0) failure_ = errno;
  return pos_type(off_type(at));
}

void OutputFile::commit() {
  flush();
  if (failure_ == 0) failure_ = file_.synchronise();
  if (failure_ != 0) file_.refuse(failure_);
  file_.commit();
}

void OutputFile::refused(const std::string& otherwise) {
  if (failure_ != 0) file_.refuse(failure_);
  file_.refuse(otherwise);
}

}  // namespace plexway::openvdb
