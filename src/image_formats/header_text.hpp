// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Words and numbers of headers that are written as text.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/vec3.hpp"

namespace carpus::image_formats {

/// A header of text longer than this is none.
inline constexpr std::size_t kLongestHeaderText = std::size_t{1} << 18U;

/// Without blanks and carriage returns at either end.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Between blanks.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);
/// A finite decimal number and nothing else.
[[nodiscard]] std::optional<double> number_of(std::string_view word);
/// A whole number and nothing else.
[[nodiscard]] std::optional<std::int64_t> integer_of(std::string_view word);
/// Exactly `count` numbers between blanks; empty otherwise.
[[nodiscard]] std::vector<double> numbers_of(std::string_view text, std::size_t count);
/// ASCII letters in lower case.
[[nodiscard]] std::string lower(std::string_view text);

/// Takes one line off the front, without its end; false where nothing is left.
bool take_line(std::string_view& rest, std::string_view& line);

}  // namespace carpus::image_formats
