#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace plexway::io {

/// Tells contents apart: 64 bits of all that was added (FNV-1a). No safeguard against malice.
class Fingerprint {
 public:
  /// Bytes, in order.
  void add(std::string_view bytes);
  /// The bytes of a row of numbers.
  template <class Numbers>
  void add_numbers(const Numbers& numbers) {
    add({reinterpret_cast<const char*>(std::data(numbers)),
         std::size(numbers) * sizeof(*std::data(numbers))});
  }
  /// Of all that was added so far.
  [[nodiscard]] std::uint64_t value() const { return value_; }
  /// The same in hexadecimal digits.
  [[nodiscard]] std::string text() const;

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// The file OUT.journal beside an output that takes long: it lists the blocks that are finished.
///
/// A run that is killed, or ends by an error, leaves it there with what is finished; the next run
/// of the same description goes on from that. One run at a time: it is locked (flock).
///
/// Text: a first line, "NAME: VALUE" for all of the description, "begin", and a line a finished
/// block. Lines that are not whole are left out, so the blocks are made again.
class BlockJournal {
 public:
  /// Names and values, one line each: all that the content of the output depends on.
  using Description = std::vector<std::pair<std::string, std::string>>;
  /// Where in a file of parts a block stands; nothing for files with a place for each.
  struct Place {
    ///@{
    /// From where on, and how long.
    std::uint64_t offset = 0, bytes = 0;
    ///@}
  };

  /// Goes on from the journal of `out`, or begins one. Throws Error if another run holds it, if it
  /// was begun with another description (which line differs is in the message), or if the system
  /// refuses.
  BlockJournal(const std::filesystem::path& out, const Description& description,
               std::size_t blocks);
  /// Forgets what an earlier run of `out` left, whatever its description. Throws Error if another
  /// run holds it, or if what is in the place is no journal.
  static void discard(const std::filesystem::path& out);
  ~BlockJournal();
  BlockJournal(const BlockJournal&) = delete;
  BlockJournal& operator=(const BlockJournal&) = delete;

  /// Was there one with something finished, to go on from?
  [[nodiscard]] bool resumed() const { return resumed_; }
  /// Is it finished? block < blocks().
  [[nodiscard]] bool has(std::size_t block) const { return finished_[block] != 0; }
  /// All of them.
  [[nodiscard]] std::size_t blocks() const { return finished_.size(); }
  /// How many are finished.
  [[nodiscard]] std::size_t finished() const;
  /// Where a finished one stands.
  [[nodiscard]] Place place(std::size_t block) const { return place_[block]; }
  /// Behind all places.
  [[nodiscard]] std::uint64_t end() const;

  /// A block is written. It counts once `sync` has been called after it, which brings what was
  /// written to the disk; that is a few times a second at most. One call at
  /// a time.
  void finish(std::size_t block, Place place, const std::function<void()>& sync);
  /// The same for what waits.
  void flush(const std::function<void()>& sync);

  /// A line to find again; the last one counts.
  void note(const std::string& text);
  /// The last note, also of an earlier run; empty if there is none.
  [[nodiscard]] const std::string& noted() const { return note_; }

  /// All is written, and about to be put in its place: a run that finds this has nothing to solve.
  void complete(const std::function<void()>& sync);
  /// Is all written?
  [[nodiscard]] bool is_complete() const { return complete_; }
  /// The output is in its place: the journal goes.
  void remove();

  /// The name of the journal of an output.
  [[nodiscard]] static std::filesystem::path path_of(const std::filesystem::path& out);

 private:
  explicit BlockJournal(const std::filesystem::path& out);
  void open();
  [[nodiscard]] std::string content() const;
  void read(const std::string& header);
  void append(const std::string& text);
  [[noreturn]] void refused(int code) const;

  std::filesystem::path out_, path_;
  int file_ = -1;
  bool resumed_ = false, complete_ = false;
  std::string note_;
  std::vector<char> finished_;
  std::vector<Place> place_;
  std::vector<std::size_t> waiting_;
  std::chrono::steady_clock::duration pause_{};
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace plexway::io
