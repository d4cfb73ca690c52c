#include "output_file.hpp"

namespace plexway::io {

void OutputFile::write_through(std::string_view bytes) {
  flush();
  if (bytes.size() < buffer_.size()) return write(bytes);
  if (const int failed = file_.write(bytes.data(), bytes.size()); failed != 0) file_.refuse(failed);
}

void OutputFile::flush() {
  const std::size_t bytes = used_;
  used_ = 0;
  if (const int failed = file_.write(buffer_.data(), bytes); failed != 0) file_.refuse(failed);
}

void OutputFile::commit() {
  flush();
  file_.commit();
}

}  // namespace plexway::io
