// How the default, the tuned table, the published table and the other policies do on surfaces with
// exact answers that nothing was trained on; and what was asked of the default: its error beside
// the published table's, its time beside our fastest policy's.

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <plexway/complex/intrinsic_delaunay.hpp>
#include <plexway/solve.hpp>

#include "compare.hpp"

namespace {

using Mesh = plexway::TriangleMesh<float>;

struct Policy {
  const char* name;
  bool automatic;  // on the triangles that --triangulation auto chooses
  plexway::PropagateOptions options;
};

nlohmann::json read_json(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  return nlohmann::json::parse(in);
}

std::vector<Policy> policies(const std::string& table_file) {
  using plexway::ProbeTable;
  using plexway::Visibility;
  std::vector<Policy> all;
  const auto add = [&](const char* name, bool automatic, Visibility visibility,
                       const ProbeTable& table) {
    all.push_back({name, automatic, {}});
    all.back().options = bench::one_label();
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

std::optional<Mesh> other_triangles(const bench::Surface& surface,
                                    const plexway::SaddleThresholds& saddles) {
  const plexway::TriangleMesh<double> input(surface.positions, surface.faces);
  const auto pays = plexway::what_pays(plexway::measure_triangulation(input));
  if (pays == plexway::Retriangulation::keep) return std::nullopt;
  return plexway::IntrinsicDelaunay(input, plexway::refinement_for(pays)).mesh<float>(saddles);
}

// What is asked of the default, summed up over meshes.
struct Totals {
  std::map<std::string, bench::Errors> pooled;
  std::map<std::string, std::vector<double>> means;
  std::vector<double> time_to_fastest, error_ratio;
};

std::string key(const Policy& policy) {
  return std::string(policy.name) + (policy.automatic ? ", auto" : "");
}

void measure(const bench::Surface& surface, const std::filesystem::path& folder,
             const std::vector<Policy>& all, const plexway::SaddleThresholds& saddles,
             const bench::Effort& effort, bench::Table& table, Totals& totals) {
  const auto truths = bench::read_truths(folder, surface);
  if (truths.empty()) throw std::runtime_error(surface.name + ": no exact answers");
  plexway::SurfaceHints hints;
  hints.saddles = saddles;
  const Mesh input(surface.positions, surface.faces, hints);
  const std::optional<Mesh> other = other_triangles(surface, saddles);
  const auto sources = bench::rotating_sources(surface, effort.sources);
  const double vertices = static_cast<double>(surface.positions.size());
  double fastest = 1;
  std::map<std::string, double> mean;
  plexway::Workspace<float> first_space, space;
  plexway::DistanceField<float> first_field, field;
  const auto solver = [&](const Policy& policy, auto& work, auto& result) {
    return [&policy, &work, &result,
            mesh = policy.automatic && other ? &*other : &input](bench::Index v) {
      const auto source = plexway::PointSource::at(v);
      plexway::solve(plexway::Serial{}, *mesh, {&source, 1}, policy.options, work, result);
    };
  };
  for (const Policy& policy : all) {
    const auto solve = solver(policy, space, field);
    const auto times =
        bench::take_turns(sources, effort, solver(all[0], first_space, first_field), solve);
    fastest = std::min(fastest, times.ratio);
    bench::Errors errors;
    for (const auto& truth : truths) {
      solve(truth.source);
      const std::vector<double> found(
          field.distance.begin(),
          field.distance.begin() + static_cast<std::ptrdiff_t>(surface.positions.size()));
      errors.add(truth, found);
      totals.pooled[key(policy)].add(truth, found);
    }
    const auto summary = errors.summary().value();
    mean[key(policy)] = summary.mean;
    totals.means[key(policy)].push_back(summary.mean);
    table.add({{"mesh", surface.name},
               {"vertices", surface.positions.size()},
               {"policy", policy.name},
               {"triangulation", policy.automatic && other ? "other" : "input"},
               {"ns_per_vertex", 1e9 * times.second / vertices},
               {"ratio", times.ratio},
               {"mean", summary.mean},
               {"p99", summary.p99},
               {"max", summary.max},
               {"below", summary.most_below}});
  }
  totals.time_to_fastest.push_back(1 / fastest);
  totals.error_ratio.push_back(mean["default, auto"] / mean["published table"]);
}

double average(const std::vector<double>& values) {
  double sum = 0;
  for (const double x : values) sum += x;
  return sum / static_cast<double>(values.size());
}

void sum_up(const std::vector<Policy>& all, Totals& totals, bench::Table& table) {
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
       {"ratio", bench::median(totals.time_to_fastest)},
       {"mean", average(totals.means["default, auto"]) / average(totals.means["published table"])},
       {"p99", of("default, auto").p99 / of("published table").p99},
       {"max", of("default, auto").max / of("published table").max},
       {"note", "ratios; the time is to the fastest policy, median over meshes"}});
  table.add({{"mesh", "all"},
             {"policy", "the same, mesh by mesh"},
             {"mean", bench::median(totals.error_ratio)},
             {"max", *std::max_element(totals.error_ratio.begin(), totals.error_ratio.end())},
             {"note", "median and largest of the ratios of mean errors"}});
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::string table_file, saddle_file;
  bench::Effort effort;
  bench::Report report;
  CLI::App app("The default, the tuned and the published table on surfaces with exact answers");
  app.add_option("MESH", meshes, "Surfaces (.obj .off .ply .stl), NAME.vID.txt beside them")
      ->required();
  app.add_option("--table", table_file, "Also with this table, of 'plexway tune'");
  app.add_option("--saddles", saddle_file, "The default with these thresholds, of 'plexway tune'");
  bench::add_effort_options(app, effort);
  report.add_options(app);
  CLI11_PARSE(app, argc, argv);

  bench::Table table({{"mesh", "mesh"},
                      {"vertices", "vertices"},
                      {"policy", "policy"},
                      {"triangulation", "triangles"},
                      {"ns_per_vertex", "ns/V", "%.1f"},
                      {"ratio", "ratio to default", "%.2f"},
                      {"mean", "error mean", "%.3g"},
                      {"p99", "p99", "%.3g"},
                      {"max", "max", "%.3g"},
                      {"below", "most below", "%.1e"},
                      {"note", "note"}});
  return report.write(table, [&] {
    const auto all = policies(table_file);
    const auto saddles = thresholds(saddle_file);
    Totals totals;
    for (const std::filesystem::path file : meshes) {
      std::cerr << file.stem().string() << std::endl;
      measure(bench::read_surface(file), file.parent_path(), all, saddles, effort, table, totals);
    }
    sum_up(all, totals, table);
  });
}
