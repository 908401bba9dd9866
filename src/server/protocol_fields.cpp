// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/protocol_fields.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/protocol_messages.hpp"

namespace carpus::server::protocol {

namespace {

using Json = nlohmann::json;

/// Whether arrays and objects nest deeper than allowed; looked at before parsing.
bool is_too_deep(std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

/// Valid UTF-8 is certain: the parser refuses anything else.
bool is_text(const Json& value, std::size_t max_length) {
  if (!value.is_string()) return false;
  std::size_t code_points = 0;
  for (const char c : value.get_ref<const std::string&>()) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F) return false;
    if ((byte & 0xC0U) != 0x80U) ++code_points;
  }
  return code_points <= max_length;
}

bool is_within(const Json& value, double low, double high) {
  if (!value.is_number()) return false;
  const double number = value.get<double>();
  return number >= low && number <= high;
}

std::string range(double low, double high) {
  return "from " + Json(low).dump() + " to " + Json(high).dump();
}

}  // namespace

struct FieldReader::Document {
  Json root;
  std::vector<std::string_view> known;  ///< fields that were asked for
  std::optional<std::string> failure;

  void fail(std::string reason) {
    if (!failure) failure = std::move(reason);
  }
  /// The field's value, or nullptr where something has failed already or it is missing.
  const Json* field(const char* key) {
    if (failure) return nullptr;
    known.emplace_back(key);
    const auto it = root.find(key);
    if (it != root.end()) return &*it;
    fail("field '" + std::string(key) + "' is missing");
    return nullptr;
  }
};

FieldReader::FieldReader(std::string_view text, std::size_t max_bytes)
    : document_(std::make_unique<Document>()) {
  if (max_bytes != 0 && text.size() > max_bytes) {
    fail("longer than " + std::to_string(max_bytes) + " bytes");
  } else if (is_too_deep(text)) {
    fail("nested too deeply");
  } else {
    document_->root = Json::parse(text, nullptr, false);
    if (document_->root.is_discarded()) {
      fail("not valid JSON");
    } else if (!document_->root.is_object()) {
      fail("not a JSON object");
    }
  }
}

FieldReader::~FieldReader() = default;

void FieldReader::fail(std::string reason) { document_->fail(std::move(reason)); }
bool FieldReader::ok() const noexcept { return !document_->failure; }
const std::optional<std::string>& FieldReader::failure() const noexcept {
  return document_->failure;
}

std::string FieldReader::type() {
  const Json* value = document_->field("type");
  if (value == nullptr) return {};
  if (is_text(*value, 64)) return value->get<std::string>();
  fail("field 'type' must be a string");
  return {};
}

double FieldReader::number(const char* key, double low, double high) {
  const Json* value = document_->field(key);
  if (value == nullptr) return 0.0;
  if (is_within(*value, low, high)) return value->get<double>();
  fail("field '" + std::string(key) + "' must be a number " + range(low, high));
  return 0.0;
}

std::int64_t FieldReader::integer(const char* key, std::int64_t low, std::int64_t high) {
  const Json* value = document_->field(key);
  if (value == nullptr) return 0;
  const auto low_number = static_cast<double>(low);
  const auto high_number = static_cast<double>(high);
  if (is_within(*value, low_number, high_number)) {
    const double number = value->get<double>();
    if (number == std::floor(number)) return static_cast<std::int64_t>(number);
  }
  fail("field '" + std::string(key) + "' must be an integer from " + std::to_string(low) + " to " +
       std::to_string(high));
  return 0;
}

bool FieldReader::boolean(const char* key) {
  const Json* value = document_->field(key);
  if (value == nullptr) return false;
  if (value->is_boolean()) return value->get<bool>();
  fail("field '" + std::string(key) + "' must be true or false");
  return false;
}

std::string FieldReader::string(const char* key, std::size_t max_length) {
  const Json* value = document_->field(key);
  if (value == nullptr) return {};
  if (is_text(*value, max_length)) return value->get<std::string>();
  fail("field '" + std::string(key) + "' must be a string of at most " +
       std::to_string(max_length) + " characters without control characters");
  return {};
}

