#include "house/support_page.hpp"

#include <array>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include <plexway/shape/support.hpp>
#include <plexway/support.hpp>

namespace house {
namespace {

using namespace plexway;

template <class Value>
struct Named {
  const char* name;
  Value value;
};

struct Row {
  const char* name;
  DomainKind kind;
  int dimension;
};
constexpr std::array<Row, 7> rows = {{{"surface", DomainKind::surface, 2},
                                      {"solid", DomainKind::solid, 3},
                                      {"wireframe", DomainKind::wireframe, 1},
                                      {"simplices, dimension 1 to 3", DomainKind::simplices, 3},
                                      {"simplices, dimension 4", DomainKind::simplices, 4},
                                      {"cloud", DomainKind::cloud, 2},
                                      {"mixed", DomainKind::mixed, 3}}};
constexpr std::array<Named<ExecutorKind>, 3> executors = {
    {{"Serial", ExecutorKind::serial}, {"OpenMP", ExecutorKind::openmp}, {"GL", ExecutorKind::gl}}};
constexpr std::array<Named<SourceKind>, 4> sources = {{{"vertices, balls", SourceKind::vertex},
                                                       {"points", SourceKind::point},
                                                       {"curves", SourceKind::curve},
                                                       {"simplices", SourceKind::simplex}}};
constexpr std::array<Named<Visibility>, 4> visibilities = {
    {{"saddles", Visibility::saddles},
     {"tuned", Visibility::tuned},
     {"centroid", Visibility::centroid},
     {"upper_bound", Visibility::upper_bound}}};
constexpr std::array<Named<Schedule>, 3> schedules = {{{"dual_queue", Schedule::dual_queue},
                                                       {"fifo", Schedule::fifo},
                                                       {"priority", Schedule::priority}}};
constexpr std::array<Named<Accuracy::Kind>, 3> accuracies = {{{"fast", Accuracy::Kind::fast},
                                                              {"accurate", Accuracy::Kind::merged},
                                                              {"exact", Accuracy::Kind::exact}}};

// What is measured otherwise is a column of its own where only that matters.
constexpr std::array<Named<Combination>, 8> measured = [] {
  const auto of = [](DomainKind kind, int dimension, MetricKind metric) -> Combination {
    return {ExecutorKind::serial, kind, dimension, true, metric};
  };
  using enum DomainKind;
  using enum MetricKind;
  return std::array<Named<Combination>, 8>{{{"surface", of(surface, 2, intrinsic)},
                                            {"surface, refracting", of(surface, 2, refracting)},
                                            {"solid", of(solid, 3, embedded)},
                                            {"solid, lengths", of(solid, 3, intrinsic)},
                                            {"wireframe", of(wireframe, 1, intrinsic)},
                                            {"simplices", of(simplices, 3, intrinsic)},
                                            {"cloud", of(cloud, 2, intrinsic)},
                                            {"mixed", of(mixed, 3, intrinsic)}}};
}();

// Files as they are, and as they may be taken.
constexpr std::array<Named<FileUse>, 15> files = [] {
  using enum DomainKind;
  return std::array<Named<FileUse>, 15>{
      {{"surface", {surface, surface}},
       {"surface as solid", {surface, solid}},
       {"surface as wireframe", {surface, wireframe}},
       {"surface as cloud", {surface, cloud}},
       {"solid", {solid, solid}},
       {"solid as surface", {solid, surface}},
       {"wireframe", {wireframe, wireframe}},
       {"simplices", {simplices, simplices}},
       {"cloud", {cloud, cloud}},
       {"mixed", {mixed, mixed}},
       {".poly", {solid, solid, FileForm::boundary}},
       {".vdb", {solid, solid, FileForm::level_set}},
       {".vdb as surface", {solid, surface, FileForm::level_set}},
       {".plexway", {surface, surface, FileForm::prepared}},
       {"surface in parts", {surface, surface, FileForm::parts}}}};
}();
#define PLEXWAY_READING(name, what) {what, Reading::name},
constexpr Named<Reading> readings[] = {PLEXWAY_READINGS(PLEXWAY_READING)};
#undef PLEXWAY_READING
constexpr std::array<Named<Triangulation>, 4> triangulations = {
    {{"input", Triangulation::input},
     {"delaunay", Triangulation::delaunay},
     {"refined", Triangulation::refined},
     {"automatic", Triangulation::automatic}}};

#define PLEXWAY_PURPOSE(name, what, ...) {what, Purpose::name},
constexpr Named<Purpose> purposes[] = {PLEXWAY_PURPOSES(PLEXWAY_PURPOSE)};
#undef PLEXWAY_PURPOSE

MetricKind usual_metric(DomainKind kind) {
  return kind == DomainKind::solid ? MetricKind::embedded : MetricKind::intrinsic;
}

// Numbers of sentences, in the order in which they come up.
class Page {
 public:
  std::string text() {
    std::string tables = executor_table();  // one after another: numbers go in that order
    tables += option_tables();
    tables += purpose_table();
    tables += lengths_table();
    tables += parts_text();
    tables += file_table();
    tables += build_table();
    return "# What is supported\n\n"
           "Made from `support.hpp`, `domain/support.hpp` and `shape/support.hpp` in "
           "`include/plexway` by "
           "`ninja plexway_support_page`;\n"
           "a test of the house compares them. What is not supported is refused with the "
           "sentence of the number, by the "
           "compiler where types\n"
           "alone tell. `float` and `double`: only domains of that precision.\n" +
           tables + sentences();
  }

