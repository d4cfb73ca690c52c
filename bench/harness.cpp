#include "harness.hpp"

#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

namespace bench {

// ---- Rows ----

double Value::number() const {
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value_);
  return real != nullptr ? *real : std::numeric_limits<double>::quiet_NaN();
}

Value& Row::operator[](std::string_view key) {
  for (Cell& cell : cells_)
    if (cell.first == key) return cell.second;
  return cells_.emplace_back(key, Value()).second;
}
const Value* Row::find(std::string_view key) const {
  for (const Cell& cell : cells_)
    if (cell.first == key) return &cell.second;
  return nullptr;
}
Row& Row::update(const Row& more) {
  for (const Cell& cell : more.cells_) (*this)[cell.first] = cell.second;
  return *this;
}

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Row& row) {
  Json json = Json::object();
  for (const auto& cell : row.cells())
    std::visit(
        [&](const auto& value) {
          if constexpr (!std::is_same_v<decltype(value), const std::monostate&>)
            json[cell.first] = value;
        },
        cell.second.get());
  return json;
}

Row row_of(const Json& json) {
  Row row;
  for (const auto& [key, value] : json.items())
    if (value.is_string())
      row[key] = value.get<std::string>();
    else if (value.is_number_integer())
      row[key] = value.get<std::int64_t>();
    else if (value.is_number())
      row[key] = value.get<double>();
  return row;
}

/// In the child: works, writes the row as JSON, and is gone.
[[noreturn]] void work_for(int out, const std::function<Row()>& work) {
  Row row;
  try {
    row = work();
  } catch (const std::exception& error) {
    std::string message = error.what();
    std::replace(message.begin(), message.end(), '\n', ' ');
    row = {{"note", "refused: " + message}};
  }
  const std::string text = json_of(row).dump();
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t n = write(out, text.data() + sent, text.size() - sent);
    if (n < 0) _exit(1);
    sent += static_cast<std::size_t>(n);
  }
  _exit(0);
}

}  // namespace

Row isolated(double limit, const std::function<Row()>& work) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    work_for(ends[1], work);
  }
  close(ends[1]);
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                      std::chrono::duration<double>(limit));
  std::string text;
  std::array<char, 4096> buffer{};
  bool late = false;
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    late = left <= 0;
    if (late) break;
    pollfd waiting{ends[0], POLLIN, 0};
    const int ready = poll(&waiting, 1, static_cast<int>(std::min<long long>(left, 1000)));
    if (ready < 0 && errno != EINTR) break;
    if (ready <= 0) continue;
    const ssize_t n = read(ends[0], buffer.data(), buffer.size());
    if (n <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  close(ends[0]);
  if (late) kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  if (late) return {{"note", "stopped after " + std::to_string(static_cast<int>(limit)) + " s"}};
  if (WIFSIGNALED(status))
    return {{"note", std::string("crashed: ") + strsignal(WTERMSIG(status))}};
  const Json result = Json::parse(text, nullptr, false);
  if (result.is_discarded()) return {{"note", "ended without an answer"}};
  return row_of(result);
}

// ---- Tables ----

namespace {

std::string written(const std::string& text) { return text; }
template <class Number>
std::string written(Number number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(number));
  return text.data();
}

}  // namespace

Table::Table(std::string_view columns) {
  const auto trimmed = [](std::string_view text) {
    const auto first = text.find_first_not_of(" \n");
    return first == text.npos
               ? std::string()
               : std::string(text.substr(first, text.find_last_not_of(" \n") - first + 1));
  };
  while (!columns.empty()) {
    const std::size_t end = std::min(columns.find(';'), columns.size());
    std::string_view one = columns.substr(0, end);
    columns.remove_prefix(std::min(end + 1, columns.size()));
    Column column{"", "", "%.3g"};
    if (const auto sign = one.rfind('%');
        sign != one.npos && one.find_first_of("efg", sign) != one.npos) {
      column.format = trimmed(one.substr(sign));
      one = one.substr(0, sign);
    }
    const auto colon = one.find(':');
    column.key = trimmed(one.substr(0, colon));
    column.header = colon == one.npos ? column.key : trimmed(one.substr(colon + 1));
    columns_.push_back(std::move(column));
  }
}

