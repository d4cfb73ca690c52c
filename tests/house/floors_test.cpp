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
    {"file", 0},           {"shaders", 0},     {"common", 1},
    {"partition", 1},      {"surface", 1},     {"solid", 1},
    {"wireframe", 1},      {"cloud", 1},       {"simplicial", 1},
    {"mixed", 1},          {"source", 1},      {"metric", 1},
    {"domain", 1},         {"solve", 2},       {"labels", 2},
    {"windows", 2},        {"strings", 2},     {"executors", 3},
    {"executors.hpp", 3},  {"solve.hpp", 3},   {"support.hpp", 3},
    {"carried.hpp", 3},    {"paths", 5},       {"fields", 5},
    {"sampling", 5},       {"pairs", 5},       {"io", 6},
    {"render", 6},         {"mpi", 6},         {"shape", 7},
    {"any_domain.hpp", 7}, {"tool", 8},        {"tool_mpi", 8},
    {"plexway.hpp", 8},
};
// Beside these: what brings another library along.
const std::vector<std::string> providers = {
    "complexes/solid/tetgen/", "complexes/solid/openvdb/",         "complexes/cloud/flann/",
    "complexes/cloud/pcl/",    "complexes/wireframe/boost_graph/", "src/io/hdf5/"};
constexpr int floor_of_providers = 4;

std::string first_part(const std::string& path) { return path.substr(0, path.find('/')); }

// What follows `prefix` in `path`, or nothing.
std::optional<std::string> after(const std::string& path, const std::string& prefix) {
  if (path.rfind(prefix, 0) != 0) return std::nullopt;
  return path.substr(prefix.size());
}

// The provider that a file is part of, or nothing.
std::string provider_of(const std::string& file) {
  for (const std::string& provider : providers)
    if (file.rfind(provider, 0) == 0) return provider;
  return "";
}

// The floor of a file of the tree, or -1 if the table does not know it.
int floor_of(const std::string& file) {
  if (!provider_of(file).empty()) return floor_of_providers;
  std::string name = first_part(file);
  for (const char* folder : {"include/plexway/", "src/", "complexes/"})
    if (const auto rest = after(file, folder)) name = first_part(*rest);
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
    for (const std::string& provider : providers)
      candidates.push_back(provider + "include/" + include.name);
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
    const std::string own = provider_of(file);
    if (own.empty()) continue;
    for (const house::Include& include : house::includes_of(file)) {
      const auto target = target_of(file, include);
      const std::string other = target ? provider_of(*target) : "";
      INFO(file << ':' << include.line << ": " << include.name);
      CHECK((other.empty() || other == own));
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
                           (!provider_of(file).empty() && file.find("/include/") != file.npos);
    if (!is_public) continue;
    for (const house::Include& include : house::includes_of(file)) {
      for (const std::string& name : heavy) {
        // The one opt-in header for callers who have Eigen matrices.
        if (file == "include/plexway/common/eigen.hpp" && name == "Eigen/") continue;
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
    if (!provider_of(file).empty()) continue;
    for (const house::Include& include : house::includes_of(file)) {
      for (const std::string& name : theirs) {
        INFO(file << ':' << include.line << ": includes <" << include.name << ">");
        CHECK(include.name.rfind(name, 0) != 0);
      }
    }
  }
}

}  // namespace floors_test
