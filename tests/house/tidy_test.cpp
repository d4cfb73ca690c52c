#include <algorithm>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "house/source_tree.hpp"

namespace tidy_test {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_lines = 500;

std::string text_of(const std::string& file) {
  std::string text;
  for (const std::string& line : house::lines_of(file)) text += line + '\n';
  return text;
}

// The package names of cmake/packages.txt.
std::set<std::string> listed_packages() {
  std::set<std::string> packages;
  for (std::string line : house::lines_of("cmake/packages.txt")) {
    line.resize(std::min(line.find('#'), line.size()));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (!line.empty() && line.front() != '[') packages.insert(line);
  }
  return packages;
}

}  // namespace

TEST_CASE("one idea a file: none is too long") {
  for (const char* dir :
       {"include", "src", "complexes", "tests", "examples", "bench", "shaders", "data", "cmake"}) {
    for (const std::string& file : house::files_under(dir)) {
      if (!house::is_code(file)) continue;
      INFO(file);
      CHECK(house::lines_of(file).size() <= most_lines);
    }
  }
}

TEST_CASE("headers have an include guard that cannot clash") {
  for (const char* dir :
       {"include", "src", "complexes", "tests", "bench", "examples", "python", "web/module"}) {
    for (const std::string& file : house::files_under(dir)) {
      if (fs::path(file).extension() != ".hpp") continue;
      const auto lines = house::lines_of(file);
      INFO(file);
      CHECK(std::find(lines.begin(), lines.end(), "#pragma once") != lines.end());
    }
  }
}

TEST_CASE("internal headers do not open plexway itself") {
  // What is public and defined in an internal header all the same.
  const std::set<std::string> public_too = {
      "src/executors/gl/workspace.hpp",  // what GLWorkspace holds
      "src/executors/run.hpp",           // the verbs, compiled for each executor and domain
      "src/shape/files/kept_build.hpp",  // declares BuildOptions
      "src/shape/prepared.hpp",          // what AnyDomain and AnyPathField hold
      "src/shape/shape_state.hpp",       // what AnyShape holds
  };
  std::size_t met = 0;
  for (const char* dir : {"include", "src", "complexes"}) {
    for (const std::string& file : house::files_under(dir)) {
      if (fs::path(file).extension() != ".hpp") continue;
      const auto lines = house::lines_of(file);
      const auto has = [&](const char* line) {
        return std::find(lines.begin(), lines.end(), line) != lines.end();
      };
      const bool is_public =
          file.find("include/") != file.npos && file.find("/detail/") == file.npos;
      INFO(file);
      if (file.find("include/") != file.npos)
        CHECK(text_of(file).find("using namespace") == std::string::npos);
      if (is_public) continue;
      CHECK(has("namespace plexway {") == (public_too.count(file) == 1));
      met += public_too.count(file);
    }
  }
  CHECK(met == public_too.size());
}

TEST_CASE("a folder of the library has at most 26 files") {
  std::map<fs::path, int> count;
  for (const char* dir : {"include", "src", "complexes", "shaders"})
    for (const std::string& file : house::files_under(dir)) ++count[fs::path(file).parent_path()];
  for (const auto& [folder, files] : count) {
    INFO(folder.string());
    CHECK(files <= 26);
  }
}

TEST_CASE("the top level is the one agreed on") {
  const std::set<std::string> agreed = {"CMakeLists.txt",
                                        "include",
                                        "src",
                                        "complexes",
                                        "tests",
                                        "examples",
                                        "shaders",
                                        "data",
                                        "docs",
                                        "README.md",
                                        "CHANGELOG.md",
                                        "cmake",
                                        "python",
                                        "pyproject.toml",
                                        "setup.py",
                                        "bench",
                                        "web",
                                        "LICENSE",
                                        ".ci",
                                        ".git",
                                        "CONTRIBUTING.md",
                                        "SECURITY.md",
                                        "CITATION.cff",
                                        "MANIFEST.in",
                                        ".clang-format",
                                        ".clang-tidy",
                                        ".gitignore",
                                        "build",
                                        "CMakePresets.json",
                                        "CMakeUserPresets.json"};
  for (const auto& entry : fs::directory_iterator(house::root())) {
    const std::string name = entry.path().filename().string();
    // An editor's or a tool's own folder is nobody's business here.
    if (name.front() == '.' || name.rfind("build", 0) == 0) continue;
    INFO(name);
    CHECK(agreed.count(name) == 1);
  }
}

