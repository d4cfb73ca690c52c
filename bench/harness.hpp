#pragma once

// What every benchmark is made of: a command with options, and a table of named values. The
// libraries behind it are read in harness.cpp alone, which is what keeps benchmarks quick to
// compile.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace bench {

/// A cell of a table: nothing, a number or text.
class Value {
 public:
  Value() = default;
  Value(double number) : value_(number) {}
  Value(std::string text) : value_(std::move(text)) {}
  Value(const char* text) : value_(text) {}
  template <std::integral T>
  Value(T number) : value_(static_cast<std::int64_t>(number)) {}

  [[nodiscard]] bool is_text() const { return std::holds_alternative<std::string>(value_); }
  [[nodiscard]] const std::string& text() const { return std::get<std::string>(value_); }
  /// NaN for what is none.
  [[nodiscard]] double number() const;
  [[nodiscard]] const auto& get() const { return value_; }

 private:
  std::variant<std::monostate, double, std::int64_t, std::string> value_;
};

/// Values by their keys, in the order in which they came.
class Row {
 public:
  using Cell = std::pair<std::string, Value>;
  Row() = default;
  Row(std::initializer_list<Cell> cells) : cells_(cells) {}

  Value& operator[](std::string_view key);
  /// Null where there is none.
  [[nodiscard]] const Value* find(std::string_view key) const;
  Row& update(const Row& more);
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
};

/// Runs `work` in a process of its own and hands back its row, or one with the key `note` that says
/// what happened: the message of an exception, a crash, no end after `limit` seconds. So what
/// crashes or hangs costs one row, and each row starts with the same heap.
Row isolated(double limit, const std::function<Row()>& work);

/// Rows, printed as Markdown for people or as JSON for programs.
class Table {
 public:
  /// What to show: "key: header %format", separated by semicolons; a key alone is its header, and
  /// rows may have more.
  explicit Table(std::string_view columns);

  void add(Row row) { rows_.push_back(std::move(row)); }
  /// A row made by `isolated`, after `head`, which goes to stderr before.
  Row& measure(Row head, double limit, const std::function<Row()>& work);
  [[nodiscard]] std::vector<Row>& rows() { return rows_; }

  [[nodiscard]] std::string markdown() const;
  [[nodiscard]] std::string json() const;

 private:
  struct Column {
    std::string key, header, format;
  };
  std::vector<Column> columns_;
  std::vector<Row> rows_;
};

/// Ends a command with this code and a line on stderr.
struct Exit : std::runtime_error {
  Exit(int exit_code, const std::string& message) : std::runtime_error(message), code(exit_code) {}
  int code;
};

/// The options of a command. Each is bound to a variable, which holds the default; they are read
/// when the table is asked for, or by `parse`.
class Arguments {
 public:
  using Variable =
      std::variant<int*, unsigned*, std::size_t*, double*, std::string*, std::vector<int>*,
                   std::vector<unsigned>*, std::vector<std::size_t>*, std::vector<double>*,
                   std::vector<std::string>*>;
  Arguments(const std::string& program, const std::string& about, std::vector<std::string> words);
  ~Arguments();

  void option(const std::string& name, bool* flag, const std::string& about);
  /// Lists of numbers may have commas; `none` is an empty list. A name without dashes is
  /// positional.
  void option(const std::string& name, Variable variable, const std::string& about,
              const std::vector<std::string>& choices = {});
  void required(const std::string& name, Variable variable, const std::string& about);
  /// A list with commas.
  void names(const std::string& name, std::vector<std::string>* names, const std::string& about);
  /// A number above 0.
  void positive(const std::string& name, Variable variable, const std::string& about);
  /// For rows in processes of their own; `limit` has what was given.
  void add_limit(double usual = 600);
  double limit = 0;

  void parse();
  Table& table(std::string_view columns);
  /// What main prints when the command has run.
  [[nodiscard]] int print() const;

 private:
  struct Hidden;
  std::unique_ptr<Hidden> hidden_;
};

/// A command of the program that its file is linked into, by a variable at namespace scope.
struct Command {
  Command(const char* name, const char* about, void (*run)(Arguments&));
  const char *name, *about;
  void (*run)(Arguments&);
};

}  // namespace bench
