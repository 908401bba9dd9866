// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Reads data that people write, field by field, so that every mistake is told by file, place and
// field: missing, of another kind, out of its range, or not known at all.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace carpus {

/// The value of a JSON text.
/// @param file  names it in errors.
/// @throws InvalidInput "screws.json: line 3, column 7: …" where it is no JSON.
[[nodiscard]] nlohmann::json parse_json_text(std::string_view text, std::string_view file);

/// One object of such a text. All getters throw InvalidInput "FILE: PLACE: FIELD …".
class JsonFields {
 public:
  /// @param value  must outlive this.
  /// @param place  where it stands, without a last colon: "guide_wire: feed".
  /// @throws InvalidInput when it is no object.
  JsonFields(const nlohmann::json& value, std::string file, std::string place);

  [[nodiscard]] bool has(const std::string& field) const;
  /// Finite and within [low, high].
  [[nodiscard]] double number(const std::string& field, double low, double high);
  [[nodiscard]] double number_or(const std::string& field, double low, double high, double absent);
  /// Of an object {"value": …, "mark": …}: a figure and where it comes from, which must be said.
  [[nodiscard]] double marked_number(const std::string& field, double low, double high);
  /// Not empty.
  [[nodiscard]] std::string text(const std::string& field);
  [[nodiscard]] std::string text_or(const std::string& field, std::string_view absent);
  [[nodiscard]] bool boolean_or(const std::string& field, bool absent);
  /// Place of the field's word in `words`.
  [[nodiscard]] std::size_t choice(const std::string& field,
                                   std::span<const std::string_view> words);
  [[nodiscard]] std::vector<std::string> texts_or_none(const std::string& field);
  /// As many numbers as asked for, each within [low, high].
  [[nodiscard]] std::vector<double> numbers(const std::string& field,
                                            std::size_t count,
                                            double low,
                                            double high);
  /// Objects of a list, each with its place "steps[3]".
  [[nodiscard]] std::vector<JsonFields> objects(const std::string& field);
  [[nodiscard]] JsonFields object(const std::string& field);
  /// Its value, to be read by the caller.
  [[nodiscard]] const nlohmann::json& value(const std::string& field);

  /// Refuses fields that nobody asked for: a misspelt optional one would go unnoticed.
  void refuse_unknown_fields() const;

  /// @throws InvalidInput always: "FILE: PLACE: problem".
  [[noreturn]] void refuse(const std::string& problem) const;
  void set_place(std::string place) { place_ = std::move(place); }
  [[nodiscard]] const std::string& place() const noexcept { return place_; }

 private:
  const nlohmann::json* value_;
  std::string file_;
  std::string place_;
  std::set<std::string> asked_;
};

}  // namespace carpus