std::size_t FieldReader::choice(const char* key, std::span<const std::string_view> names) {
  const Json* value = document_->field(key);
  if (value == nullptr) return 0;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (value->is_string() && value->get_ref<const std::string&>() == names[i]) return i;
    list += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  fail("field '" + std::string(key) + "' must be one of " + list);
  return 0;
}

Vec3 FieldReader::vec3(const char* key, double limit, double min_length) {
  const Json* value = document_->field(key);
  if (value == nullptr) return {};
  if (value->is_array() && value->size() == 3 && is_within((*value)[0], -limit, limit) &&
      is_within((*value)[1], -limit, limit) && is_within((*value)[2], -limit, limit)) {
    const Vec3 v{(*value)[0].get<double>(), (*value)[1].get<double>(), (*value)[2].get<double>()};
    if (dot(v, v) >= min_length * min_length) return v;
  }
  fail("field '" + std::string(key) + "' must be three numbers " + range(-limit, limit) +
       (min_length > 0 ? ", not all zero" : ""));
  return {};
}

std::vector<double> FieldReader::numbers(const char* key,
                                         std::size_t min_count,
                                         std::size_t max_count,
                                         double low,
                                         double high) {
  const Json* value = document_->field(key);
  if (value == nullptr) return {};
  if (value->is_array() && value->size() >= min_count && value->size() <= max_count &&
      std::all_of(value->begin(), value->end(),
                  [&](const Json& item) { return is_within(item, low, high); })) {
    return value->get<std::vector<double>>();
  }
  fail("field '" + std::string(key) + "' must be an array of numbers " + range(low, high));
  return {};
}

std::vector<std::string> FieldReader::strings(const char* key,
                                              std::size_t min_count,
                                              std::size_t max_count,
                                              std::size_t max_length) {
  const Json* value = document_->field(key);
  if (value == nullptr) return {};
  if (value->is_array() && value->size() >= min_count && value->size() <= max_count &&
      std::all_of(value->begin(), value->end(),
                  [&](const Json& item) { return is_text(item, max_length); })) {
    return value->get<std::vector<std::string>>();
  }
  fail("field '" + std::string(key) + "' must be an array of strings");
  return {};
}

std::string FieldReader::json(const char* key) {
  const Json* value = document_->field(key);
  if (value == nullptr) return {};
  return value->dump();
}

std::optional<std::string> FieldReader::finish() {
  if (ok()) {
    for (const auto& [key, value] : document_->root.items()) {
      if (std::find(document_->known.begin(), document_->known.end(), key) ==
          document_->known.end()) {
        fail("unknown field " +
             Json(key.substr(0, 64)).dump(-1, ' ', true, Json::error_handler_t::replace));
      }
    }
  }
  return document_->failure;
}

struct FieldWriter::Document {
  nlohmann::ordered_json root = nlohmann::ordered_json::object();
};

FieldWriter::FieldWriter() : document_(std::make_unique<Document>()) {}
FieldWriter::~FieldWriter() = default;

void FieldWriter::text(const char* key, std::string_view value) {
  document_->root[key] = std::string(value);
}
void FieldWriter::value(const char* key, double value) { document_->root[key] = value; }
void FieldWriter::value(const char* key, std::int64_t value) { document_->root[key] = value; }
void FieldWriter::value(const char* key, bool value) { document_->root[key] = value; }
void FieldWriter::value(const char* key, const std::vector<double>& values) {
  document_->root[key] = values;
}
void FieldWriter::value(const char* key, const std::vector<std::string>& values) {
  document_->root[key] = values;
}
void FieldWriter::vec3(const char* key, const Vec3& value) {
  document_->root[key] = {value.x, value.y, value.z};
}
void FieldWriter::json(const char* key, const std::string& json_text) {
  auto parsed = nlohmann::ordered_json::parse(json_text, nullptr, false);
  document_->root[key] = parsed.is_discarded() ? nlohmann::ordered_json() : std::move(parsed);
}
std::string FieldWriter::finish() const {
  return document_->root.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace carpus::server::protocol
