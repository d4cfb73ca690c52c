#include "tool/report/distance_output.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <string>

#include "tool/report/console.hpp"

namespace plexway::cli {
namespace {

template <class Number>
void append(std::string& text, Number value) {
  char digits[32];
  const auto result = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, result.ptr);
}

}  // namespace

void add_output(CLI::App& command, const std::string& name, std::string& out,
                const std::string& help, const char* usual) {
  const std::string on_output = std::string(usual) + ":-";
  command.add_option(name, out, help)
      ->type_name("FILE")
      ->transform(
          [on_output](const std::string& given) { return given == "-" ? on_output : given; });
}

void print_report(const Json& json, const Table& table, bool as_json, bool quiet,
                  std::initializer_list<std::string> files) {
  std::string text;
  if (as_json)
    text = json_text(json);
  else if (!quiet)
    text = table.text();
  if (std::any_of(files.begin(), files.end(), io::on_standard_output))
    write_diagnostics(text);
  else
    write_output(text);
  flush_output();
}

void write_distance_csv(std::span<const double> distance, std::span<const std::int32_t> label,
                        std::span<const std::uint32_t> original, std::span<const double> error) {
  std::string text = "vertex,distance";
  if (!label.empty()) text += ",label";
  if (!original.empty()) text += ",original";
  if (!error.empty()) text += ",error";
  text += '\n';
  for (std::size_t v = 0; v < distance.size(); ++v) {
    append(text, v);
    text += ',';
    append(text, distance[v]);
    if (!label.empty()) {
      text += ',';
      append(text, label[v]);
    }
    if (!original.empty()) {
      text += ',';
      append(text, original[v]);
    }
    if (!error.empty()) {
      text += ',';
      append(text, error[v]);
    }
    text += '\n';
    if (text.size() < (std::size_t{1} << 16)) continue;
    write_output(text);
    text.clear();
  }
  write_output(text);
  flush_output();
}

}  // namespace plexway::cli