Row& Table::measure(Row head, double limit, const std::function<Row()>& work) {
  std::string name;
  for (const auto& [key, value] : head.cells())
    name += (name.empty() ? "" : ", ") +
            (value.is_text() ? value.text() : key + ' ' + written(value.number()));
  if (!name.empty()) std::cerr << name << std::endl;
  rows_.push_back(std::move(head.update(isolated(limit, work))));
  return rows_.back();
}

std::string Table::markdown() const {
  std::string text;
  const auto line = [&](const auto& cell_of) {
    text += '|';
    for (const Column& column : columns_) text += ' ' + cell_of(column) + " |";
    text += '\n';
  };
  line([](const Column& column) { return column.header; });
  line([&](const Column& column) {
    return std::string(std::any_of(rows_.begin(), rows_.end(),
                                   [&](const Row& row) {
                                     const Value* value = row.find(column.key);
                                     return value != nullptr && value->is_text();
                                   })
                           ? "---"
                           : "---:");
  });
  for (const Row& row : rows_)
    line([&](const Column& column) {
      const Value* value = row.find(column.key);
      if (value == nullptr || value->get().index() == 0) return std::string();
      if (value->is_text()) return value->text();
      if (const auto* whole = std::get_if<std::int64_t>(&value->get()))
        return std::to_string(*whole);
      std::array<char, 64> number{};
      std::snprintf(number.data(), number.size(), column.format.c_str(), value->number());
      return std::string(number.data());
    });
  return text;
}

std::string Table::json() const {
  Json all = Json::array();
  for (const Row& row : rows_) all.push_back(json_of(row));
  return all.dump(2) + '\n';
}

// ---- Arguments ----

struct Arguments::Hidden {
  CLI::App app;
  std::vector<std::string> words;
  bool json = false;
  std::string markdown;
  std::unique_ptr<Table> table;
};

Arguments::Arguments(const std::string& program, const std::string& about,
                     std::vector<std::string> words)
    : hidden_(std::make_unique<Hidden>()) {
  hidden_->app.description(about);
  hidden_->app.name(program);
  hidden_->words = std::move(words);
}
Arguments::~Arguments() = default;

namespace {

bool read(const std::string& word, std::string& to) { return to = word, true; }
template <class Number>
bool read(const std::string& word, Number& to) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), to);
  return error == std::errc() && end == word.data() + word.size();
}
/// CLI11's own conversions, for every type, would take half of the time that this file needs.
CLI::Option* add(CLI::App& app, const std::string& name, Arguments::Variable variable,
                 const std::string& about) {
  const bool named = name[0] == '-';
  return std::visit(
      [&](auto* to) {
        using T = std::remove_pointer_t<decltype(to)>;
        if constexpr (requires { to->emplace_back(); }) {
          CLI::Option* option = app.add_option(
              name,
              [to](const CLI::results_t& words) {
                to->clear();
                for (const std::string& word : words)
                  if (word != "none" && !read(word, to->emplace_back())) return false;
                return true;
              },
              about);
          option->type_size(1)->expected(1, -1)->allow_extra_args();
          std::string usual;
          for (const auto& one : *to) usual += (usual.empty() ? "" : ",") + written(one);
          if constexpr (!std::is_same_v<T, std::vector<std::string>>) option->delimiter(',');
          if (!usual.empty()) option->default_str(usual);
          return option;
        } else {
          CLI::Option* option = app.add_option(
              name, [to](const CLI::results_t& words) { return read(words.back(), *to); }, about);
          option->type_size(1)->expected(1);
          if (named) option->default_str(written(*to));
          return option;
        }
      },
      variable);
}

}  // namespace

