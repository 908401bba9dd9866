// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "core/json_fields.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/error.hpp"

namespace carpus {
namespace {

std::string short_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%g", value);
  return text.data();
}

}  // namespace

nlohmann::json parse_json_text(std::string_view text, std::string_view file) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& problem) {
    throw InvalidInput(std::string(file) + ": " + problem.what());
  }
}

JsonFields::JsonFields(const nlohmann::json& value, std::string file, std::string place)
    : value_(&value), file_(std::move(file)), place_(std::move(place)) {
  if (!value.is_object()) refuse("is no object");
}

void JsonFields::refuse(const std::string& problem) const {
  throw InvalidInput(file_ + ": " + (place_.empty() ? "" : place_ + ": ") + problem);
}

bool JsonFields::has(const std::string& field) const { return value_->contains(field); }

const nlohmann::json& JsonFields::value(const std::string& field) {
  asked_.insert(field);
  const auto found = value_->find(field);
  if (found == value_->end()) refuse(field + " is missing");
  return *found;
}

double JsonFields::number(const std::string& field, double low, double high) {
  const nlohmann::json& found = value(field);
  if (!found.is_number()) refuse(field + " is no number");
  const auto number = found.get<double>();
  if (!std::isfinite(number)) refuse(field + " is not finite");
  if (!(number >= low && number <= high)) {
    refuse(field + " is " + short_text(number) + ", must be " + short_text(low) + " to " +
           short_text(high));
  }
  return number;
}

double JsonFields::number_or(const std::string& field, double low, double high, double absent) {
  return has(field) ? number(field, low, high) : absent;
}

double JsonFields::marked_number(const std::string& field, double low, double high) {
  JsonFields entry = object(field);
  const double value = entry.number("value", low, high);
  (void)entry.text("mark");
  entry.refuse_unknown_fields();
  return value;
}

std::string JsonFields::text(const std::string& field) {
  const nlohmann::json& found = value(field);
  if (!found.is_string()) refuse(field + " is no text");
  std::string text = found.get<std::string>();
  if (text.empty()) refuse(field + " is empty");
  return text;
}

std::string JsonFields::text_or(const std::string& field, std::string_view absent) {
  return has(field) ? text(field) : std::string(absent);
}

bool JsonFields::boolean_or(const std::string& field, bool absent) {
  if (!has(field)) return absent;
  const nlohmann::json& found = value(field);
  if (!found.is_boolean()) refuse(field + " is neither true nor false");
  return found.get<bool>();
}

std::size_t JsonFields::choice(const std::string& field, std::span<const std::string_view> words) {
  const std::string word = text(field);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  std::string known;
  for (const std::string_view each : words)
    known += (known.empty() ? "" : ", ") + std::string(each);
  refuse(field + " is '" + word + "', must be one of " + known);
}

std::vector<std::string> JsonFields::texts_or_none(const std::string& field) {
  std::vector<std::string> texts;
  if (!has(field)) return texts;
  const nlohmann::json& list = value(field);
  if (!list.is_array()) refuse(field + " is no list");
  for (const nlohmann::json& each : list) {
    if (!each.is_string()) refuse(field + "[" + std::to_string(texts.size()) + "] is no text");
    texts.push_back(each.get<std::string>());
  }
  return texts;
}

std::vector<double> JsonFields::numbers(const std::string& field,
                                        std::size_t count,
                                        double low,
                                        double high) {
  const nlohmann::json& list = value(field);
  if (!list.is_array() || list.size() != count) {
    refuse(field + " is no list of " + std::to_string(count) + " numbers");
  }
  std::vector<double> numbers;
  for (const nlohmann::json& each : list) {
    const double number = each.is_number() ? each.get<double>() : std::nan("");
    if (!(number >= low && number <= high)) {
      refuse(field + "[" + std::to_string(numbers.size()) + "] must be a number from " +
             short_text(low) + " to " + short_text(high));
    }
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<JsonFields> JsonFields::objects(const std::string& field) {
  const nlohmann::json& list = value(field);
  if (!list.is_array()) refuse(field + " is no list");
  std::vector<JsonFields> objects;
  const std::string head = place_.empty() ? field : place_ + ": " + field;
  for (const nlohmann::json& each : list) {
    objects.emplace_back(each, file_, head + "[" + std::to_string(objects.size()) + "]");
  }
  return objects;
}

JsonFields JsonFields::object(const std::string& field) {
  return {value(field), file_, place_.empty() ? field : place_ + ": " + field};
}

void JsonFields::refuse_unknown_fields() const {
  for (const auto& [field, unused] : value_->items()) {
    if (!asked_.contains(field)) refuse("there is no field '" + field + "'");
  }
}

}  // namespace carpus
