#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "house/source_tree.hpp"

namespace floors_test {

namespace {

namespace fs = std::filesystem;

// Includes only point downward. A new folder or top-level header gets its floor here.
const std::map<std::string, int> floor_of_name = {
    {"error.hpp", 0},      {"version.hpp", 0}, {"kernel", 0},
    {"file", 0},           {"complex", 1},     {"source", 1},
    {"metric", 1},         {"domain", 1},      {"propagate", 2},
    {"strings", 2},        {"executors", 3},   {"executors.hpp", 3},
    {"solve.hpp", 3},      {"support.hpp", 3}, {"carried.hpp", 3},
    {"complexes", 4},      {"apps", 5},        {"io", 6},
    {"render", 6},         {"mpi", 6},         {"any", 7},
    {"any_domain.hpp", 7}, {"cli", 8},         {"cli_mpi", 8},
    {"shaders", 0},        {"plexway.hpp", 8},
};

std::string first_part(const std::string& path) { return path.substr(0, path.find('/')); }

// What follows `prefix` in `path`, or nothing.
std::optional<std::string> after(const std::string& path, const std::string& prefix) {
  if (path.rfind(prefix, 0) != 0) return std::nullopt;
  return path.substr(prefix.size());
}

// The floor of a file of the tree, or -1 if the table does not know it.
int floor_of(const std::string& file) {
  std::string name = first_part(file);
  if (const auto rest = after(file, "include/plexway/")) name = first_part(*rest);
  if (const auto rest = after(file, "src/")) name = first_part(*rest);
  const auto found = floor_of_name.find(name);
  return found == floor_of_name.end() ? -1 : found->second;
}

// The file of the tree that an include line means, or nothing for other people's headers.
std::optional<std::string> target_of(const std::string& from, const house::Include& include) {
  std::vector<std::string> candidates;
  if (include.quoted) {
    candidates.push_back((fs::path(from).parent_path() / include.name).lexically_normal());
  }
  candidates.push_back("src/" + include.name);
  candidates.push_back("include/" + include.name);
  candidates.push_back(include.name);
  candidates.push_back("shaders/" + include.name);
  if (const auto rest = after(include.name, "plexway/")) {
    candidates.push_back("complexes/" + first_part(*rest) + "/include/" + include.name);
    if (*rest == "version.hpp") return "include/plexway/version.hpp";
  }
  for (const std::string& candidate : candidates) {
    if (fs::is_regular_file(house::root() / candidate)) return candidate;
  }
  return std::nullopt;
}

std::vector<std::string> library_code() {
  std::vector<std::string> files;
  for (const char* dir : {"include", "src", "complexes", "shaders"}) {
    for (const std::string& file : house::files_under(dir)) {
      const bool is_cpp = house::is_code(file) && file.find("CMake") == std::string::npos &&
                          fs::path(file).extension() != ".cmake";
      if (is_cpp) files.push_back(file);
    }
  }
  return files;
}

}  // namespace

TEST_CASE("every file of the library stands on a known floor") {
  for (const std::string& file : library_code()) {
    INFO(file << ": give its folder a floor in tests/house/floors_test.cpp");
    CHECK(floor_of(file) >= 0);
  }
}

TEST_CASE("includes only point downward") {
  for (const std::string& file : library_code()) {
    for (const house::Include& include : house::includes_of(file)) {
      const auto target = target_of(file, include);
      if (!target) {
        INFO(file << ':' << include.line << ": there is no " << include.name);
        CHECK(include.name.rfind("plexway/", 0) != 0);
        continue;
      }
      INFO(file << ':' << include.line << ": floor " << floor_of(file) << " includes " << *target
                << " on floor " << floor_of(*target));
      CHECK(floor_of(*target) <= floor_of(file));
    }
  }
}

TEST_CASE("a provider does not include another provider") {
  for (const std::string& file : library_code()) {
    const auto own = after(file, "complexes/");
    if (!own) continue;
    for (const house::Include& include : house::includes_of(file)) {
      const auto target = target_of(file, include);
      const auto other = target ? after(*target, "complexes/") : std::nullopt;
      if (!other || other->find('/') == other->npos) continue;  // complexes/*.hpp is for all
      INFO(file << ':' << include.line << ": " << include.name);
      CHECK(first_part(*other) == first_part(*own));
    }
  }
}

TEST_CASE("public headers do not bring other libraries along") {
  const std::string opt_in_boost =
      "complexes/wireframe/boost_graph/include/plexway/boost_graph/view.hpp";
  const std::vector<std::string> heavy = {
      "tetgen", "flann/", "pcl/",   "openvdb/", "boost/", "CGAL/",      "EGL/",    "GL/",
      "GLES",   "Eigen/", "omp.h",  "CLI/",     "vtk",    "nlohmann/",  "catch2/", "stb_",
      "png.h",  "tiny",   "happly", "glad/",    "tbb/",   "benchmark/", "hdf5.h",  "mpi.h"};
  for (const std::string& file : library_code()) {
    const bool is_public = file.rfind("include/", 0) == 0 ||
                           (after(file, "complexes/") && file.find("/include/") != file.npos);
    if (!is_public) continue;
    for (const house::Include& include : house::includes_of(file)) {
      for (const std::string& name : heavy) {
        // The one opt-in header for callers who have Eigen matrices.
        if (file == "include/plexway/complex/eigen.hpp" && name == "Eigen/") continue;
        // The one opt-in header for callers who run Boost.Graph's algorithms on a complex.
        if (file == opt_in_boost && name == "boost/") continue;
        INFO(file << ':' << include.line << ": includes <" << include.name << ">");
        CHECK(include.name.rfind(name, 0) != 0);
      }
    }
  }
}

TEST_CASE("headers that bring a library along are included by no other file") {
  for (const std::string& file : library_code()) {
    for (const house::Include& include : house::includes_of(file)) {
      INFO(file << ':' << include.line << ": " << include.name);
      CHECK(include.name != "plexway/boost_graph/view.hpp");
    }
  }
}

TEST_CASE("below the providers nothing includes their libraries") {
  const std::vector<std::string> theirs = {"tetgen",   "flann/", "pcl/",
                                           "openvdb/", "boost/", "CGAL/"};
  for (const std::string& file : library_code()) {
    if (after(file, "complexes/")) continue;
    for (const house::Include& include : house::includes_of(file)) {
      for (const std::string& name : theirs) {
        INFO(file << ':' << include.line << ": includes <" << include.name << ">");
        CHECK(include.name.rfind(name, 0) != 0);
      }
    }
  }
}

}  // namespace floors_test
