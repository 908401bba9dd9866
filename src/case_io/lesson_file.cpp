// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/lesson_file.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "case_io/detail/regular_file.hpp"
#include "core/error.hpp"
#include "core/json_fields.hpp"

namespace carpus::case_io {
namespace {

using cases::Lesson;
using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "carpus lesson";
constexpr std::array<std::string_view, 3> kSizes{"small", "average", "large"};
constexpr std::size_t kLongestTitle = 128;
constexpr std::size_t kLongestText = 1024;
constexpr std::size_t kLargestFile = 16384;
constexpr std::size_t kMostReasons = 8;
constexpr std::size_t kLongestReason = 32;
constexpr double kFarMm = 1000;
constexpr double kMostSeed = 9007199254740991.0;

std::string short_text(JsonFields& fields, const std::string& field, std::size_t longest) {
  std::string text = fields.text(field);
  if (text.size() > longest) {
    fields.refuse(field + " has more than " + std::to_string(longest) + " bytes");
  }
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20) fields.refuse(field + " has control characters");
  }
  return text;
}

cases::Difficulty read_difficulty(JsonFields fields) {
  cases::Difficulty d;
  d.corridor_clearance_mm = fields.number("corridor_clearance_mm", -kFarMm, kFarMm);
  d.corridor_length_mm = fields.number("corridor_length_mm", 0, kFarMm);
  d.smaller_part_mm = fields.number("smaller_part_mm", 0, kFarMm);
  d.gap_mm = fields.number("gap_mm", 0, kFarMm);
  d.step_mm = fields.number("step_mm", 0, kFarMm);
  d.flexion_deg = fields.number("flexion_deg", -180, 180);
  d.overall = fields.number("overall", 0, 100);
  fields.refuse_unknown_fields();
  return d;
}

cases::ExpertProof read_expert(JsonFields fields) {
  cases::ExpertProof proof;
  proof.procedure = short_text(fields, "procedure", 64);
  proof.seed = static_cast<std::uint64_t>(fields.number("seed", 0, kMostSeed));
  if (!fields.has("is_acceptable")) fields.refuse("is_acceptable is missing");
  proof.is_acceptable = fields.boolean_or("is_acceptable", false);
  proof.overall = fields.number("overall", 0, 100);
  fields.refuse_unknown_fields();
  return proof;
}

std::vector<std::string> read_decline_for(JsonFields& fields, cases::RightAnswer answer) {
  std::vector<std::string> reasons = fields.texts_or_none("decline_for");
  if (!reasons.empty() && answer != cases::RightAnswer::Decline) {
    fields.refuse("decline_for stands beside an answer that is not to decline");
  }
  if (reasons.size() > kMostReasons) fields.refuse("decline_for has too many reasons");
  for (const std::string& reason : reasons) {
    const bool is_plain = !reason.empty() && reason.size() <= kLongestReason &&
                          std::all_of(reason.begin(), reason.end(),
                                      [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; });
    if (!is_plain) fields.refuse("decline_for has '" + reason + "', which is not of a-z and _");
  }
  return reasons;
}

}  // namespace

std::string lesson_text(const Lesson& lesson) {
  const cases::Difficulty& d = lesson.difficulty;
  Json json;
  json["format"] = kFormat;
  json["schema_version"] = cases::kLessonSchemaVersion;
  json["title"] = lesson.title;
  if (!lesson.history.empty()) json["history"] = lesson.history;
  json["goal"] = lesson.goal;
  json["size"] = lesson.size;
  json["right_answer"] = name_of(lesson.right_answer);
  json["reason"] = lesson.reason;
  if (!lesson.decline_for.empty()) json["decline_for"] = lesson.decline_for;
  json["difficulty"] = {{"corridor_clearance_mm", d.corridor_clearance_mm},
                        {"corridor_length_mm", d.corridor_length_mm},
                        {"smaller_part_mm", d.smaller_part_mm},
                        {"gap_mm", d.gap_mm},
                        {"step_mm", d.step_mm},
                        {"flexion_deg", d.flexion_deg},
                        {"overall", d.overall}};
  if (lesson.expert) {
    json["expert"] = {{"procedure", lesson.expert->procedure},
                      {"seed", lesson.expert->seed},
                      {"is_acceptable", lesson.expert->is_acceptable},
                      {"overall", lesson.expert->overall}};
  }
  return json.dump(1) + "\n";
}

Lesson parse_lesson(const std::string& text, const std::string& file) {
  if (text.size() > kLargestFile) throw InvalidInput(file + ": is larger than any lesson");
  const nlohmann::json json = parse_json_text(text, file);
  JsonFields fields(json, file, "lesson");
  if (fields.text("format") != kFormat)
    fields.refuse("format is not '" + std::string(kFormat) + "'");
  const double version = fields.number("schema_version", 1, 1e6);
  if (version > cases::kLessonSchemaVersion) {
    throw SchemaError(file + ": schema version " + std::to_string(static_cast<int>(version)) +
                      ", this program knows " + std::to_string(cases::kLessonSchemaVersion) +
                      "; update carpus");
  }
  Lesson lesson;
  lesson.title = short_text(fields, "title", kLongestTitle);
  // Files of version 1 have neither this nor decline_for.
  if (fields.has("history")) lesson.history = short_text(fields, "history", kLongestText);
  lesson.goal = short_text(fields, "goal", kLongestText);
  lesson.size = kSizes[fields.choice("size", kSizes)];
  lesson.right_answer =
      static_cast<cases::RightAnswer>(fields.choice("right_answer", cases::kRightAnswers));
  lesson.reason = short_text(fields, "reason", kLongestText);
  lesson.decline_for = read_decline_for(fields, lesson.right_answer);
  lesson.difficulty = read_difficulty(fields.object("difficulty"));
  if (fields.has("expert")) lesson.expert = read_expert(fields.object("expert"));
  fields.refuse_unknown_fields();
  return lesson;
}

std::optional<Lesson> read_lesson(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / kLessonFile;
  if (!std::filesystem::exists(file)) return std::nullopt;
  return parse_lesson(read_whole_file(file, kLargestFile), file.string());
}

}  // namespace carpus::case_io
