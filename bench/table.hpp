#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace bench {

/// Rows of named values, printed as Markdown for people or as JSON for programs.
class Table {
 public:
  struct Column {
    std::string key;     ///< in rows and in JSON
    std::string header;  ///< in Markdown
    const char* format = "%.3g";
  };

  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  /// A JSON object; keys that it lacks, or that are null, stay empty.
  void add(nlohmann::ordered_json row) { rows_.push_back(std::move(row)); }

  void write_markdown(std::ostream& out) const {
    std::vector<std::vector<std::string>> lines(1);
    for (const Column& column : columns_) lines[0].push_back(column.header);
    lines.emplace_back();
    for (const Column& column : columns_) lines[1].push_back(is_text(column) ? "---" : "---:");
    for (const auto& row : rows_) {
      lines.emplace_back();
      for (const Column& column : columns_) lines.back().push_back(cell(row, column));
    }
    for (const auto& line : lines) {
      out << '|';
      for (std::size_t i = 0; i < line.size(); ++i) out << ' ' << line[i] << " |";
      out << '\n';
    }
    out.flush();
  }

  void write_json(std::ostream& out) const { out << rows_.dump(2) << std::endl; }

 private:
  [[nodiscard]] bool is_text(const Column& column) const {
    for (const auto& row : rows_)
      if (row.contains(column.key) && row[column.key].is_string()) return true;
    return false;
  }

  static std::string cell(const nlohmann::ordered_json& row, const Column& column) {
    const auto found = row.find(column.key);
    if (found == row.end() || found->is_null()) return "";
    if (found->is_string()) return found->get<std::string>();
    if (found->is_number_integer()) return found->dump();
    const int size = std::snprintf(nullptr, 0, column.format, found->get<double>());
    std::string text(static_cast<std::size_t>(size), ' ');
    std::snprintf(text.data(), text.size() + 1, column.format, found->get<double>());
    return text;
  }

  std::vector<Column> columns_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

/// Where a table goes.
struct Report {
  bool json = false;
  std::string markdown;

  void add_options(CLI::App& app) {
    app.add_flag("--json", json, "JSON on stdout instead of Markdown");
    app.add_option("--markdown", markdown, "Write the Markdown to this file as well");
  }

  /// Fills the table and writes it, or says on stderr in one line what was in the way. Returns the
  /// program's exit code.
  template <class Fill>
  int write(const Table& table, const Fill& fill) const try {
    fill();
    json ? table.write_json(std::cout) : table.write_markdown(std::cout);
    if (markdown.empty()) return 0;
    std::ofstream file(markdown);
    table.write_markdown(file);
    if (!file) throw std::runtime_error(markdown + ": cannot be written");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
};

}  // namespace bench
