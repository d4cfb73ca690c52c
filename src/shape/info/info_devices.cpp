#include <algorithm>
#include <string>
#include <string_view>
#include <thread>

#include <plexway/error.hpp>

#include "shape/info/info_report.hpp"
#include "shape/info/solve_words.hpp"

namespace plexway {
namespace {

#ifdef PLEXWAY_HAS_GL
// What EGL offers, or why it offers nothing: no reason to fail when one only asks.
void add_gl(InfoReport& report) {
  Json devices = Json::array();
  try {
    for (const GLDevice& d : gl_devices()) {
      const std::string name = "gl " + std::to_string(d.number);
      if (!d.problem.empty()) {
        devices.push_back({{"number", d.number}, {"problem", d.problem}});
        report.table.add(name, "cannot be used: " + d.problem);
        continue;
      }
      devices.push_back({{"number", d.number},
                         {"vendor", d.vendor},
                         {"renderer", d.renderer},
                         {"version", d.version},
                         {"software", d.software},
                         {"largest_buffer", d.largest_buffer},
                         {"group_size", d.group_size}});
      report.table.add(name, d.renderer + ", " + d.vendor + ", OpenGL " + d.version +
                                 (d.software ? ", in software" : "") + "; buffers up to " +
                                 std::to_string(d.largest_buffer >> 20) + " MiB");
    }
  } catch (const NotBuiltError& error) {
    report.json["gl_problem"] = error.what();
    report.table.add("gl", std::string("no device: ") + error.what());
  }
  report.json["gl_devices"] = devices;
}
#endif

}  // namespace

InfoReport info_of_devices() {
  InfoReport report;
  const auto built = built_executors();
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  report.json["executors"] = Json::array();
  for (const std::string_view name : built) report.json["executors"].push_back(name);
  report.json["cores"] = cores;
  for (const std::string_view name : built) {
    if (name == "serial") report.table.add("serial", "one thread");
    if (name == "openmp") report.table.add("openmp", "up to " + counted(cores, "cores"));
  }
#ifdef PLEXWAY_HAS_GL
  add_gl(report);
#endif
  return report;
}

}  // namespace plexway
