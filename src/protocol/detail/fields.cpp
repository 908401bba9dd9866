// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "protocol/detail/fields.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/json_nesting.hpp"
#include "protocol/types.hpp"

namespace carpus::protocol {

namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

bool is_control(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F;
}

bool starts_code_point(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

/// Valid UTF-8 is certain: the parser refuses anything else.
bool is_text(const Json& value, std::size_t max_length) {
  if (!value.is_string()) return false;
  const auto& text = value.get_ref<const std::string&>();
  return std::none_of(text.begin(), text.end(), is_control) &&
         static_cast<std::size_t>(std::count_if(text.begin(), text.end(), starts_code_point)) <=
             max_length;
}

bool is_within(const Json& value, double low, double high) {
  if (!value.is_number()) return false;
  const double number = value.get<double>();
  return number >= low && number <= high;
}

bool is_whole_within(const Json& value, std::int64_t low, std::int64_t high) {
  if (!is_within(value, static_cast<double>(low), static_cast<double>(high))) return false;
  const double number = value.get<double>();
  return number == std::floor(number);
}

std::int64_t whole(const Json& value) { return static_cast<std::int64_t>(value.get<double>()); }

std::optional<Vec3> vec3_in(const Json& value, double limit, double min_length) {
  if (!value.is_array() || value.size() != 3) return std::nullopt;
  for (const Json& component : value) {
    if (!is_within(component, -limit, limit)) return std::nullopt;
  }
  const Vec3 v{value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
  if (dot(v, v) >= min_length * min_length) return v;
  return std::nullopt;
}

std::string range(double low, double high) {
  return "from " + Json(low).dump() + " to " + Json(high).dump();
}

std::string number_must(double low, double high) { return "be a number " + range(low, high); }

std::string integer_must(std::int64_t low, std::int64_t high) {
  return "be an integer from " + std::to_string(low) + " to " + std::to_string(high);
}

std::string text_must(std::size_t max_length) {
  return "be a string of at most " + std::to_string(max_length) +
         " characters without control characters";
}

std::string vec3_must(double limit, double min_length) {
  return "be three numbers " + range(-limit, limit) + (min_length > 0 ? ", not all zero" : "");
}

/// The text as a reader takes it.
std::string fitting(std::string_view text, std::size_t max_length) {
  const auto is_plain = [](char c) { return c >= 0x20 && c < 0x7F; };
  if (text.size() <= max_length && std::all_of(text.begin(), text.end(), is_plain)) {
    return std::string(text);
  }
  constexpr auto kReplace = Json::error_handler_t::replace;
  std::string fit = Json::parse(Json(text).dump(-1, ' ', false, kReplace)).get<std::string>();
  std::replace_if(fit.begin(), fit.end(), is_control, ' ');
  std::size_t code_points = 0;
  std::size_t last = 0;  // where the last one that fits begins
  for (std::size_t i = 0; i < fit.size(); ++i) {
    if (!starts_code_point(fit[i])) continue;
    if (++code_points > max_length) return fit.substr(0, last) + "…";
    last = i;
  }
  return fit;
}

}  // namespace

JsonText::JsonText(std::string_view text, std::size_t max_bytes) : root_(std::make_unique<Json>()) {
  if (text.size() > max_bytes) {
    fail("longer than " + std::to_string(max_bytes) + " bytes");
  } else if (nests_deeper_than(text, kMaxDepth)) {
    fail("nested too deeply");
  } else {
    *root_ = Json::parse(text, nullptr, false);
    if (root_->is_discarded()) fail("not valid JSON");
  }
}

JsonText::~JsonText() = default;

void JsonText::fail(std::string reason) {
  if (!failure_) failure_ = std::move(reason);
}

void JsonText::wrap(const char* key) {
  if (failure_) return;
  Json wrapped = Json::object();
  wrapped[key] = std::move(*root_);
  *root_ = std::move(wrapped);
}

FieldReader::FieldReader(JsonText& text) : text_(&text), object_(&text.root()) {
  if (!object_->is_object()) text.fail("not a JSON object");
}

std::string FieldReader::prefix() const {
  if (parent_ == nullptr) return {};
  std::string index = index_ == kNoIndex ? "" : "[" + std::to_string(index_) + "]";
  return parent_->prefix() + key_ + std::move(index) + ".";
}

void FieldReader::refuse(std::string_view key, const std::string& must) {
  if (ok()) text_->fail("field '" + prefix() + std::string(key) + "' " + must);
}

void FieldReader::refuse_item(const char* key, std::size_t index, const std::string& must) {
  refuse(std::string(key) + "[" + std::to_string(index) + "]", must);
}

const Json* FieldReader::field(const char* key) {
  if (!ok()) return nullptr;
  known_.emplace_back(key);
  const auto it = object_->find(key);
  if (it != object_->end()) return &*it;
  refuse(key, "is missing");
  return nullptr;
}

bool FieldReader::has(const char* key) {
  if (!ok()) return false;
  known_.emplace_back(key);
  const auto it = object_->find(key);
  return it != object_->end() && !it->is_null();
}

std::string FieldReader::type() {
  const Json* value = field("type");
  if (value == nullptr) return {};
  if (is_text(*value, 64)) return value->get<std::string>();
  refuse("type", "must be a string");
  return {};
}

double FieldReader::number(const char* key, double low, double high) {
  const Json* value = field(key);
  if (value == nullptr) return 0.0;
  if (is_within(*value, low, high)) return value->get<double>();
  refuse(key, "must " + number_must(low, high));
  return 0.0;
}

std::int64_t FieldReader::integer(const char* key, std::int64_t low, std::int64_t high) {
  const Json* value = field(key);
  if (value == nullptr) return 0;
  if (is_whole_within(*value, low, high)) return whole(*value);
  refuse(key, "must " + integer_must(low, high));
  return 0;
}

bool FieldReader::boolean(const char* key) {
  const Json* value = field(key);
  if (value == nullptr) return false;
  if (value->is_boolean()) return value->get<bool>();
  refuse(key, "must be true or false");
  return false;
}

std::string FieldReader::string(const char* key, std::size_t max_length) {
  const Json* value = field(key);
  if (value == nullptr) return {};
  if (is_text(*value, max_length)) return value->get<std::string>();
  refuse(key, "must " + text_must(max_length));
  return {};
}

std::size_t FieldReader::choice(const char* key, std::span<const std::string_view> names) {
  const Json* value = field(key);
  if (value == nullptr) return 0;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (value->is_string() && value->get_ref<const std::string&>() == names[i]) return i;
    list += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  refuse(key, "must be one of " + list);
  return 0;
}

Vec3 FieldReader::vec3(const char* key, double limit, double min_length) {
  const Json* value = field(key);
  if (value == nullptr) return {};
  if (const auto v = vec3_in(*value, limit, min_length)) return *v;
  refuse(key, "must " + vec3_must(limit, min_length));
  return {};
}

const Json* FieldReader::object(const char* key) {
  const Json* value = field(key);
  if (value == nullptr || value->is_object()) return value;
  refuse(key, "must be an object");
  return nullptr;
}

const Json* FieldReader::array(const char* key, std::size_t low, std::size_t high) {
  const Json* value = field(key);
  if (value == nullptr) return nullptr;
  if (value->is_array() && value->size() >= low && value->size() <= high) return value;
  refuse(key,
         "must be a list of " + std::string(low == high ? "" : "at most ") + std::to_string(high));
  return nullptr;
}

const Json* FieldReader::object_at(const char* key, const Json& items, std::size_t index) {
  if (items[index].is_object()) return &items[index];
  refuse_item(key, index, "must be an object");
  return nullptr;
}

std::size_t FieldReader::size(const Json& items) noexcept { return items.size(); }

void FieldReader::list(const char* key,
                       std::size_t low,
                       std::size_t high,
                       double least,
                       double most,
                       std::vector<double>& out) {
  const Json* items = array(key, low, high);
  if (items == nullptr) return;
  out.resize(items->size());
  fill(key, least, most, out);
}

void FieldReader::fill(const char* key, double least, double most, std::span<double> out) {
  const Json* items = array(key, out.size(), out.size());
  if (items == nullptr) return;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Json& item = (*items)[i];
    if (!is_within(item, least, most)) {
      return refuse_item(key, i, "must " + number_must(least, most));
    }
    out[i] = item.get<double>();
  }
}

void FieldReader::list(const char* key,
                       std::size_t low,
                       std::size_t high,
                       std::int64_t least,
                       std::int64_t most,
                       std::vector<std::int64_t>& out) {
  const Json* items = array(key, low, high);
  if (items == nullptr) return;
  for (const Json& item : *items) {
    if (!is_whole_within(item, least, most)) {
      return refuse_item(key, out.size(), "must " + integer_must(least, most));
    }
    out.push_back(whole(item));
  }
}

void FieldReader::list(const char* key,
                       std::size_t low,
                       std::size_t high,
                       std::size_t max_length,
                       std::vector<std::string>& out) {
  const Json* items = array(key, low, high);
  if (items == nullptr) return;
  for (const Json& item : *items) {
    if (!is_text(item, max_length)) {
      return refuse_item(key, out.size(), "must " + text_must(max_length));
    }
    out.push_back(item.get<std::string>());
  }
}

void FieldReader::list(const char* key,
                       std::size_t low,
                       std::size_t high,
                       double limit,
                       double min_length,
                       std::vector<Vec3>& out) {
  const Json* items = array(key, low, high);
  if (items == nullptr) return;
  for (const Json& item : *items) {
    const auto v = vec3_in(item, limit, min_length);
    if (!v) return refuse_item(key, out.size(), "must " + vec3_must(limit, min_length));
    out.push_back(*v);
  }
}

void FieldReader::finish() {
  if (!ok()) return;
  for (const auto& [key, value] : object_->items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    const Json name(prefix() + key.substr(0, 64));
    return text_->fail("unknown field " + name.dump(-1, ' ', true, Json::error_handler_t::replace));
  }
}

void FieldWriter::text(const char* key, std::string_view value, std::size_t max_length) {
  (*object_)[key] = fitting(value, max_length);
}
void FieldWriter::name(const char* key, std::string_view value) {
  (*object_)[key] = std::string(value);
}
void FieldWriter::value(const char* key, double value) { (*object_)[key] = value; }
void FieldWriter::value(const char* key, std::int64_t value) { (*object_)[key] = value; }
void FieldWriter::value(const char* key, bool value) { (*object_)[key] = value; }
void FieldWriter::null(const char* key) { (*object_)[key] = nullptr; }

void FieldWriter::vec3(const char* key, const Vec3& value) {
  (*object_)[key] = {value.x, value.y, value.z};
}

void FieldWriter::list(const char* key, std::span<const double> values) {
  OrderedJson& items = array(key);
  for (const double value : values) items.push_back(value);
}
void FieldWriter::list(const char* key, std::span<const std::int64_t> values) {
  OrderedJson& items = array(key);
  for (const std::int64_t value : values) items.push_back(value);
}
void FieldWriter::list(const char* key,
                       std::span<const std::string> values,
                       std::size_t max_length) {
  OrderedJson& items = array(key);
  for (const std::string& value : values) items.push_back(fitting(value, max_length));
}
void FieldWriter::list(const char* key, std::span<const Vec3> values) {
  OrderedJson& items = array(key);
  for (const Vec3& value : values) items.push_back({value.x, value.y, value.z});
}

OrderedJson& FieldWriter::child(const char* key) { return (*object_)[key] = OrderedJson::object(); }
OrderedJson& FieldWriter::array(const char* key) { return (*object_)[key] = OrderedJson::array(); }
OrderedJson& FieldWriter::add_object(OrderedJson& items) {
  return items.emplace_back(OrderedJson::object());
}

JsonWriter::JsonWriter() : root_(std::make_unique<OrderedJson>(OrderedJson::object())) {}
JsonWriter::~JsonWriter() = default;

std::string JsonWriter::dump(int indent) const { return root_->dump(indent); }
std::string JsonWriter::dump_field(const char* key, int indent) const {
  return root_->at(key).dump(indent);
}

}  // namespace carpus::protocol
