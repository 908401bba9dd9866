// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A text file, line by line, word by word, with errors that name the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace carpus::case_io {

/// Words are separated by `separators`; what follows '#' is a comment; empty lines are skipped.
class TextLines {
 public:
  TextLines(const std::filesystem::path& file,
            std::string_view content,
            std::string_view separators = " \t\r");

  /// Goes on to the next line with a word in it; false at the end.
  bool next();
  [[nodiscard]] const std::vector<std::string_view>& words() const noexcept { return words_; }
  /// Word i as a finite number. @throws IoError.
  [[nodiscard]] double number(std::size_t i) const;
  /// Word i as a whole number. @throws IoError.
  [[nodiscard]] std::int64_t integer(std::size_t i) const { return integer_of(word(i)); }
  [[nodiscard]] std::int64_t integer_of(std::string_view word) const;
  [[nodiscard]] bool is_number(std::size_t i) const;
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  [[nodiscard]] std::string_view word(std::size_t i) const;

  const std::filesystem::path& file_;
  std::string_view rest_;
  std::string_view separators_;
  std::size_t line_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace carpus::case_io
