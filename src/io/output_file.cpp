#include "output_file.hpp"

#include <cerrno>
#include <system_error>

#include <plexway/error.hpp>

namespace plexway::io {

namespace fs = std::filesystem;

OutputFile::OutputFile(const fs::path& file)
    : named_(file), target_(file), buffer_(std::size_t{1} << 16, '\0') {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) refused(EISDIR);
  if (fs::exists(status)) target_ = fs::canonical(file, error);
  if (error && fs::exists(status)) refused(error.value());
  open(fs::exists(status) && !fs::is_regular_file(status));
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::open(bool directly) {
  if (directly) {
    written_ = target_;
    file_ = std::fopen(written_.c_str(), "wb");
  } else {
    // "x" refuses a name that is taken, so two writers never share a temporary file.
    for (int attempt = 0; file_ == nullptr && attempt < 1000; ++attempt) {
      written_ = target_;
      written_ += ".part" + std::to_string(attempt);
      file_ = std::fopen(written_.c_str(), "wbx");
      if (file_ == nullptr && errno != EEXIST) break;
    }
  }
  if (file_ == nullptr) refused(errno);
  std::setvbuf(file_, nullptr, _IONBF, 0);  // the buffer here is enough
}

void OutputFile::write_through(std::string_view bytes) {
  flush();
  if (bytes.size() >= buffer_.size()) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) refused(errno);
  } else {
    write(bytes);
  }
}

void OutputFile::flush() {
  const std::size_t bytes = used_;
  used_ = 0;
  if (std::fwrite(buffer_.data(), 1, bytes, file_) != bytes) refused(errno);
}

void OutputFile::commit() {
  flush();
  std::FILE* closing = file_;
  file_ = nullptr;
  std::error_code error;
  if (std::fclose(closing) != 0) error = {errno, std::generic_category()};
  if (!error && written_ != target_) fs::rename(written_, target_, error);
  if (!error) return;
  if (written_ != target_) std::remove(written_.c_str());
  refused(error.value());
}

void OutputFile::discard() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  file_ = nullptr;
  if (written_ != target_) std::remove(written_.c_str());
}

void OutputFile::refused(int code) {
  discard();
  throw Error("cannot write " + named_.string() + ": " + std::generic_category().message(code));
}

}  // namespace plexway::io