 private:
  static std::string in_cell(std::string text) { return text.insert(0, 1, ' ').append(" |"); }

  std::string number(Refusal refusal) {
    const auto [found, fresh] = numbers_.try_emplace(refusal, numbers_.size() + 1);
    if (fresh) order_.push_back(refusal);
    return "no [" + std::to_string(found->second) + "]";
  }

  static Combination cell(ExecutorKind executor, const Row& row, bool single) {
    return {executor, row.kind, row.dimension, single, usual_metric(row.kind)};
  }

  // Of both precisions.
  template <class Change>
  std::string entry(ExecutorKind executor, const Row& row, const Change& change) {
    std::array<Support, 2> found;
    for (const bool single : {false, true}) {
      Combination c = cell(executor, row, single);
      change(c);
      found[single] = support(c);
    }
    if (found[0] && found[1]) return "yes";
    if (found[0]) return "double [" + number(found[1].refusal()).substr(4);
    if (found[1]) return "float [" + number(found[0].refusal()).substr(4);
    // Where there is another reason than the precision, that is the one.
    return number(found[found[0].refusal() == Refusal::gl_double].refusal());
  }

  static std::string head(std::string_view first, const auto& columns, const char* quote = "") {
    std::string text = "\n|", rule = "|---|";
    text.append(first).append("|");
    for (const char c : first)
      if (c == '|') rule += "---|";
    for (const auto& column : columns) {
      text.append(" ").append(quote).append(column.name).append(quote).append(" |");
      rule += "---|";
    }
    return text.append("\n").append(rule).append("\n");
  }

  std::string executor_table() {
    std::string text = "\n## Executors\n\nAnything at all: from a vertex, by default options.\n";
    text += head(" domain ", executors, "`");
    for (const Row& row : rows) {
      text.append("| ").append(row.name).append(" |");
      for (const auto& e : executors) text += in_cell(entry(e.value, row, [](Combination&) {}));
      text += "\n";
    }
    return text;
  }

  template <class Values, class Change>
  std::string table(const char* heading, const Values& values, const Change& change) {
    std::string text = std::string("\n## ") + heading + "\n";
    text += head(" domain | executor ", values);
    for (const Row& row : rows)
      for (const auto& e : executors) {
        if (!support(cell(e.value, row, true))) continue;
        text.append("| ").append(row.name).append(" | `").append(e.name).append("` |");
        for (const auto& v : values)
          text += in_cell(entry(e.value, row, [&](Combination& c) { change(c, v.value); }));
        text += "\n";
      }
    return text;
  }

