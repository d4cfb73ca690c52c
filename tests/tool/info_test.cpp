#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "folder.hpp"
#include "io/io_testing.hpp"
#include "tool/tool.hpp"

namespace info_test {

using namespace cli_testing;
using io_testing::Folder;

namespace {

nlohmann::json info_of(const std::string& file) {
  const auto run = ran({"info", file, "--json"});
  CHECK(run.err.empty());
  return run.json();
}

// Drivers are other people's code, and not built for that.
void without_drivers_under_sanitizers() {
#ifdef PLEXWAY_SANITIZED
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/none", 1);
#endif
}

bool warns_of(const nlohmann::json& info, const std::string& what) {
  for (const auto& warning : info["warnings"]) {
    if (warning.get<std::string>().find(what) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("info counts and measures") {
  const Folder folder;
  const auto info = info_of(folder.write("square.off", square_off(5)));
  CHECK(info["kind"] == "surface");
  CHECK(info["vertices"] == 25);
  CHECK(info["simplices"] == 32);
  CHECK(info["edges"] == 56);
  CHECK(info["boundary_edges"] == 16);
  CHECK(info["components"] == 1);
  CHECK(info["orientable"] == true);
  CHECK(info["bounding_box"]["min"] == nlohmann::json{0.0, 0.0, 0.0});
  CHECK(info["bounding_box"]["max"] == nlohmann::json{1.0, 1.0, 0.0});
  CHECK(info["edge_length"]["min"].get<double>() == Approx(0.25));
  CHECK(info["edge_length"]["max"].get<double>() == Approx(0.25 * std::sqrt(2.0)));
  CHECK(info["edge_length"]["mean"].get<double>() == Approx(0.25 * (2 + std::sqrt(2.0)) / 3));
  CHECK(info["slender_share"] == 0);
  CHECK(warns_of(info, "16 boundary edges"));
}

TEST_CASE("info has nothing to warn of on a good surface") {
  CHECK(info_of(sample("torus.obj"))["warnings"].empty());
  const auto run = ran({"info", sample("torus.obj")});
  CHECK(run.out.find("1152 vertices") != std::string::npos);
}

TEST_CASE("info warns of what may surprise") {
  CHECK(warns_of(info_of(sample("two_parts.obj")), "2 components"));
  CHECK(warns_of(info_of(sample("two_parts.obj")), "1 unreferenced vertex"));
  CHECK(warns_of(info_of(sample("moebius.obj")), "not orientable"));
  CHECK(warns_of(info_of(sample("slit.off")), "exactly where another one lies"));
  const Folder folder;
  const std::string fan =
      folder.write("fan.obj",
                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 2 0 0\nf 1 2 3\nf 1 2 4\nf 1 2 "
                   "5\nf 1 2 6\n");
  const auto info = info_of(fan);
  CHECK(info["non_manifold_edges"] == 1);
  CHECK(info["degenerate_simplices"] == 1);
  CHECK(warns_of(info, "non-manifold"));
  CHECK(warns_of(info, "without area"));
  CHECK(warns_of(info, "slender"));
}

TEST_CASE("slender triangles are told from others in any unit") {
  const Folder folder;
  for (const double unit : {1.0, 1e-200, 1e150}) {
    const auto share = [&](double height) {
      std::ostringstream obj;
      obj << "v 0 0 0\nv " << unit << " 0 0\nv 0 " << unit * height << " 0\nf 1 2 3\n";
      return info_of(folder.write("one.obj", obj.str()))["slender_share"].get<double>();
    };
    INFO(unit);
    CHECK(share(0.2) == 0);
    CHECK(share(0.05) == 1);
    CHECK(share(0) == 1);
  }
}

TEST_CASE("info lists executors and devices") {
  without_drivers_under_sanitizers();
  const auto text = run_tool({"info", "--devices"});
  CHECK(text.code == 0);
  CHECK(text.err.empty());
  CHECK(text.out.find("serial") == 0);
  const auto json = run_tool({"info", "--devices", "--json"}).json();
  const auto& executors = json["executors"];
  CHECK(executors[0] == "serial");
  CHECK(json["cores"] >= 1);
  const bool gl = std::find(executors.begin(), executors.end(), "gl") != executors.end();
  CHECK(json.contains("gl_devices") == gl);
  if (!gl) return;
  if (json["gl_devices"].empty()) CHECK(json.contains("gl_problem"));
  for (const auto& device : json["gl_devices"]) {
    if (device.contains("problem")) continue;
    CHECK(device["largest_buffer"] > 0);
    CHECK(text.out.find(device["renderer"].get<std::string>()) != std::string::npos);
  }
}

// On a curved surface which of two paths a triangle keeps is a matter of the order of updates: the
// serial executor's own steps and schedules give 2.907 to 2.945 for the farthest vertex of the
// torus. Where the surface is flat, order decides nothing.
TEST_CASE("the gl executor is as accurate as labels are, or says why not") {
  without_drivers_under_sanitizers();
  const auto json = run_tool({"info", "--devices", "--json"}).json();
  const auto solve_on = [](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"distance", file, "--source", "vertex:7", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_tool(arguments);
  };
  const auto solve = [&](const std::vector<std::string>& more) {
    return solve_on(sample("torus.obj"), more);
  };
  const auto farthest = [](const auto& run) {
    REQUIRE(run.code == 0);
    return run.json()["max_distance"].template get<double>();
  };
  const auto& executors = json["executors"];
  const auto gl = solve({"--executor", "gl"});
  if (std::find(executors.begin(), executors.end(), "gl") == executors.end() ||
      json["gl_devices"].empty()) {
    CHECK(gl.code == 4);
    CHECK(gl.complaints() == 1);
    return;
  }
  INFO(gl.err);
  REQUIRE(gl.code == 0);
  CHECK(gl.json()["executor"] == "gl");
  CHECK(farthest(gl) == Approx(farthest(solve({"--accuracy", "exact"}))).epsilon(2e-2));
  const Folder folder;
  const std::string square = folder.write("square.off", square_off(20));
  CHECK(farthest(solve_on(square, {"--executor", "gl"})) ==
        Approx(farthest(solve_on(square, {}))).epsilon(1e-5));
  CHECK(solve({"--executor", "gl", "--schedule", "priority"}).code == 2);
  CHECK(solve({"--executor", "gl", "--precision", "double"}).code == 2);
  CHECK(solve({"--executor", "gl", "--visibility", "tuned"}).code == 2);
  CHECK(solve({"--executor", "gl", "--device", "99"}).code == 2);
}

TEST_CASE("help and version go to standard output") {
  for (const std::vector<std::string>& command :
       std::vector<std::vector<std::string>>{{"--help"},
                                             {"distance", "--help"},
                                             {"info", "--help"},
                                             {"bench", "--help"},
                                             {"tetrahedralize", "--help"}}) {
    const auto run = run_tool(command);
    CHECK(run.code == 0);
    CHECK(run.err.empty());
    CHECK(run.out.find("Examples:") != std::string::npos);
  }
  const auto version = run_tool({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.rfind("plexway 0.", 0) == 0);
  CHECK(version.out.find("MIT") != std::string::npos);
#ifdef PLEXWAY_HAS_TETGEN
  CHECK(version.out.find("TetGen 1.5 (AGPL)") != std::string::npos);
#endif
}

// The manual page and the completions have what --help has.

namespace {

std::string page(const std::string& kind) {
  const auto run = ran({"--help-page", kind});
  CHECK(run.err.empty());
  return run.out;
}

std::set<std::string> matches(const std::string& text, const char* pattern) {
  const std::regex looked_for(pattern);
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), looked_for), end; at != end; ++at)
    found.insert((*at)[1]);
  return found;
}

}  // namespace

TEST_CASE("the manual page and the completions know every command and option") {
  const std::string all = run_tool({"--help"}).out;
  auto commands = matches(all.substr(all.find("Subcommands:")), "\\n  ([a-z]+) ");
  commands.erase("plexway");  // an example
  REQUIRE(commands.size() >= 11);
  const std::string man = page("man"), bash = page("bash"), zsh = page("zsh"), fish = page("fish");
  std::size_t options = 0;
  for (const std::string& command : commands) {
    INFO(command);
    CHECK(man.find("\\fB" + command + "\\fR") != man.npos);
    CHECK(zsh.find("  " + command + ")\n") != zsh.npos);
    const auto at = bash.find("      " + command + ") words=");
    REQUIRE(at != bash.npos);
    const std::string words = bash.substr(at, bash.find(";;", at) - at);
    const std::string help = run_tool({command, "--help"}).out;
    for (const std::string& name : matches(help, "\\n  (?:-[a-zA-Z],)?(--[a-z-]+)")) {
      INFO(name);
      ++options;
      CHECK(std::regex_search(words, std::regex("[ \"]" + name + "[ \"]")));
      CHECK(zsh.find("'*" + name + "[") != zsh.npos);
      CHECK(fish.find("-l " + name.substr(2) + " ") != fish.npos);
      CHECK(man.find("\\fB" + std::regex_replace(name, std::regex("-"), "\\-")) != man.npos);
    }
  }
  CHECK(options > 100);
  CHECK(man.find("\\e") == man.npos);  // no escape is shown as text
  CHECK(run_tool({"--help-page", "teapot"}).code == 2);
}

TEST_CASE("-h is a screen: 25 lines of 80 columns with three examples") {
  const std::string tool = run_tool({"--help"}).out;
  auto commands = matches(tool.substr(tool.find("Subcommands:")), "\\n  ([a-z]+) ");
  commands.erase("plexway");  // an example
  REQUIRE(commands.size() >= 11);
  commands.insert("");
  for (const std::string& command : commands) {
    INFO(command);
    const auto run = command.empty() ? run_tool({"-h"}) : run_tool({command, "-h"});
    CHECK(run.code == 0);
    std::istringstream lines(run.out);
    std::size_t count = 0, examples = 0;
    for (std::string line; std::getline(lines, line); ++count) {
      INFO(line);
      CHECK(line.size() <= 80);
      examples += line.starts_with("  plexway ");
    }
    CHECK(count <= 25);
    CHECK(examples == 3);
  }
}

TEST_CASE("without its program TetGen is not there, and that is no fault of the surface") {
  const testing::Folder empty;
  ::setenv("PLEXWAY_HELPERS", empty.path().c_str(), 1);
  const auto run = run_tool({"tetrahedralize", sample("elbow.off"), "--out", empty.at("e.vtu")});
  ::unsetenv("PLEXWAY_HELPERS");
  CHECK(run.code == 4);
  CHECK(run.complaints() == 1);
  CHECK(empty.files() == 0);
}

}  // namespace info_test
