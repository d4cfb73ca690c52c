#include "house/source_tree.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <regex>

namespace house {

namespace fs = std::filesystem;

const fs::path& root() {
  static const fs::path path = PLEXWAY_SOURCE_DIR;
  return path;
}

std::vector<std::string> files_under(const std::string& dir) {
  std::vector<std::string> files;
  if (!fs::is_directory(root() / dir)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(root() / dir)) {
    if (entry.is_regular_file()) {
      files.push_back(fs::relative(entry.path(), root()).generic_string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_code(const std::string& file) {
  static const std::vector<std::string> extensions = {".hpp",  ".h",    ".cpp",  ".inl",   ".inc",
                                                      ".glsl", ".comp", ".vert", ".cmake", ".frag"};
  const fs::path path = file;
  return path.filename() == "CMakeLists.txt" ||
         std::find(extensions.begin(), extensions.end(), path.extension().string()) !=
             extensions.end();
}

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream in(root() / file);
  INFO(file);
  REQUIRE(in);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<Include> includes_of(const std::string& file) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> includes;
  int number = 0;
  for (const std::string& line : lines_of(file)) {
    ++number;
    // std::regex is slow; few lines hold a '#'.
    std::smatch match;
    if (line.find('#') != std::string::npos && std::regex_search(line, match, pattern)) {
      includes.push_back({match[2], match[1] == "\"", number});
    }
  }
  return includes;
}

}  // namespace house