  std::string option_tables() {
    std::string text =
        table("Sources", sources, [](Combination& c, SourceKind v) { c.source = v; });
    text += table("Accuracy", accuracies, [](Combination& c, Accuracy::Kind v) { c.accuracy = v; });
    text +=
        table("Visibility", visibilities, [](Combination& c, Visibility v) { c.visibility = v; });
    text += table("Schedule", schedules, [](Combination& c, Schedule v) { c.schedule = v; });
    return text + metric_table();
  }

  std::string metric_table() {
    std::string text = "\n## Metric\n\nSurfaces that refract, and solids of intrinsic lengths.\n";
    text += head(" domain ", executors, "`");
    const std::array<Named<MetricKind>, 2> metrics = {
        {{"surface, refracting", MetricKind::refracting},
         {"solid, lengths", MetricKind::intrinsic}}};
    for (std::size_t i = 0; i < metrics.size(); ++i) {
      text.append("| ").append(metrics[i].name).append(" |");
      for (const auto& e : executors)
        text +=
            in_cell(entry(e.value, rows[i], [&](Combination& c) { c.metric = metrics[i].value; }));
      text += "\n";
    }
    return text;
  }

  std::string purpose_table() {
    std::string text =
        "\n## Besides solving\n\nAfter a solve by `Serial` or `OpenMP`, by saddles. What draws or "
        "measures in space needs positions besides.\n";
    text += head("  ", measured);
    for (const auto& purpose : purposes) {
      text.append("| ").append(purpose.name).append(" |");
      for (const auto& m : measured) {
        Support found = support(purpose.value, m.value);
        if (!found) {
          Combination team = m.value;
          team.executor = ExecutorKind::openmp;
          // Where the executor alone is not it, the reason is the team's.
          const Support by_team = support(purpose.value, team);
          if (by_team || found.refusal() == Refusal::ranks_executor) found = by_team;
        }
        text += in_cell(verdict(found));
      }
      text += "\n";
    }
    return text;
  }

  std::string verdict(Support found) { return found ? "yes" : number(found.refusal()); }

  // What changes without positions.
  std::string lengths_table() {
    std::array<Named<Combination>, 4> alone = {
        {measured[0], measured[3], measured[4], measured[5]}};
    for (auto& m : alone) m.value.positions = false;
    std::string text =
        "\n## Of intrinsic lengths\n\nWithout positions in space; what is not in this table is as "
        "above.\n" +
        head(" ", alone);
    for (const auto& purpose : purposes) {
      bool other = false;
      std::string row = std::string("| ") + purpose.name + " |";
      for (const auto& m : alone) {
        Combination placed = m.value;
        placed.positions = true;
        const Support found = support(purpose.value, m.value);
        other |= found.refusal() != support(purpose.value, placed).refusal();
        row += in_cell(verdict(found));
      }
      if (other) text.append(row).append("\n");
    }
    return text;
  }

  // What is left in parts.
  std::string parts_text() {
    Combination parted = measured[0].value;
    parted.executor = ExecutorKind::openmp, parted.in_parts = true;
    std::string kept, sentence;
    for (const auto& purpose : purposes) {
      const Support found = support(purpose.value, parted);
      if (found) kept.append(kept.empty() ? "" : "; ").append(purpose.name);
      if (found.refusal() == Refusal::in_parts_whole) sentence = verdict(found);
    }
    return "\n## In parts over processes\n\nA surface that no process has as a whole supports: " +
           kept + ". All else of the tables above: " + sentence + ".\n";
  }

