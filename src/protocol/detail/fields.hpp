// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the generated codecs are made of: reading checked fields from JSON of unknown origin, and
// writing them. nlohmann-json stays behind this header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::protocol {

/// A text, parsed, and the first thing that was wrong with it.
class JsonText {
 public:
  /// @param max_bytes  longest text that is looked at.
  JsonText(std::string_view text, std::size_t max_bytes);
  ~JsonText();
  JsonText(const JsonText&) = delete;
  JsonText& operator=(const JsonText&) = delete;

  [[nodiscard]] const nlohmann::json& root() const noexcept { return *root_; }
  [[nodiscard]] const std::optional<std::string>& failure() const noexcept { return failure_; }
  /// Makes the root the only field of an object: for texts that are a list.
  void wrap(const char* key);
  /// Remembers the first of several.
  void fail(std::string reason);

 private:
  std::unique_ptr<nlohmann::json> root_;
  std::optional<std::string> failure_;
};

/// Reads the fields of one JSON object. When something is wrong the text remembers it, and from
/// then on every read returns a harmless default, so that generated code needs few branches.
class FieldReader {
 public:
  /// Of the text's root.
  explicit FieldReader(JsonText& text);

  /// The message's kind.
  [[nodiscard]] std::string type();
  /// Whether an optional field is there: null is not.
  [[nodiscard]] bool has(const char* key);
  [[nodiscard]] double number(const char* key, double low, double high);
  [[nodiscard]] std::int64_t integer(const char* key, std::int64_t low, std::int64_t high);
  [[nodiscard]] bool boolean(const char* key);
  /// @param max_length  in Unicode code points; control characters but newline and tab are refused.
  [[nodiscard]] std::string string(const char* key, std::size_t max_length);
  /// Index of the string in `names`.
  [[nodiscard]] std::size_t choice(const char* key, std::span<const std::string_view> names);
  /// Three finite numbers within +-limit; the vector must be at least `min_length` long.
  [[nodiscard]] Vec3 vec3(const char* key, double limit, double min_length);

  /// Lists of `low` to `high` items.
  void list(const char* key,
            std::size_t low,
            std::size_t high,
            double least,
            double most,
            std::vector<double>& out);
  void list(const char* key,
            std::size_t low,
            std::size_t high,
            std::int64_t least,
            std::int64_t most,
            std::vector<std::int64_t>& out);
  void list(const char* key,
            std::size_t low,
            std::size_t high,
            std::size_t max_length,
            std::vector<std::string>& out);
  void list(const char* key,
            std::size_t low,
            std::size_t high,
            double limit,
            double min_length,
            std::vector<Vec3>& out);
  /// Exactly as many numbers as `out` has room for.
  void fill(const char* key, double least, double most, std::span<double> out);

  /// A record, by its `read(FieldReader&, Record&)`.
  template <typename Record>
  void record(const char* key, Record& out) {
    const nlohmann::json* value = object(key);
    if (value == nullptr) return;
    FieldReader in(*this, key, kNoIndex, *value);
    read(in, out);
    in.finish();
  }
  template <typename Record>
  void records(const char* key, std::size_t low, std::size_t high, std::vector<Record>& out) {
    const nlohmann::json* items = array(key, low, high);
    if (items == nullptr) return;
    const std::size_t count = size(*items);
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const nlohmann::json* value = object_at(key, *items, i);
      if (value == nullptr) return;
      FieldReader in(*this, key, i, *value);
      read(in, out.emplace_back());
      in.finish();
      if (!ok()) return;
    }
  }

  [[nodiscard]] bool ok() const noexcept { return !text_->failure(); }
  /// To be called last: refuses fields that nobody asked for.
  void finish();

 private:
  static constexpr std::size_t kNoIndex = static_cast<std::size_t>(-1);

  FieldReader(FieldReader& parent,
              const char* key,
              std::size_t index,
              const nlohmann::json& object) noexcept
      : text_(parent.text_), object_(&object), parent_(&parent), key_(key), index_(index) {}

  /// The field's value, or nullptr where something has failed already or it is missing.
  const nlohmann::json* field(const char* key);
  const nlohmann::json* object(const char* key);
  const nlohmann::json* array(const char* key, std::size_t low, std::size_t high);
  const nlohmann::json* object_at(const char* key, const nlohmann::json& items, std::size_t index);
  static std::size_t size(const nlohmann::json& items) noexcept;
  /// "items[3]." of the object that is read.
  [[nodiscard]] std::string prefix() const;
  void refuse(std::string_view key, const std::string& must);
  void refuse_item(const char* key, std::size_t index, const std::string& must);

  JsonText* text_;
  const nlohmann::json* object_;
  const FieldReader* parent_ = nullptr;
  const char* key_ = "";
  std::size_t index_ = kNoIndex;
  std::vector<std::string_view> known_;  ///< fields that were asked for
};

/// Writes the fields of one JSON object. Texts are made to fit: long ones end with an ellipsis,
/// control characters become spaces, broken UTF-8 U+FFFD; people and systems write them, and a page
/// must not refuse a list of attempts for a long name in it. Numbers must lie in their ranges.
class FieldWriter {
 public:
  explicit FieldWriter(nlohmann::ordered_json& object) noexcept : object_(&object) {}

  void text(const char* key, std::string_view value, std::size_t max_length);
  void name(const char* key, std::string_view value);
  void value(const char* key, double value);
  void value(const char* key, std::int64_t value);
  void value(const char* key, bool value);
  void vec3(const char* key, const Vec3& value);
  void null(const char* key);
  void list(const char* key, std::span<const double> values);
  void list(const char* key, std::span<const std::int64_t> values);
  void list(const char* key, std::span<const std::string> values, std::size_t max_length);
  void list(const char* key, std::span<const Vec3> values);

  template <typename Record>
  void record(const char* key, const Record& value) {
    FieldWriter out(child(key));
    write(out, value);
  }
  template <typename Record>
  void records(const char* key, const std::vector<Record>& values) {
    nlohmann::ordered_json& items = array(key);
    for (const Record& value : values) {
      FieldWriter out(add_object(items));
      write(out, value);
    }
  }

 private:
  nlohmann::ordered_json& child(const char* key);
  nlohmann::ordered_json& array(const char* key);
  static nlohmann::ordered_json& add_object(nlohmann::ordered_json& items);

  nlohmann::ordered_json* object_;
};

/// Owns the text that a FieldWriter fills.
class JsonWriter {
 public:
  JsonWriter();
  ~JsonWriter();
  JsonWriter(const JsonWriter&) = delete;
  JsonWriter& operator=(const JsonWriter&) = delete;

  [[nodiscard]] FieldWriter root() noexcept { return FieldWriter(*root_); }
  /// @param indent  spaces a level; negative writes one line.
  [[nodiscard]] std::string dump(int indent) const;
  /// Of the only field, by its name: texts that are a list.
  [[nodiscard]] std::string dump_field(const char* key, int indent) const;

 private:
  std::unique_ptr<nlohmann::ordered_json> root_;
};

}  // namespace carpus::protocol
