// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/trust_file.hpp"

#include <nlohmann/json.hpp>

#include "anatomy/bone_id.hpp"
#include "case_io/detail/regular_file.hpp"
#include "core/error.hpp"
#include "core/json_fields.hpp"

namespace carpus::case_io {
namespace {

constexpr std::string_view kFormat = "carpus bone trust";
constexpr std::size_t kLargestFile = 65536;
constexpr std::size_t kLongestWhy = 2048;
constexpr std::size_t kMostOfScan = 16;

}  // namespace

std::string trust_text(const Trust& trust, const std::string& made_by) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["schema_version"] = kTrustSchemaVersion;
  json["made_by"] = made_by;
  if (!trust.of_scan.empty()) json["of_scan"] = trust.of_scan;
  json["bones"] = nlohmann::ordered_json::array();
  for (const TrustLine& line : trust.bones) {
    json["bones"].push_back(
        {{"name", line.name}, {"confidence", line.confidence}, {"flagged", line.flagged}});
    if (!line.why.empty()) json["bones"].back()["why"] = line.why;
  }
  return json.dump(1) + "\n";
}

Trust parse_trust(const std::string& text, const std::string& file) {
  if (text.size() > kLargestFile) throw InvalidInput(file + ": is larger than any such file");
  const nlohmann::json json = parse_json_text(text, file);
  JsonFields fields(json, file, "trust");
  if (fields.text("format") != kFormat) {
    fields.refuse("format is not '" + std::string(kFormat) + "'");
  }
  const double version = fields.number("schema_version", 1, 1e6);
  if (version > kTrustSchemaVersion) {
    throw SchemaError(file + ": schema version " + std::to_string(static_cast<int>(version)) +
                      ", this program knows " + std::to_string(kTrustSchemaVersion) +
                      "; update carpus");
  }
  (void)fields.text_or("made_by", "");
  Trust trust;
  trust.of_scan = fields.texts_or_none("of_scan");
  if (trust.of_scan.size() > kMostOfScan) fields.refuse("of_scan has too many texts");
  for (const std::string& words : trust.of_scan) {
    if (words.empty() || words.size() > kLongestWhy) fields.refuse("of_scan is empty or too long");
  }
  for (JsonFields& bone : fields.objects("bones")) {
    TrustLine line;
    line.name = bone.text("name");
    if (!bone_of(line.name)) bone.refuse("there is no bone '" + line.name + "'");
    line.confidence = bone.number("confidence", 0, 1);
    line.flagged = bone.boolean_or("flagged", false);
    line.why = bone.text_or("why", "");
    if (line.why.size() > kLongestWhy) bone.refuse("why is too long");
    bone.refuse_unknown_fields();
    trust.bones.push_back(std::move(line));
  }
  fields.refuse_unknown_fields();
  return trust;
}

std::optional<Trust> read_trust(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kTrustFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  return parse_trust(read_whole_file(file, kLargestFile), file.string());
}

}  // namespace carpus::case_io
