// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/pathology_file.hpp"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "arthroscopy/named_grades.hpp"
#include "case_io/detail/regular_file.hpp"
#include "core/error.hpp"
#include "core/json_fields.hpp"

namespace carpus::case_io {
namespace {

using arthroscopy::PathologyTable;

constexpr std::string_view kFormat = "carpus pathology";
constexpr std::array<std::string_view, 2> kOrigins{"chosen", "seed"};
constexpr std::size_t kLargestFile = 16384;

cases::Grades read_grades(JsonFields& fields) {
  cases::Grades grades{};
  const nlohmann::json& named = fields.value("grades");
  if (!named.is_object()) {
    fields.refuse("grades is no object such as {\"scapholunate\": \"III\"}");
  }
  for (const auto& [finding, grade] : named.items()) {
    if (!grade.is_string()) fields.refuse("grades: " + finding + " is no text such as \"III\"");
    const auto set =
        set_grade(grades, PathologyTable::generic(), finding, grade.get_ref<const std::string&>());
    if (!set) fields.refuse("grades: " + set.error());
  }
  return grades;
}

}  // namespace

std::string pathology_text(const cases::PreparedPathology& pathology) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["schema_version"] = cases::kPathologySchemaVersion;
  json["origin"] = kOrigins[pathology.is_drawn ? 1 : 0];
  json["seed"] = pathology.seed;
  json["grades"] = nlohmann::ordered_json::object();
  for (const auto& [finding, grade] :
       arthroscopy::named_grades(pathology.grades, PathologyTable::generic())) {
    json["grades"][finding] = grade;
  }
  return json.dump(1) + "\n";
}

cases::PreparedPathology parse_pathology(const std::string& text, const std::string& file) {
  if (text.size() > kLargestFile) throw InvalidInput(file + ": is larger than any pathology");
  const nlohmann::json json = parse_json_text(text, file);
  JsonFields fields(json, file, "pathology");
  if (fields.text("format") != kFormat) {
    fields.refuse("format is not '" + std::string(kFormat) + "'");
  }
  const double version = fields.number("schema_version", 1, 1e6);
  if (version > cases::kPathologySchemaVersion) {
    throw SchemaError(file + ": schema version " + std::to_string(static_cast<int>(version)) +
                      ", this program knows " + std::to_string(cases::kPathologySchemaVersion) +
                      "; update carpus");
  }
  cases::PreparedPathology pathology;
  pathology.is_drawn = fields.choice("origin", kOrigins) == 1;
  pathology.seed = static_cast<std::uint64_t>(
      fields.number("seed", 0, static_cast<double>(cases::kMostPathologySeed)));
  pathology.grades = read_grades(fields);
  fields.refuse_unknown_fields();
  return pathology;
}

std::optional<cases::PreparedPathology> read_pathology(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kPathologyFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  return parse_pathology(read_whole_file(file, kLargestFile), file.string());
}

}  // namespace carpus::case_io
