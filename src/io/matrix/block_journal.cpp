#include <plexway/io/block_journal.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <system_error>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"

namespace plexway::io {
namespace {

constexpr std::string_view first_line = "plexway journal 1\n";
constexpr std::string_view begin_line = "begin\n";
constexpr std::string_view complete_line = "complete\n";
constexpr auto shortest_pause = std::chrono::milliseconds(250);
constexpr std::string_view note_begin = "note ";

// One line whatever the text holds.
std::string one_line(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  return text;
}

std::string journal_header_of(const BlockJournal::Description& description, std::size_t blocks) {
  std::string text(first_line);
  for (const auto& [name, value] : description)
    text += one_line(name) + ": " + one_line(value) + "\n";
  text += "blocks: " + std::to_string(blocks) + "\n";
  return text.append(begin_line);
}

// Each with its check behind it, so that a line that was written in part is told from a whole one.
std::string line_of(std::size_t block, BlockJournal::Place place) {
  std::string text = std::to_string(block) + " " + std::to_string(place.offset) + " " +
                     std::to_string(place.bytes);
  Fingerprint check;
  check.add(text);
  return text + " " + check.text() + "\n";
}

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return line;
}

}  // namespace

void Fingerprint::add(std::string_view bytes) {
  for (const char c : bytes) {
    value_ ^= static_cast<unsigned char>(c);
    value_ *= 0x100000001b3U;
  }
}

std::string Fingerprint::text() const {
  std::array<char, 17> digits{};
  std::snprintf(digits.data(), digits.size(), "%016llx", static_cast<unsigned long long>(value_));
  return digits.data();
}

std::filesystem::path BlockJournal::path_of(const std::filesystem::path& out) {
  std::filesystem::path path = out;
  return path += ".journal";
}

BlockJournal::BlockJournal(const std::filesystem::path& out) : out_(out), path_(path_of(out)) {
  try {
    open();
  } catch (...) {
    if (file_ >= 0) ::close(file_);
    throw;
  }
}

BlockJournal::BlockJournal(const std::filesystem::path& out, const Description& description,
                           std::size_t blocks)
    : BlockJournal(out) {
  finished_.assign(blocks, 0);
  place_.resize(blocks);
  read(journal_header_of(description, blocks));
}

void BlockJournal::discard(const std::filesystem::path& out) {
  BlockJournal old(out);
  (void)old.content();
  old.remove();
}

BlockJournal::~BlockJournal() {
  if (file_ >= 0) ::close(file_);
}

void BlockJournal::open() {
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) refused(errno);
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const int code = errno;
      if (code == EWOULDBLOCK)
        throw Error("cannot write " + out_.string() + ": another run is writing it");
      refused(code);
    }
    // The run that had the lock before may have finished and removed what was opened here.
    struct stat opened {
    }, named{};
    if (::fstat(file_, &opened) == 0 && ::stat(path_.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino && opened.st_dev == named.st_dev)
      return;
    ::close(file_);
    file_ = -1;
  }
}

// What is there. Somebody else's file is left alone.
std::string BlockJournal::content() const {
  struct stat status {};
  if (::fstat(file_, &status) != 0) refused(errno);
  if (status.st_size == 0) return {};
  std::string content(FileBytes(path_).view());
  const std::string_view text = content;
  if (first_line.substr(0, text.size()) != text.substr(0, first_line.size()))
    throw Error("cannot write " + out_.string() + ": " + path_.string() +
                " is in the way and no journal of ours: move it away");
  return content;
}

