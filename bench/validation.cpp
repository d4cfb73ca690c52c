// How the default, the tuned table, the published table and the other policies do on surfaces with
// exact answers that nothing was trained on; and what was asked of the default: its error beside
// the published table's, its time beside our fastest policy's.

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include <plexway/surface/intrinsic_delaunay.hpp>

#include "solver.hpp"

namespace bench::validation {

using Json = nlohmann::json;
using Mesh = plexway::TriangleMesh<float>;

struct Policy {
  const char* name;
  bool automatic;  // on the triangles that --triangulation auto chooses
  plexway::PropagateOptions options;
};

Json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return Json::parse(in);
}

std::vector<Policy> policies(const std::string& table_file) {
  using plexway::ProbeTable;
  using plexway::Visibility;
  std::vector<Policy> all;
  const auto add = [&](const char* name, bool automatic, Visibility visibility,
                       const ProbeTable& table) {
    all.push_back({name, automatic, {}});
    all.back().options = one_label();
    all.back().options.visibility = visibility;
    all.back().options.probe = table;
  };
  const ProbeTable learned = ProbeTable::learned();
  add("default", true, Visibility::saddles, learned);
  add("default", false, Visibility::saddles, learned);
  add("tuned", true, Visibility::tuned, learned);
  add("tuned", false, Visibility::tuned, learned);
  add("published table", false, Visibility::tuned, ProbeTable::published());
  add("centroid", false, Visibility::centroid, learned);
  add("upper_bound", false, Visibility::upper_bound, learned);
  if (!table_file.empty()) {
    const auto json = read_json(table_file);
    ProbeTable table = {json.at("slender"), json.at("uneven"), json.at("low"), json.at("share")};
    add("given table", false, Visibility::tuned, table);
  }
  return all;
}

plexway::SaddleThresholds thresholds(const std::string& file) {
  if (file.empty()) return plexway::SaddleThresholds::standard();
  const auto json = read_json(file);
  return {json.at("interior"), json.at("boundary"), json.at("noise_share"), json.at("most_noise"),
          json.at("agreement")};
}

std::optional<Mesh> other_triangles(const Surface& surface,
                                    const plexway::SaddleThresholds& saddles) {
  const plexway::TriangleMesh<double> input(surface.positions, surface.faces);
  const auto pays = plexway::what_pays(plexway::measure_triangulation(input));
  if (pays == plexway::Retriangulation::keep) return std::nullopt;
  return plexway::IntrinsicDelaunay(input, plexway::refinement_for(pays)).mesh<float>(saddles);
}

// What is asked of the default, summed up over meshes.
struct Totals {
  std::map<std::string, Errors> pooled;
  std::map<std::string, std::vector<double>> means;
  std::vector<double> time_to_fastest, error_ratio;
};

std::string key(const Policy& policy) {
  return std::string(policy.name) + (policy.automatic ? ", auto" : "");
}

void measure(const Surface& surface, const std::vector<Truth>& truths,
             const std::vector<Policy>& all, const plexway::SaddleThresholds& saddles,
             const Effort& effort, Table& table, Totals& totals) {
  if (truths.empty()) throw std::runtime_error(surface.name + ": no exact answers");
  plexway::SurfaceHints hints;
  hints.saddles = saddles;
  const Mesh input(surface.positions, surface.faces, hints);
  const std::optional<Mesh> other = other_triangles(surface, saddles);
  const auto sources = rotating_sources(surface, effort.sources);
  double fastest = 1;
  std::map<std::string, double> mean;
  const auto mesh_of = [&](const Policy& policy) -> const Mesh& {
    return policy.automatic && other ? *other : input;
  };
  Solver first(mesh_of(all[0]), all[0].options);
  for (const Policy& policy : all) {
    Solver solver(mesh_of(policy), policy.options);
    const Times times = take_turns(
        sources, effort, [&](Index v) { first(v); }, [&](Index v) { solver(v); });
    fastest = std::min(fastest, times.ratio);
    Errors errors;
    for (const Truth& truth : truths) {
      solver(truth.source);
      errors.add(truth, solver.distance());
      totals.pooled[key(policy)].add(truth, solver.distance());
    }
    mean[key(policy)] = errors.summary().value().mean;
    totals.means[key(policy)].push_back(mean[key(policy)]);
    Row row = {
        {"mesh", surface.name},
        {"vertices", surface.positions.size()},
        {"policy", policy.name},
        {"triangulation", policy.automatic && other ? "other" : "input"},
        {"ns_per_vertex", 1e9 * times.second / static_cast<double>(surface.positions.size())},
        {"ratio", times.ratio}};
    add_errors(row, errors);
    table.add(std::move(row));
  }
  totals.time_to_fastest.push_back(1 / fastest);
  totals.error_ratio.push_back(mean["default, auto"] / mean["published table"]);
}

double average(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

void sum_up(const std::vector<Policy>& all, Totals& totals, Table& table) {
  for (const Policy& policy : all) {
    const auto pooled = totals.pooled[key(policy)].summary().value();
    table.add({{"mesh", "all"},
               {"policy", key(policy)},
               {"mean", average(totals.means[key(policy)])},
               {"p99", pooled.p99},
               {"max", pooled.max},
               {"below", pooled.most_below},
               {"note", "mean of the means; p99 and max of all vertices"}});
  }
  const auto of = [&](const char* name) { return totals.pooled[name].summary().value(); };
  table.add(
      {{"mesh", "all"},
       {"policy", "default, auto / published table"},
       {"ratio", median(totals.time_to_fastest)},
       {"mean", average(totals.means["default, auto"]) / average(totals.means["published table"])},
       {"p99", of("default, auto").p99 / of("published table").p99},
       {"max", of("default, auto").max / of("published table").max},
       {"note", "ratios; the time is to the fastest policy, median over meshes"}});
  table.add({{"mesh", "all"},
             {"policy", "the same, mesh by mesh"},
             {"mean", median(totals.error_ratio)},
             {"max", *std::max_element(totals.error_ratio.begin(), totals.error_ratio.end())},
             {"note", "median and largest of the ratios of mean errors"}});
}

void run(Arguments& arguments) {
  Meshes meshes;
  std::string table_file, saddle_file;
  Effort effort;
  meshes.add_options(arguments);
  arguments.option("--table", &table_file, "Also with this table, of 'plexway tune'");
  arguments.option("--saddles", &saddle_file,
                   "The default with these thresholds, of 'plexway tune'");
  effort.add_options(arguments);
  Table& table = arguments.table(
      "mesh; vertices; policy; triangulation: triangles; ns_per_vertex: ns/V %.1f;"
      "ratio: ratio to default %.2f; mean: error mean %.3g; p99 %.3g; max %.3g;"
      "below: most below %.1e; note");
  if (meshes.files.empty()) throw Exit(2, "no MESH");
  const auto all = policies(table_file);
  const auto saddles = thresholds(saddle_file);
  Totals totals;
  meshes.each([&](const Surface& surface, const std::vector<Truth>& truths) {
    measure(surface, truths, all, saddles, effort, table, totals);
  });
  sum_up(all, totals, table);
}
const Command command("validation", "the tuned and published tables on surfaces never seen", run);

}  // namespace bench::validation
