// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// What the generated codecs (protocol_messages.cpp) are made of: reading checked fields from one
// JSON object of unknown origin, and writing one. nlohmann-json stays behind this header.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::server::protocol {

/// Reads the fields of one JSON object and remembers the first thing that was wrong; from then on
/// every read returns a harmless default, so that generated code needs no branches.
class FieldReader {
 public:
  /// @param max_bytes  longest text that is looked at; 0 for no limit.
  FieldReader(std::string_view text, std::size_t max_bytes);
  ~FieldReader();
  FieldReader(const FieldReader&) = delete;
  FieldReader& operator=(const FieldReader&) = delete;

  /// The message's kind.
  [[nodiscard]] std::string type();
  [[nodiscard]] double number(const char* key, double low, double high);
  [[nodiscard]] std::int64_t integer(const char* key, std::int64_t low, std::int64_t high);
  [[nodiscard]] bool boolean(const char* key);
  /// @param max_length  in Unicode code points; control characters but newline and tab are refused.
  [[nodiscard]] std::string string(const char* key, std::size_t max_length);
  /// Index of the string in `names`.
  [[nodiscard]] std::size_t choice(const char* key, std::span<const std::string_view> names);
  /// Three finite numbers within +-limit; the vector must be at least `min_length` long.
  [[nodiscard]] Vec3 vec3(const char* key, double limit, double min_length);
  [[nodiscard]] std::vector<double> numbers(const char* key,
                                            std::size_t min_count,
                                            std::size_t max_count,
                                            double low,
                                            double high);
  [[nodiscard]] std::vector<std::string> strings(const char* key,
                                                 std::size_t min_count,
                                                 std::size_t max_count,
                                                 std::size_t max_length);
  /// Any JSON value, as text.
  [[nodiscard]] std::string json(const char* key);

  [[nodiscard]] bool ok() const noexcept;
  [[nodiscard]] const std::optional<std::string>& failure() const noexcept;
  /// To be called last: refuses fields that nobody asked for. Returns why the object is refused.
  [[nodiscard]] std::optional<std::string> finish();

 private:
  struct Document;
  void fail(std::string reason);

  std::unique_ptr<Document> document_;
};

/// Writes one JSON object.
class FieldWriter {
 public:
  FieldWriter();
  ~FieldWriter();
  FieldWriter(const FieldWriter&) = delete;
  FieldWriter& operator=(const FieldWriter&) = delete;

  void text(const char* key, std::string_view value);
  void value(const char* key, double value);
  void value(const char* key, std::int64_t value);
  void value(const char* key, bool value);
  void value(const char* key, const std::vector<double>& values);
  void value(const char* key, const std::vector<std::string>& values);
  void vec3(const char* key, const Vec3& value);
  /// @param json_text  a JSON value; null is written where it is not valid.
  void json(const char* key, const std::string& json_text);
  [[nodiscard]] std::string finish() const;

 private:
  struct Document;
  std::unique_ptr<Document> document_;
};

}  // namespace carpus::server::protocol
