#include "shape/tuning/tuning.hpp"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include <plexway/error.hpp>

#include "io/file_bytes.hpp"

namespace plexway::detail {
namespace {

constexpr const char* probe_kind = "plexway probe table";
constexpr const char* saddle_kind = "plexway saddle thresholds";

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  for (int precision = 1; precision < 17; ++precision) {
    char shorter[32];
    std::snprintf(shorter, sizeof shorter, "%.*g", precision, value);
    if (std::stod(shorter) == value) return shorter;
  }
  return text;
}

Json read_kind(const std::string& file, const char* kind) {
  Json json = read_json(file);
  if (!json.is_object() || !json.contains("kind") || json["kind"] != kind)
    throw InputError(file + ": is no " + std::string(kind + 8) +
                     " of 'plexway tune': \"kind\" is not \"" + kind + "\"");
  return json;
}

double number(const std::string& file, const Json& json, const std::string& name, double low,
              double high) {
  if (!json.is_number()) throw InputError(file + ": " + name + " is missing or not a number");
  const double value = json.get<double>();
  if (!(value >= low && value <= high))
    throw InputError(file + ": " + name + " is " + short_number(value) + ", not from " +
                     short_number(low) + " to " + short_number(high));
  return value;
}

double member(const std::string& file, const Json& json, const char* name, double high) {
  return number(file, json.contains(name) ? json[name] : Json(nullptr), name, 0, high);
}

}  // namespace

Json read_json(const std::string& file) {
  const io::FileBytes bytes(file);
  const std::string_view text = bytes.view();
  try {
    return Json::parse(text);
  } catch (const Json::out_of_range&) {
    throw InputError(file + ": has a number that is too large");
  } catch (const Json::parse_error& error) {
    const std::size_t end = std::min(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(end), '\n');
    throw InputError(file + ":" + std::to_string(line) + ": is not JSON");
  }
}

Json to_json(const ProbeTable& table) {
  return {{"kind", probe_kind},
          {"slender", table.slender},
          {"uneven", table.uneven},
          {"low", table.low},
          {"share", table.share}};
}

Json to_json(const SaddleThresholds& t) {
  return {{"kind", saddle_kind},          {"interior", t.interior},     {"boundary", t.boundary},
          {"noise_share", t.noise_share}, {"most_noise", t.most_noise}, {"agreement", t.agreement}};
}

std::string to_cpp(const ProbeTable& table) {
  std::string text = "constexpr plexway::ProbeTable table = {" + digits(table.slender) + ", " +
                     digits(table.uneven) + ", " + digits(table.low) + ", {";
  for (std::size_t i = 0; i < table.share.size(); ++i)
    text += (i > 0 ? ", " : "") + digits(table.share[i]);
  return text + "}};\n";
}

std::string to_cpp(const SaddleThresholds& t) {
  return "constexpr plexway::SaddleThresholds thresholds = {.interior = " + digits(t.interior) +
         ", .boundary = " + digits(t.boundary) + ", .noise_share = " + digits(t.noise_share) +
         ", .most_noise = " + digits(t.most_noise) + ", .agreement = " + digits(t.agreement) +
         "};\n";
}

ProbeTable read_probe_table(const std::string& file) {
  const Json json = read_kind(file, probe_kind);
  ProbeTable table = {member(file, json, "slender", 1e6),
                      member(file, json, "uneven", 1e6),
                      member(file, json, "low", 1e6),
                      {}};
  if (!json.contains("share") || !json["share"].is_array() || json["share"].size() != 6)
    throw InputError(file + ": share is not an array of 6 numbers");
  for (std::size_t i = 0; i < 6; ++i)
    table.share[i] = number(file, json["share"][i], "share[" + std::to_string(i) + "]", 0, 1.5);
  return table;
}

SaddleThresholds read_saddle_thresholds(const std::string& file) {
  const Json json = read_kind(file, saddle_kind);
  return {member(file, json, "interior", 10), member(file, json, "boundary", 10),
          member(file, json, "noise_share", 100), member(file, json, "most_noise", 10),
          member(file, json, "agreement", 1)};
}

}  // namespace plexway::detail
