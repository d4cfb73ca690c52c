#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Looks at the text of the source tree, for the tests of the house rules.
namespace house {

/// The project's source folder.
const std::filesystem::path& root();

/// Paths relative to root(), with '/', of all files under the folder `dir`; sorted. Empty if none.
std::vector<std::string> files_under(const std::string& dir);

/// True for text that a person writes as code: C++, shaders and CMake.
bool is_code(const std::string& file);

/// The lines of a file given relative to root(). Fails the running test if it cannot be read.
std::vector<std::string> lines_of(const std::string& file);

/// One `#include` line.
struct Include {
  std::string name;  ///< what stands between the quotes or brackets
  bool quoted;       ///< "..." rather than <...>
  int line;          ///< counted from 1
};

/// All include lines of a file, also those that conditions leave out.
std::vector<Include> includes_of(const std::string& file);

}  // namespace house