void BlockJournal::read(const std::string& header) {
  const std::string content = this->content();
  std::string_view text = content;
  const std::size_t begin = text.find("\nbegin\n");
  if (begin == text.npos || text.substr(0, first_line.size()) != first_line) {
    // None, or one whose beginning was not written whole.
    if (::ftruncate(file_, 0) != 0) refused(errno);
    append(header);
    return;
  }
  const std::size_t rest = begin + 1 + begin_line.size();
  if (text.substr(0, rest) != header) {
    std::string_view theirs = text.substr(0, rest), ours = header;
    while (!theirs.empty() && !ours.empty()) {
      const std::string_view was = take_line(theirs), is = take_line(ours);
      if (was == is) continue;
      throw Error("cannot go on with " + out_.string() + ": it was begun with '" +
                  std::string(was) + "', now it is '" + std::string(is) +
                  "'; give what was given then, or remove " + path_.string() + " to begin anew");
    }
  }
  text.remove_prefix(rest);
  std::size_t whole = rest;
  while (!text.empty()) {
    const bool ended = text.find('\n') != text.npos;
    const std::string_view line = take_line(text);
    if (!ended) break;
    whole += line.size() + 1;
    if (std::string(line) + "\n" == complete_line) {
      complete_ = true;
      continue;
    }
    if (line.substr(0, note_begin.size()) == note_begin) {
      note_ = line.substr(note_begin.size());
      continue;
    }
    std::array<std::uint64_t, 3> number{};
    const char* at = line.data();
    const char* const end = line.data() + line.size();
    bool good = true;
    for (std::uint64_t& n : number) {
      const auto [next, error] = std::from_chars(at, end, n);
      good = good && error == std::errc{} && next != end && *next == ' ';
      if (!good) break;
      at = next + 1;
    }
    if (!good || number[0] >= finished_.size()) continue;
    const Place place{number[1], number[2]};
    if (line_of(number[0], place) != std::string(line) + "\n") continue;
    finished_[number[0]] = 1;
    place_[number[0]] = place;
  }
  if (::ftruncate(file_, static_cast<off_t>(whole)) != 0) refused(errno);
  // A run that was ended before its first block may not have come as far as to make its files.
  resumed_ = complete_ || finished() > 0;
}

std::size_t BlockJournal::finished() const {
  return static_cast<std::size_t>(std::count(finished_.begin(), finished_.end(), 1));
}

std::uint64_t BlockJournal::end() const {
  std::uint64_t end = 0;
  for (std::size_t b = 0; b < place_.size(); ++b)
    if (finished_[b] != 0) end = std::max(end, place_[b].offset + place_[b].bytes);
  return end;
}

void BlockJournal::append(const std::string& text) {
  if (::lseek(file_, 0, SEEK_END) < 0) refused(errno);
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(file_, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) refused(errno);
    done += static_cast<std::size_t>(wrote);
  }
  if (::fdatasync(file_) != 0 && errno != EINVAL) refused(errno);
}

void BlockJournal::finish(std::size_t block, Place place, const std::function<void()>& sync) {
  place_[block] = place;
  waiting_.push_back(block);
  if (std::chrono::steady_clock::now() - flushed_ >= pause_) flush(sync);
}

void BlockJournal::flush(const std::function<void()>& sync) {
  if (!waiting_.empty()) {
    const auto start = std::chrono::steady_clock::now();
    sync();
    std::string text;
    for (const std::size_t block : waiting_) text += line_of(block, place_[block]);
    append(text);
    for (const std::size_t block : waiting_) finished_[block] = 1;
    waiting_.clear();
    // At most a tenth of the time for the disk.
    pause_ = std::max<std::chrono::steady_clock::duration>(
        shortest_pause, 9 * (std::chrono::steady_clock::now() - start));
  }
  flushed_ = std::chrono::steady_clock::now();
}

void BlockJournal::note(const std::string& text) {
  note_ = one_line(text);
  append(std::string(note_begin) + note_ + "\n");
}

void BlockJournal::complete(const std::function<void()>& sync) {
  flush(sync);
  if (complete_) return;
  sync();
  append(std::string(complete_line));
  complete_ = true;
}

void BlockJournal::remove() {
  if (::unlink(path_.c_str()) != 0) refused(errno);
}

void BlockJournal::refused(int code) const {
  throw Error("cannot write " + path_.string() + ": " + std::generic_category().message(code));
}

}  // namespace plexway::io