void Arguments::option(const std::string& name, bool* flag, const std::string& about) {
  hidden_->app.add_flag(name, *flag, about);
}
void Arguments::option(const std::string& name, Variable variable, const std::string& about,
                       const std::vector<std::string>& choices) {
  CLI::Option* option = add(hidden_->app, name, variable, about);
  if (!choices.empty()) option->check(CLI::IsMember(choices));
}
void Arguments::required(const std::string& name, Variable variable, const std::string& about) {
  add(hidden_->app, name, variable, about)->required();
}
void Arguments::names(const std::string& name, std::vector<std::string>* names,
                      const std::string& about) {
  add(hidden_->app, name, names, about)->delimiter(',');
}
void Arguments::positive(const std::string& name, Variable variable, const std::string& about) {
  add(hidden_->app, name, variable, about)->check(CLI::PositiveNumber);
}
void Arguments::add_limit(double usual) {
  limit = usual;
  positive("--limit", &limit, "Seconds after which a row is given up");
}

void Arguments::parse() {
  std::vector<std::string> backwards(hidden_->words.rbegin(), hidden_->words.rend());
  try {
    hidden_->app.parse(std::move(backwards));
  } catch (const CLI::ParseError& error) {
    throw Exit(hidden_->app.exit(error) == 0 ? 0 : 2, "");
  }
}

Table& Arguments::table(std::string_view columns) {
  hidden_->app.add_flag("--json", hidden_->json, "JSON on stdout instead of Markdown");
  hidden_->app.add_option("--markdown", hidden_->markdown,
                          "Write the Markdown to this file as well");
  parse();
  hidden_->table = std::make_unique<Table>(columns);
  return *hidden_->table;
}

int Arguments::print() const {
  if (!hidden_->table) return 0;
  std::cout << (hidden_->json ? hidden_->table->json() : hidden_->table->markdown()) << std::flush;
  if (hidden_->markdown.empty()) return 0;
  std::ofstream file(hidden_->markdown);
  file << hidden_->table->markdown();
  file.close();
  if (!file) throw std::runtime_error(hidden_->markdown + ": cannot be written");
  return 0;
}

// ---- Commands ----

namespace {

std::vector<const Command*>& commands() {
  static std::vector<const Command*> all;
  return all;
}

int list(const std::string& program, bool asked) {
  std::FILE* to = asked ? stdout : stderr;
  std::fprintf(to, "usage: %s COMMAND [options]; COMMAND --help lists the options\n",
               program.c_str());
  for (const Command* command : commands())
    std::fprintf(to, "  %-18s %s\n", command->name, command->about);
  return asked ? 0 : 2;
}

}  // namespace

Command::Command(const char* called, const char* says, void (*runs)(Arguments&))
    : name(called), about(says), run(runs) {
  commands().push_back(this);
}

}  // namespace bench

int main(int argc, char** argv) {
  auto& commands = bench::commands();
  std::sort(commands.begin(), commands.end(),
            [](const auto* a, const auto* b) { return std::string_view(a->name) < b->name; });
  const std::string program = std::filesystem::path(argv[0]).filename().string();
  const std::string name = argc > 1 ? argv[1] : "";
  for (const bench::Command* command : commands) {
    if (name != command->name) continue;
    try {
      bench::Arguments arguments(program + ' ' + name, command->about, {argv + 2, argv + argc});
      command->run(arguments);
      return arguments.print();
    } catch (const bench::Exit& end) {
      if (*end.what() != '\0') std::cerr << program << ' ' << name << ": " << end.what() << '\n';
      return end.code;
    } catch (const std::exception& error) {
      std::cerr << program << ' ' << name << ": " << error.what() << '\n';
      return 1;
    }
  }
  const bool asked = name == "--help" || name == "-h";
  if (!asked && !name.empty()) std::cerr << program << ": no command is called " << name << '\n';
  return bench::list(program, asked);
}
