// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// How a file is refused: always with its name, the field, what stands there, what is needed.
#pragma once

#include <string>
#include <string_view>

namespace carpus::image_formats {

/// What a file claims, fit for a message: cut to 80 characters, others than printable ones as '?'.
[[nodiscard]] std::string printable(std::string_view text);
/// The shortest digits of a number.
[[nodiscard]] std::string printable(double number);

/// Names the file in every refusal.
class Refuser {
 public:
  explicit Refuser(std::string file) : file_(std::move(file)) {}
  [[nodiscard]] const std::string& file() const noexcept { return file_; }

  /// The file contradicts itself or its format: "<file>: <field> is <found>, <needed>; it is
  /// damaged: copy it again from its source".
  /// @throws IoError
  [[noreturn]] void damaged(std::string_view field,
                            std::string_view found,
                            std::string_view needed) const;
  /// "<file>: is cut short: <what> runs past its end; copy it again from its source".
  /// @throws IoError
  [[noreturn]] void cut_short(std::string_view what) const;
  /// The file may be well, but this program does not read the like: "<file>: <field> is <found>;
  /// <what to do>".
  /// @throws InvalidInput
  [[noreturn]] void unusable(std::string_view field,
                             std::string_view found,
                             std::string_view what_to_do) const;

 private:
  std::string file_;
};

}  // namespace carpus::image_formats
