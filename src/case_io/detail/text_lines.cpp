// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "case_io/detail/text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.hpp"

namespace carpus::case_io {
namespace {

std::optional<double> parse(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace

TextLines::TextLines(const std::filesystem::path& file,
                     std::string_view content,
                     std::string_view separators)
    : file_(file), rest_(content), separators_(separators) {}

bool TextLines::next() {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    std::string_view line = rest_.substr(0, end);
    rest_ = end == std::string_view::npos ? std::string_view{} : rest_.substr(end + 1);
    ++line_;
    line = line.substr(0, line.find('#'));
    words_.clear();
    for (std::size_t at = 0; at < line.size();) {
      const std::size_t begin = line.find_first_not_of(separators_, at);
      if (begin == std::string_view::npos) break;
      at = std::min(line.find_first_of(separators_, begin), line.size());
      words_.push_back(line.substr(begin, at - begin));
    }
    if (!words_.empty()) return true;
  }
  words_.clear();
  return false;
}

std::string_view TextLines::word(std::size_t i) const {
  if (i >= words_.size()) refuse("ends too early: a number is missing");
  return words_[i];
}

bool TextLines::is_number(std::size_t i) const { return parse(word(i)).has_value(); }

double TextLines::number(std::size_t i) const {
  const auto value = parse(word(i));
  if (!value) refuse("'" + std::string(word(i).substr(0, 40)) + "' is no number");
  if (!std::isfinite(*value)) refuse("a coordinate is not finite");
  return *value;
}

std::int64_t TextLines::integer_of(std::string_view word) const {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) {
    refuse("'" + std::string(word.substr(0, 40)) + "' is no whole number");
  }
  return value;
}

void TextLines::refuse(const std::string& why) const {
  throw IoError(file_.string() + ", line " + std::to_string(line_) + ": " + why +
                "; correct the file or export it again");
}

}  // namespace carpus::case_io
