#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace plexway::detail::file {

/// A temporary file that whoever ends this process by a signal should see removed. A list for the
/// whole process, of 64 at most; what does not fit is not on it.
class Unfinished {
 public:
  explicit Unfinished(const char* path);
  ~Unfinished();
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::size_t place_;
};

/// Removes all files of the list. May be called by a handler of signals.
void remove_unfinished() noexcept;

/// Holds signals that end a process back while it lives, in this thread.
class SignalsHeld {
 public:
  SignalsHeld();
  ~SignalsHeld();
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  unsigned char before_[128];
};

/// A file that appears whole or not at all.
///
/// Where the system has files without a name it is one until `commit`, so nothing stays behind
/// whatever ends the process; elsewhere it is NAME.plexway-partN, which whoever writes NAME next
/// removes after a kill, and on the list of unfinished files. Links stay links, their ends there or
/// not. A file that is replaced gives mode and owner to the new one; one that may not be written
/// is not. A target that exists and is no regular file (a pipe, a device) is written directly,
/// and so is standard output, by the name that format_on_standard_output() gives it. All but
/// `write` throw Error "cannot write FILE: reason"; without `commit` nothing is left behind.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& file);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Where it is written, for who can only write to a name.
  [[nodiscard]] std::string place() const;
  /// Whether what was written can be gone back to.
  [[nodiscard]] bool seekable() const { return way_ != Way::direct; }
  /// Writes all of it; errno where that failed, or 0.
  [[nodiscard]] int write(const char* bytes, std::size_t size) noexcept;
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// Waits until the disk has it; errno where that failed, or 0.
  [[nodiscard]] int synchronise() noexcept;

  /// Puts the file in its place.
  void commit();
  /// Leaves nothing behind, and throws for this errno; OutputClosed where the reader of standard
  /// output is gone.
  [[noreturn]] void refuse(int reason);
  [[noreturn]] void refuse(const std::string& reason);

  /// For tests: as where the system has no files without a name.
  static inline bool always_named = false;

 private:
  enum class Way { direct, nameless, named };

  void open_nameless();
  void open_named();
  [[nodiscard]] std::filesystem::path beside(int attempt) const;
  [[nodiscard]] int link_nameless();
  void discard() noexcept;

  std::filesystem::path given_;    ///< as the caller names it, for messages
  std::filesystem::path target_;   ///< with symbolic links resolved
  std::filesystem::path written_;  ///< the temporary file's name, where it has one
  std::optional<Unfinished> listed_;
  Way way_ = Way::direct;
  bool standard_output_ = false;
  int descriptor_ = -1;
};

/// Where a chain of symbolic links ends, be there a file or not. Throws std::system_error.
std::filesystem::path end_of_links(std::filesystem::path file);

/// Thrown where the reader of standard output went away: no error, but no reason to go on.
struct OutputClosed {};

/// "FORMAT:-" is standard output as a file of that format: the format, ascii letters in lower case
/// and digits, or nothing for any other name. A file of such a name is "./FORMAT:-".
inline std::string_view format_on_standard_output(std::string_view name) {
  if (name.size() < 4 || name.size() > 10 || !name.ends_with(":-")) return {};
  name.remove_suffix(2);
  for (const char c : name)
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'))) return {};
  return name;
}

}  // namespace plexway::detail::file