  std::string file_table() {
    std::string text =
        "\n## Files\n\nWhat may be asked for as one is read. A voxel goes with a repair, too, and "
        "with a field to be written as a `.vdb`.\n";
    text += head(" file ", readings);
    for (const auto& file : files) {
      text.append("| ").append(file.name).append(" |");
      for (const auto& reading : readings)
        text += in_cell(verdict(support(reading.value, file.value)));
      text += "\n";
    }
    FileUse several{DomainKind::mixed, DomainKind::surface, FileForm::plain};
    several.several = true;
    FileUse copied{DomainKind::cloud, DomainKind::cloud};
    copied.copied = true;
    FileUse lengths{DomainKind::surface, DomainKind::mixed};
    lengths.several = true, lengths.positions = false;
    text += "\nOf several files: " + verdict(support(Reading::filling, several));
    text += "; joining one without positions: " + verdict(support(Reading::joining, lengths));
    text += "; of points that are converted to points: ";
    return text + verdict(support(Reading::filling, copied)) + ".\n";
  }

  std::string build_table() {
    std::string text = "\n## How a domain was built\n" + head(" on triangles ", triangulations);
    text += "| a curve or a triangle as source |";
    for (const auto& t : triangulations)
      text += in_cell(verdict(support(t.value, SourceKind::curve)));
    text += "\n| searches that end early |";
    for (const auto& t : triangulations)
      text += in_cell(verdict(support(Purpose::searches, t.value)));
    // One after another: numbers go in that order.
    text += "\n\n`AnyDomain::keep` after a metric: ";
    text += verdict(support_of_keeping(DomainKind::surface, true, false));
    text += ", behind a mask: " + verdict(support_of_keeping(DomainKind::surface, false, true));
    text += ". Sides::own in solids: " + verdict(support_of_own_sides(DomainKind::solid));
    text += ". Paths, samples and searches from anything but points: ";
    return text + verdict(support_of_sources(Purpose::paths, false)) + ".\n";
  }

  std::string sentences() {
    std::string text = "\n## Sentences\n\n";
    for (std::size_t i = 0; i < order_.size(); ++i)
      text += std::to_string(i + 1) + ". " + Support(order_[i]).sentence() + "\n";
    const std::vector<Refusal> rest = only_together();
    text += "\nAnd where two options do not go with each other, though each is fine alone:\n\n";
    for (const Refusal refusal : rest)
      text += std::string("* ") + Support(refusal).sentence() + "\n";
    return text;
  }

  // Those that no table above has a number for.
  std::vector<Refusal> only_together() {
    std::set<Refusal> rest;
    for (const Row& row : rows)
      for (const auto& e : executors)
        for (const auto& s : sources)
          for (const auto& v : visibilities)
            for (const auto& o : schedules)
              for (const auto& a : accuracies)
                for (const MetricKind m : {usual_metric(row.kind), MetricKind::refracting})
                  for (const bool single : {false, true}) {
                    if (m == MetricKind::refracting && row.kind != DomainKind::surface) continue;
                    const Support found = support({e.value, row.kind, row.dimension, single, m,
                                                   s.value, v.value, o.value, a.value});
                    if (!found && numbers_.count(found.refusal()) == 0)
                      rest.insert(found.refusal());
                  }
    for (const auto& purpose : purposes)
      for (const auto& m : measured)
        for (const auto& v : visibilities)
          for (const auto& e : executors) {
            for (const auto& a : accuracies)
              for (const auto& o : schedules) {
                Combination c = m.value;
                c.visibility = v.value, c.executor = e.value;
                c.accuracy = a.value, c.schedule = o.value;
                const Support found = support(purpose.value, c);
                if (!found && numbers_.count(found.refusal()) == 0) rest.insert(found.refusal());
              }
          }
    return {rest.begin(), rest.end()};
  }

  std::map<Refusal, std::size_t> numbers_;
  std::vector<Refusal> order_;
};

}  // namespace

std::string support_page() { return Page().text(); }

}  // namespace house