TEST_CASE("one package list serves the README's commands and CI") {
  const std::string readme = text_of("README.md");
  CHECK(readme.find(".ci/demo") != readme.npos);
  CHECK(readme.find(".ci/test") != readme.npos);
  CHECK(text_of(".ci/packages").find("cmake/packages.txt") != std::string::npos);
  CHECK(text_of(".ci/demo").find(".ci/packages") != std::string::npos);
  CHECK(text_of(".ci/test").find(".ci/packages") != std::string::npos);
  CHECK(text_of(".ci/run").find(".ci/test") != std::string::npos);
  for (const char* file : {"README.md", "CONTRIBUTING.md", ".ci/demo", ".ci/test", ".ci/run"}) {
    INFO(file << " must leave installing to .ci/packages");
    CHECK(text_of(file).find("apt-get") == std::string::npos);
    CHECK(text_of(file).find("apt install") == std::string::npos);
  }
}

TEST_CASE("recipes of other packages have the project's version, and options that there are") {
  std::smatch version;
  const std::string project = text_of("CMakeLists.txt");
  REQUIRE(std::regex_search(project, version, std::regex(R"(project\(plexway VERSION ([0-9.]+))")));
  CHECK(text_of("cmake/vcpkg/plexway/vcpkg.json").find("\"version\": \"" + version.str(1) + "\"") !=
        std::string::npos);
  CHECK(text_of("cmake/conda/meta.yaml").find("set version = \"" + version.str(1) + "\"") !=
        std::string::npos);
  const std::string known =
      project + text_of("complexes/CMakeLists.txt") + text_of("src/CMakeLists.txt");
  static const std::regex option("-D(PLEXWAY_(?:BUILD_|INSTALL|WITH_)([A-Z0-9_]*))=");
  for (const auto& [file, expected] :
       {std::pair{"cmake/vcpkg/plexway/portfile.cmake", 5}, std::pair{"cmake/conda/meta.yaml", 7},
        std::pair{"pyproject.toml", 7}}) {
    const std::string recipe = text_of(file);
    int options = 0;
    for (std::sregex_iterator it(recipe.begin(), recipe.end(), option), end; it != end;
         ++it, ++options) {
      INFO(file << ": " << it->str(1));
      std::string part = it->str(2);
      for (char& message : part) message = char(std::tolower(static_cast<unsigned char>(message)));
      CHECK((known.find("option(" + it->str(1) + " ") != std::string::npos ||
             known.find("plexway_provider_wanted(" + part + " ") != std::string::npos));
    }
    CHECK(options == expected);
  }
}

TEST_CASE("packages that build messages name are on the list") {
  const std::set<std::string> listed = listed_packages();
  CHECK(listed.count("catch2") == 1);
  static const std::regex named(R"(PACKAGE\s+([a-z0-9.+-]+)|left out: ([a-z0-9.+-]+) is not)");
  for (const char* dir : {"cmake", "complexes", "tests", "bench", "examples", "src", "python"}) {
    for (const std::string& file : house::files_under(dir)) {
      const fs::path path = file;
      if (path.filename() != "CMakeLists.txt" && path.extension() != ".cmake") continue;
      const std::string text = text_of(file);
      for (std::sregex_iterator it(text.begin(), text.end(), named), end; it != end; ++it) {
        const std::string package = (*it)[1].matched ? (*it)[1] : (*it)[2];
        INFO(file << " names the package " << package);
        CHECK(listed.count(package) == 1);
      }
    }
  }
}

}  // namespace tidy_test
